#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "hidden_effect/make_set.hpp"

namespace freestand::test {
namespace {

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  if (!stream.flush()) throw std::runtime_error(file.string() + " cannot be written");
}

std::string dataset_text(const MadeSet& set) {
  std::string text = fmt::format(
      "format: freestand-measurements/1\nname: {}\nspecimen:\n  width_m: {:.4f}\n  height_m: {:.4f}\n  mass_kg: "
      "{:.1f}\nsampling_dt_s: {}\nnoise:\n  slip_m: {:.6f}\n  rotation_rad: {:.6f}\ntests:\n",
      set.name, set.stated_width * set.drawn.width_m, set.drawn.height_m, set.drawn.mass_kg,
      set.tests.front().measured_floor.dt_s, set.stated_noise * set.slip_noise_m, set.stated_noise * set.rotation_noise_rad);
  for (const MadeTest& test : set.tests)
    text += fmt::format("  - id: {0}\n    file: {0}.csv\n    role: {1}\n", test.id,
                        test.holdout ? "holdout" : "calibration");
  return text;
}

std::string csv_text(const MadeTest& test) {
  const FloorSamples& floor = test.measured_floor;
  const bool vertical = !floor.vertical_mps2.empty(), rotation = !test.rotation_rad.empty();
  std::string text = fmt::format("time_s,floor_acceleration_mps2{},slip_m{}\n",
                                 vertical ? ",floor_vertical_acceleration_mps2" : "", rotation ? ",rotation_rad" : "");
  for (std::size_t i = 0; i < test.slip_m.size(); ++i) {
    text += fmt::format("{:.4f},{:.6g}", floor.dt_s * static_cast<double>(i), floor.horizontal_mps2[i]);
    if (vertical) text += fmt::format(",{:.6g}", floor.vertical_mps2[i]);
    text += fmt::format(",{:.6g}", test.slip_m[i]);
    if (rotation) text += fmt::format(",{:.6g}", test.rotation_rad[i]);
    text += '\n';
  }
  return text;
}

// For a block that only slides, g sin(beta) and mu d g are one force.
bool has_twin(const MadeSet& set) {
  if (set.drawn.habit != Habit::slides) return false;
  bool pushes = false, vertical = false;
  for (const TruthEffect& effect : set.drawn.truth.effects) {
    pushes |= effect.name == "floor_tilt" || effect.name == "directional_friction";
    vertical |= effect.name == "vertical_shaking";
  }
  return pushes && !vertical;
}

}  // namespace

void write_set(const MadeSet& set, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  write(folder / "dataset.yaml", dataset_text(set));
  for (const MadeTest& test : set.tests) write(folder / (test.id + ".csv"), csv_text(test));
}

nlohmann::ordered_json answer_of(const MadeSet& set) {
  nlohmann::ordered_json effects = nlohmann::ordered_json::array(), parameters = nlohmann::ordered_json::object();
  const auto& outside = outside_effects();
  bool in_catalogue = true;
  for (const TruthEffect& effect : set.drawn.truth.effects) {
    effects.push_back(effect.name);
    parameters[effect.name] = effect.parameters;
    in_catalogue &= std::find(outside.begin(), outside.end(), effect.name) == outside.end();
  }
  nlohmann::ordered_json truth_errors;
  for (const MadeTest& test : set.tests) truth_errors[test.id] = test.truth_error;
  const Truth& t = set.drawn.truth;
  static constexpr const char* habits[] = {"slides", "rocks", "slides and rocks"};
  return {{"effects", effects},
          {"in_catalogue", in_catalogue},
          {"fault", set.fault},
          {"true_parameters",
           {{"width_m", set.drawn.width_m},
            {"height_m", set.drawn.height_m},
            {"mass_kg", set.drawn.mass_kg},
            {"mu", t.mu_k},
            {"effects", parameters}}},
          {"habit", habits[static_cast<int>(set.drawn.habit)]},
          {"floor_noise_mps2", set.floor_noise_mps2},
          {"plain_error_noise_units", set.plain_error},
          {"weakest_error_noise_units", set.weakest_error},
          {"truth_error_noise_units", truth_errors},
          {"twins", has_twin(set) ? nlohmann::ordered_json{"floor_tilt", "directional_friction"}
                                  : nlohmann::ordered_json::array()}};
}

}  // namespace freestand::test
