// One limit state in one of the forms, where that is honest.
#pragma once

#include <string>

#include "exports/limit_states.hpp"
#include "exports/model.hpp"

namespace freestand::exports {

// A difference between two probabilities below which no target's result would tell.
inline constexpr double tolerance = 1e-6;

// "" and the limit state has its curve; else why that form will not do, as "problem (why): what to do".
using Refusal = std::string;

// The lognormal of the fragility function, where it is adequate.
Refusal make_lognormal(LimitState&, const Wanted&);
// The curve through the bins (fragility/counted_curve.hpp), of which put_points makes points. Bins that fall are pooled while the changes
// stay within half the width of their bands; what falls by more is refused. counted: by the counted shares alone. straight: by
// straight lines from bin to bin.
Refusal make_discrete(LimitState&, const Wanted&, const fragility::Result&, const Intensity&, bool counted,
                      bool straight);
// Of discrete limit states: 0 at 0, and the same intensities for all, between which straight lines follow each of their curves. The curves
// of states that are nested at each bin are kept so between them.
void put_points(std::vector<LimitState>&);
// The parts of each bin as they are. A bin that failed its test has none; one in which nothing moved borrows the lognormal,
// which has no weight there, from its neighbour.
Refusal make_parts(LimitState&, const Wanted&, const fragility::Result&, const Intensity&);

// The bins as they are.
Refusal make_table(LimitState&);

// "peak_slip_m > 0.1 m"
std::string label(const Wanted&);

}  // namespace freestand::exports
