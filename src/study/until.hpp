// What `until` wanted, and what was reached.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "fragility/half_width.hpp"
#include "fragility/result.hpp"
#include "study/study.hpp"

namespace freestand::study {

// Samples so far, with those that were passed over (rounds.hpp), and how many of the first ones none was passed over of.
struct Drawn {
  std::int64_t samples = 0, alike = 0;
};

// What of the surfaces a study wants to be known, and how well. Of a study with `until`.
fragility::Wanted wanted(const Study&, const Drawn&);

// After a round: "8192 samples: the surface is known to +-0.061 at all 48 points at once (wanted +-0.020); some 7.6e+04 samples are needed", or
// that at_most is too few, or that only more records would help.
std::string round_told(const Study&, const fragility::Result&, const Drawn&);

// One sentence where `until` was not reached; "" where it was, or where the study has none.
std::string not_reached(const Study&, const fragility::Result&, const Drawn&);

// Where some were passed over, what is true of the bins alone, and not of all samples together; else empty.
std::string passed_over_told(const Drawn&);

// Of a study with `until`: summary["until"] = {half_width_wanted, relative_error_wanted, down_to, half_width_reached, points: at which it
// is at once, with half_width_wanted below 0.5, else at each by itself (fragility::HalfWidth), times_wanted, reached, samples: that were
// counted (not passed over, and taken by the target), drawn, alike, at_most, farthest from what is wanted: {edp, im, capacity, the second
// axis with its place there, half_width}, stays_above: what more samples would not take away where that is most times what is wanted,
// samples_needed: to be drawn, at most (samples of bins that were passed over are of fewer draws than all), null where only more records
// would do, rare_cells: of second axes, not wanted, empty_bins: middles of bins of intensity in which nothing fell, and nothing is waited for (one of summary["warnings"] too)}; where it was not reached also one of summary["warnings"], and a line on the
// terminal.
void tell_until(const Study&, const fragility::Result&, const Drawn&, nlohmann::ordered_json& summary);

}  // namespace freestand::study
