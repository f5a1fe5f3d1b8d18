// What `until` wanted, and what was reached.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "fragility/result.hpp"
#include "study/study.hpp"

namespace freestand::study {

// One sentence where `until` was not reached; "" where it was, or where the study has none.
std::string not_reached(const Study&, const fragility::Result&);

// Of a study with `until`: summary["until"] = {half_width_wanted, half_width_reached, reached, samples, at_most, widest: {edp,
// im, capacity}}; where it was not reached also one of summary["warnings"], and a line on the terminal.
void tell_until(const Study&, const fragility::Result&, nlohmann::ordered_json& summary);

}  // namespace freestand::study
