#include "study/import_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "study/yaml_text.hpp"

namespace freestand::study {

std::string dataset_text(const Laboratory& lab, const measurement::Noise& noise_of_set,
                         const std::vector<TestOfLab>& tests) {
  std::string text = fmt::format("format: freestand-measurements/1\nname: {}\n", yaml_text(lab.name));
  if (lab.specimen != measurement::Dimensions{}) text += "specimen:\n";
  const auto put = [&](const char* key, const std::optional<double>& value) {
    if (value) text += fmt::format("  {}: {}\n", key, *value);
  };
  put("width_m", lab.specimen.width_m), put("height_m", lab.specimen.height_m), put("mass_kg", lab.specimen.mass_kg),
      put("centre_height_m", lab.specimen.centre_height_m), put("gyration_radius_m", lab.specimen.gyration_radius_m);
  const double step_s = tests.front().test.dt_s;
  if (std::ranges::all_of(tests, [&](const TestOfLab& t) { return t.test.dt_s == step_s; }))
    text += fmt::format("sampling_dt_s: {}\n", step_s);
  std::string noises;
  const auto noise = [&](const char* key, double value) {
    if (value > 0) noises += fmt::format("  {}: {:.4g}\n", key, value);
  };
  noise("slip_m", noise_of_set.slip_m), noise("rotation_rad", noise_of_set.rotation_rad);
  noise("block_acceleration_mps2", noise_of_set.block_acceleration_mps2);
  noise("floor_acceleration_mps2", noise_of_set.floor_acceleration_mps2);
  if (!noises.empty()) text += "noise:\n" + noises;
  text +=
      fmt::format("tolerance: {{width: {}, centre_height: {}, floor_gain: {}, clock_s: {}}}\ntests:\n",
                  lab.tolerance.width, lab.tolerance.centre_height, lab.tolerance.floor_gain, lab.tolerance.clock_s);
  for (const TestOfLab& t : tests)
    text += fmt::format("  - {{id: {}, file: {}, role: {}{}}}\n", yaml_text(t.test.id), yaml_text(t.test.id + ".csv"),
                        t.test.role == measurement::Role::holdout ? "holdout" : "calibration",
                        t.test.steps_a_reading > 1 ? fmt::format(", steps_a_reading: {}", t.test.steps_a_reading) : "");
  return text;
}

std::string csv_text(const TestOfLab& t) {
  struct Channel {
    const char* name;
    const std::vector<double>* samples;
  };
  std::vector<Channel> channels = {{"floor_acceleration_mps2", &t.floor}};
  for (const Channel& c : {Channel{"floor_vertical_acceleration_mps2", &t.vertical}, Channel{"slip_m", &t.test.slip_m},
                           Channel{"rotation_rad", &t.test.rotation_rad},
                           Channel{"block_acceleration_mps2", &t.test.block_acceleration_mps2}})
    if (!c.samples->empty()) channels.push_back(c);
  std::string text = "time_s";
  for (const Channel& c : channels) text += fmt::format(",{}", c.name);
  for (std::size_t i = 0; i < t.floor.size(); ++i) {
    text += fmt::format("\n{:.10g}", t.test.dt_s * static_cast<double>(i));
    for (const Channel& c : channels) text += fmt::format(",{}", (*c.samples)[i]);
  }
  return text + "\n";
}

}  // namespace freestand::study
