// What `until` wanted, and what was reached.
#pragma once

#include <nlohmann/json.hpp>

#include "fragility/result.hpp"
#include "study/study.hpp"

namespace freestand::study {

// Of a study with `until`: summary["until"] = {half_width_wanted, half_width_reached, reached, samples, at_most, widest: {edp,
// im, capacity}}; where it was not reached also one of summary["warnings"], and a line on the terminal.
void tell_until(const Study&, const fragility::Result&, nlohmann::ordered_json& summary);

}  // namespace freestand::study
