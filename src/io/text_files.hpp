// The small text files of a result folder.
#pragma once

#include <filesystem>
#include <freestand/response.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "fragility/result.hpp"
#include "io/provenance.hpp"

namespace freestand::io {

inline constexpr const char* summary_format = "freestand-summary/1";
inline constexpr const char* response_format = "freestand-response/1";

// Text of history.csv: time_s,floor_acceleration_mps2,slip_m,slip_velocity_mps,rotation_rad,rotation_rate_radps,mode, and
// floor_displacement_m (one for each point); then, of one horizontal channel, acceleration_mps2,vertical_acceleration_mps2 (of
// the point that the case names, else of the centre of mass), contact_horizontal_n,contact_vertical_n; where History::cross,
// cross_slip_m,cross_slip_velocity_mps,floor_cross_acceleration_mps2. Numbers read back to the same bits.
std::string history_csv(const History&, const std::vector<double>& floor_displacement_m, double mass_kg);

// summary.json of one simulated sample: format, peak_slip_m, residual_slip_m, slid_path_m, peak_rotation_rad, overturned,
// outcome, peak_acceleration_g, events, and impacts, residual_rotation_rad, end_time_s.
// cross: the floor moves in both horizontal directions; residual_slip_m is then the size of the vector, whose components are
// residual_slip_along_m and residual_slip_across_m. Accelerations at a height, and forces of a block of mass_kg, where they were
// followed.
nlohmann::ordered_json response_summary(const Response&, bool cross = false, double mass_kg = 1);

// summary.json of a sweep: format, study_name, samples, seed, outcomes, im, edps, warnings, provenance. The caller adds
// timing and files.
nlohmann::ordered_json fragility_summary(const Provenance&, const fragility::Result&);

// JSON text, indented, line end at its end: doubles read back to the same bits, NaN and infinity become null.
std::string json_text(const nlohmann::ordered_json&);

}  // namespace freestand::io
