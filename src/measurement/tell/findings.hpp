// What a comparison says, one plain sentence a finding; the weightiest first.
#pragma once

#include "measurement/tell/compare.hpp"

namespace freestand::measurement {

std::vector<std::string> findings(const Bench&, const ModelSpec&, std::span<const double> x, const Comparison&,
                                  const Quality&);

// At which ends of its range the tests leave a fitted number open. Its 95 % interval leaves 2.5 % of the draws beyond each end;
// where these lie half as dense as those within, or denser, the draws have not died out before the bound: it is the range that
// ends there, not what the tests allow.
struct OpenEnds {
  bool below = false, above = false;
};
OpenEnds open_ends(const ModelFit&, std::size_t number);
std::vector<std::string> undetermined(const ModelFit&);  // such numbers, a sentence each

}  // namespace freestand::measurement
