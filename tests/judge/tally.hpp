// What many judgements add up to: per effect and setting, and per effect and mode that was visited.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "judge/judge.hpp"

namespace freestand::test {

class Tally {
 public:
  void add(const JudgedCase&, const Judgement&);

  struct Count {
    int cases = 0, edges = 0, disagreements = 0;
    std::size_t compared = 0, samples = 0;
  };
  const Count& total() const { return total_; }
  std::string table() const;
  // Effects and modes that no compared history visited, and that can be: "wall_impact: slide_rock". For cases of one family.
  std::vector<std::string> empty_cells(Family family = Family::rigid) const;

 private:
  int visits(const std::string& effect, const std::string& deed) const;

  Count total_;
  std::map<std::string, std::map<Setting, Count>> settings_;
  std::map<std::string, std::map<std::string, int>> visits_;  // effect -> deed -> cases
};

}  // namespace freestand::test
