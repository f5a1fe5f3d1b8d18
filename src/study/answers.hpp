// What the shares of variance are asked of: each demand, each P(EDP > C) and each damage state of a study, read from rows of
// samples.
#pragma once

#include <span>
#include <vector>

#include "base/table.hpp"
#include "decision/shares.hpp"
#include "study/study.hpp"

namespace freestand::study {

class Answers {
 public:
  // Of each demand of the fragility block: ln of it, and whether it exceeds each capacity; of one that is yes or no, whether it
  // happens; of each damage state, whether it holds. columns: of the rows; a demand or state that has none is left out.
  Answers(const FragilityPart&, const std::vector<Column>& columns);

  const std::vector<decision::Answer>& answers() const { return answers_; }
  const std::vector<std::string>& columns() const { return columns_; }  // that are read of a row

  // As the tally counts them: what overturned exceeds every capacity of a demand that it leaves without a value; what failed
  // numerically has no answer. row: in the order of `columns` of the constructor.
  void read(std::span<const double> row, std::vector<double>& values) const;

 private:
  struct Demand {
    std::size_t column;
    bool yes_or_no, censored;
    double still;
    std::vector<double> capacities;
  };
  std::vector<decision::Answer> answers_;
  std::vector<std::string> columns_;
  std::vector<Demand> demands_;
  std::size_t outcome_;
};

}  // namespace freestand::study
