#include "io/text_files.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/units.hpp"
#include "io/bin_fields.hpp"
#include "io/fragility_file.hpp"

namespace freestand::io {
namespace {

using Json = nlohmann::ordered_json;

Json function_summary(const fragility::FragilityFunction& curve) {
  Json json = Json::object();
  for (const FunctionField& field : function_fields()) json[field.name] = field.value(curve);
  for (const char* flag : {"penalised", "extrapolated", "adequate"}) json[flag] = json[flag] != 0;
  return json;
}

Json edp_summary(const fragility::EdpResult& edp) {
  std::array<int, 5> bins{};  // by status
  for (const fragility::BinFit& bin : edp.bins) ++bins[static_cast<std::size_t>(bin.status)];
  Json json{{"unit", edp.unit}, {"kind", edp.binary ? "binary" : "continuous"}, {"bins", edp.bins.size()}};
  for (std::size_t i = 0; i < bins.size(); ++i) json[name(static_cast<fragility::BinStatus>(i))] = bins[i];
  json["functions"] = Json::array();
  for (std::size_t c = 0; c < edp.functions.size(); ++c) {
    json["functions"].push_back({{"capacity", edp.capacity[c]}});
    json["functions"].back().update(function_summary(edp.functions[c]));
  }
  if (edp.binary) return json;
  const fragility::Regressions& found = edp.regressions;
  json["regression"] = {{"n", found.n}};
  for (const RegressionField& field : regression_fields()) json["regression"][field.name] = found.*field.value;
  return json;
}

Json provenance_json(const Provenance& from) {
  return {{"version", from.version},
          {"kernel", from.kernel},
          {"git_commit", from.git_commit},
          {"compiler", from.compiler},
          {"libraries", Json::parse(from.libraries, nullptr, false)},
          {"host", from.host},
          {"created_utc", from.created_utc},
          {"command", from.command},
          {"ranks", from.ranks}};
}

}  // namespace

std::string history_csv(const History& history, const std::vector<double>& floor_displacement_m, double mass_kg) {
  std::string text =
      "time_s,floor_acceleration_mps2,slip_m,slip_velocity_mps,rotation_rad,rotation_rate_radps,mode,"
      "floor_displacement_m,";
  text += history.cross ? "cross_slip_m,cross_slip_velocity_mps,floor_cross_acceleration_mps2\n"
                        : "acceleration_mps2,vertical_acceleration_mps2,contact_horizontal_n,contact_vertical_n\n";
  for (std::size_t i = 0; i < history.points.size(); ++i) {
    const HistoryPoint& p = history.points[i];
    text += fmt::format("{},{},{},{},{},{},{},{},", p.time_s, p.floor_acceleration_mps2, p.slip_m, p.slip_velocity_mps,
                        p.rotation_rad, p.rotation_rate_radps, name(p.mode), floor_displacement_m.at(i));
    text += history.cross
                ? fmt::format("{},{},{}\n", p.cross_slip_m, p.cross_slip_velocity_mps, p.floor_cross_acceleration_mps2)
                : fmt::format("{},{},{},{}\n", p.acceleration_mps2, p.vertical_acceleration_mps2,
                              mass_kg * p.contact_x_mps2, mass_kg * p.contact_y_mps2);
  }
  return text;
}

Json response_summary(const Response& response, bool cross, double mass_kg) {
  Json json = {{"format", response_format},
               {"peak_slip_m", response.peak_slip_m},
               {"residual_slip_m", response.residual_slip_m},
               {"slid_path_m", response.slid_path_m},
               {"peak_rotation_rad", response.peak_rotation_rad},
               {"overturned", response.outcome == Outcome::overturned},
               {"outcome", name(response.outcome)},
               {"peak_acceleration_g", response.peak_acceleration_mps2 / standard_gravity_mps2},
               {"events", response.events},
               {"impacts", response.impacts},
               {"wall_hits", response.wall_hits},
               {"wall_speed_mps", response.wall_speed_mps},
               {"connection_failed", response.connection_failed},
               {"residual_rotation_rad", response.residual_rotation_rad},
               {"end_time_s", response.end_time_s}};
  if (!std::isnan(response.peak_acceleration_at_height_mps2)) {
    json["peak_acceleration_at_height_g"] = response.peak_acceleration_at_height_mps2 / standard_gravity_mps2;
    json["largest_blow_mps"] = response.largest_blow_mps;
  }
  if (!std::isnan(response.peak_contact_vertical_mps2)) {
    json["peak_contact_horizontal_over_weight"] = response.peak_contact_horizontal_mps2 / standard_gravity_mps2;
    json["peak_contact_vertical_over_weight"] = response.peak_contact_vertical_mps2 / standard_gravity_mps2;
    json["peak_chain_force_n"] = response.peak_chain_force_mps2 * mass_kg;
    json["peak_contents_acceleration_g"] = response.peak_contents_acceleration_mps2 / standard_gravity_mps2;
    json["peak_leg_deflection_m"] = response.peak_leg_deflection_m;
    json["leg_fatigue_m"] = response.leg_fatigue_m;
  }
  if (!cross) return json;
  json["residual_slip_m"] = std::hypot(response.residual_slip_m, response.residual_cross_slip_m);
  json["residual_slip_along_m"] = response.residual_slip_m;
  json["residual_slip_across_m"] = response.residual_cross_slip_m;
  return json;
}

Json fragility_summary(const Provenance& provenance, const fragility::Result& result) {
  Json json{{"format", summary_format},
            {"study_name", provenance.study_name},
            {"samples", result.samples},
            {"seed", provenance.seed}};
  for (int i = 0; i < outcome_count; ++i)
    json["outcomes"][name(static_cast<Outcome>(i))] = result.outcome_counts[static_cast<std::size_t>(i)];
  json["im"] = result.im_name;
  json["im_unit"] = result.im_unit;
  json["outside_im"] = result.outside_im;
  json["motions"] = result.motions;
  json["edps"] = Json::object();
  for (const fragility::EdpResult& edp : result.edps) json["edps"][edp.name] = edp_summary(edp);
  json["overturning"] = function_summary(result.overturning);
  json["warnings"] = result.warnings;
  json["provenance"] = provenance_json(provenance);
  return json;
}

std::string json_text(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace freestand::io
