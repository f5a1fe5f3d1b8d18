// What `until` wanted, and what was reached.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "fragility/half_width.hpp"
#include "fragility/result.hpp"
#include "study/study.hpp"

namespace freestand::study {

// What of the surfaces a study wants to be known, and how well. Of a study with `until`.
fragility::Wanted wanted(const Study&);

// After a round: "8192 samples: the surface is known to +-0.061 (wanted +-0.020); 76,000 are needed", or that at_most is too few, or that only
// more records would help.
std::string round_told(const Study&, const fragility::Result&);

// One sentence where `until` was not reached; "" where it was, or where the study has none.
std::string not_reached(const Study&, const fragility::Result&);

// Of a study with `until`: summary["until"] = {half_width_wanted, half_width_reached, reached, samples, at_most, widest: {edp,
// im, capacity, and the second axis with its place there}, stays_above: what more samples would not take away, samples_needed: null where
// only more records would do, rare_cells: of second axes, not wanted}; where it was not reached also one of summary["warnings"], and a line on the terminal.
void tell_until(const Study&, const fragility::Result&, nlohmann::ordered_json& summary);

}  // namespace freestand::study
