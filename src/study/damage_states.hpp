// Damage states of a study, sample by sample: each is one more binary demand beside those of src/edp.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/table.hpp"
#include "fragility/options.hpp"
#include "study/study.hpp"

namespace freestand::study {

class DamageStates {
 public:
  explicit DamageStates(const Study&);

  bool empty() const;
  std::vector<fragility::EdpOptions> edps() const;

  // Of those that hold for a block that overturned, whatever else happened to it.
  std::vector<std::string> with_overturned() const;

  // Appends a column edp_NAME for each to rows of samples, the first of which is sample `first`. Parameters are drawn by
  // their names, independently of the demands. A censored demand of a sample that overturned is above every capacity
  // (+inf); a sample without a demand that the condition looks at has no state (nan).
  void append(Table& rows, std::uint64_t first) const;

 private:
  struct State;
  std::vector<std::shared_ptr<const State>> states_;
};

}  // namespace freestand::study
