// Study files for the tests of src/study.
#pragma once

#include <freestand/error.hpp>
#include <string>

#include "study/study.hpp"

namespace freestand::study::test {

inline Known known() {
  return {.edps = {{"delta", false, {0.5, 1, 2}},
                   {"overturned", true, {}},
                   {"peak_slip_m", false, {}},
                   {"peak_slip_right_m", false, {0.1}, false, 0, edp::Wants::sides},
                   {"peak_contact_vertical_over_weight", false, {1.5}, false, 0, edp::Wants::forces},
                   {"peak_chain_force_n", false, {500}, false, 0, edp::Wants::chain_force},
                   {"peak_contents_acceleration_g", false, {1}, false, 0, edp::Wants::contents},
                   {"leg_fatigue_m", false, {0.01}, false, 0, edp::Wants::legs},
                   {"wall_hit", true, {}, false, 0, edp::Wants::wall},
                   {"connection_failed", true, {}, false, 0, edp::Wants::chain}},
          .intensities = {{"report", "", 0}, {"pta_g", "", 0}, {"sa_g", "period_s", 1.0}}};
}

// The shortest study there is, without friction or motions where these are named in `without`.
inline const std::string block = "block: {width_m: 0.6, height_m: 1.8, mass_kg: 150}\n";
inline const std::string friction = "friction: {mu: 0.25}\n";
inline const std::string motions = "motions: [{pulse: B, period_s: 0.5, peak_acceleration_g: {uniform: [0.1, 2]}}]\n";
inline const std::string fragility = "fragility: {edp: [delta, overturned]}\n";
inline const std::string samples = "samples: 1000\n";

inline Study parse(const std::string& text) { return parse_study(text, "folder/some.yaml", known()); }

// Text of the Error that parsing throws; empty when it throws none.
inline std::string problems(const std::string& text) {
  try {
    parse(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

inline std::string case_problems(const std::string& text) {
  try {
    parse_case(text, "one.yaml");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace freestand::study::test
