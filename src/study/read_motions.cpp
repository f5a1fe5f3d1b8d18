// Where the floor motions of a study come from: pulses, records and synthetic motions.
#include <fmt/format.h>

#include "motion/pulse.hpp"
#include "study/read_building.hpp"
#include "study/read_parts.hpp"
#include "study/read_synthetic.hpp"

namespace freestand::study {
namespace {

constexpr Range period_range = {
    .lower = 1e-6, .lower_open = false, .why = "a period must be above zero, and a shorter one moves nothing"};
constexpr Range weight_range = {.lower = 0, .why = "a weight must be above zero"};

const std::vector<std::string> pulse_keys = {"period_s", "peak_acceleration_g", "peak_velocity_mps"};
const std::vector<std::string> record_keys = {
    "dt_s",          "unit",       "format", "channel",    "vertical_records", "vertical_file",  "group",
    "cross_records", "cross_file", "rotate", "rotate_deg", "pulse_type",       "pulse_period_s", "begin_together"};

// Keys of the other kind of source are not unknown, but out of place.
void out_of_place(Section& section, const std::vector<std::string>& keys, const std::string& with) {
  for (const auto& key : keys)
    if (section.find(key))
      section.problem(
          key, fmt::format("{} does not go with {} (it has no meaning there): remove it", section.name(key), with));
}

void read_pulses(Section& section, MotionSource& source) {
  source.kind = MotionSource::Kind::pulses;
  if (const auto names =
          read_names(*section.find("pulse"), section.name("pulse"), section.line("pulse"), section.problems())) {
    source.pulses = *names;
    settle_pulse_names(section, "pulse", source.pulses);
  }
  source.period = section.quantity("motion", "period_s", period_range);
  const auto acceleration = section.quantity("motion", "peak_acceleration_g", range::any);
  const auto velocity = section.quantity("motion", "peak_velocity_mps", range::any);
  const auto target = read_scale_to(section, source);
  source.amplitude = acceleration ? acceleration : velocity ? velocity : target;
  source.pulse_scale = section.number("scale", 1);
  const std::string name = section.name("pulse");
  if (!section.has("period_s")) section.problem("pulse", name + " has no period (a pulse has a length): add period_s");
  std::vector<std::string> given;
  for (const char* key : {"peak_acceleration_g", "peak_velocity_mps", "scale_to"})
    if (section.has(key)) given.emplace_back(key);
  if (given.size() > 1)
    section.problem(given[1], fmt::format("{} and {} are both given (one determines the other): remove one",
                                          section.name(given[1]), given[0]));
  if (given.empty())
    section.problem("pulse", name +
                                 " has no amplitude (how strong is it?): add peak_acceleration_g, peak_velocity_mps "
                                 "or scale_to");
  out_of_place(section, record_keys, "pulse");
  out_of_place(section, processing_keys(), "pulse");
  for (const char* key : {"building", "storey"})
    if (section.find(key))
      section.problem(
          key,
          fmt::format("{} does not go with pulse (its period differs from sample to sample, and the floors' motion "
                      "with it): give records of the ground, or take the pulse for the floor's and remove it",
                      section.name(key)));
}

void read_any_records(Section& section, MotionSource& source, const RecordKeys& keys) {
  source.kind = MotionSource::Kind::records;
  read_records(section, source, keys);
  read_building(section, source, keys.folder, keys.look);
  out_of_place(section, pulse_keys, keys.key);
}

void read_synthetic_motions(Section& section, MotionSource& source, const RecordKeys& keys) {
  read_synthetic(section, source, keys.folder, keys.look);
  read_building(section, source, keys.folder, keys.look);
  for (const auto& other : {pulse_keys, record_keys, processing_keys()}) out_of_place(section, other, "synthetic");
}

MotionSource read_source(Section& section, const RecordKeys& keys) {
  MotionSource source;
  const std::string& file_key = keys.key;
  const bool pulse = section.find("pulse") != nullptr, file = section.find(file_key) != nullptr,
             synthetic = section.find("synthetic") != nullptr;
  const bool one = pulse + file + synthetic == 1;
  if (!one && (pulse || file || synthetic))
    section.problem(file ? file_key : "pulse",
                    fmt::format("{} and {} are both given (a motion is one or the other): make two entries, or remove "
                                "one",
                                section.name(file ? file_key : "synthetic"), pulse ? "pulse" : "synthetic"));
  else if (pulse)
    read_pulses(section, source);
  else if (file)
    read_any_records(section, source, keys);
  else if (synthetic)
    read_synthetic_motions(section, source, keys);
  else
    section.problem("pulse",
                    fmt::format("a motion has neither pulse nor {} (nothing would shake): add one of them", file_key));
  if (!one)
    for (const auto& known : {pulse_keys, record_keys, processing_keys(), {"scale", "scale_to", "building", "storey"}})
      for (const auto& key : known) section.find(key);
  section.finish();
  return source;
}

}  // namespace

void settle_pulse_names(Section& section, const std::string& key, sampling::Names& names) {
  for (auto& name : names.values) {
    try {
      name = motion::find_pulse(name).name;
    } catch (const Error& error) {
      section.problem(key, section.name(key) + ": " + error.what());
    }
  }
}

std::vector<MotionSource> read_motions(Section& file, const std::filesystem::path& folder, Files look, bool vertical) {
  std::vector<MotionSource> sources;
  const YAML::Node* node = file.find("motions");
  if (!node || !node->IsSequence() || node->size() == 0) {
    file.problem("motions", std::string(node ? "motions is no list, or an empty one" : "motions is missing") +
                                " (nothing would shake): write motions: [{pulse: B, period_s: 0.5, "
                                "peak_acceleration_g: 0.6}] or [{records: \"records/*.AT2\"}]");
    return sources;
  }
  if (lacks_braces(*node, "motions", file.line("motions"), file.problems())) return sources;
  for (std::size_t i = 0; i < node->size(); ++i) {
    const int line = line_of((*node)[i]) ? line_of((*node)[i]) : file.line("motions");
    Section section((*node)[i], fmt::format("motions[{}]", i), line, file.problems());
    const double weight = section.number("weight", 1, weight_range);
    sources.push_back((*node)[i].IsMap() ? read_source(section, {"records", "vertical_records", "cross_records", folder,
                                                                 look, vertical})
                                         : MotionSource{});
    sources.back().weight = weight;
  }
  return sources;
}

MotionSource read_motion(Section& file, const std::filesystem::path& folder) {
  const YAML::Node* node = file.find("motion");
  if (!node) {
    file.problem("motion",
                 "motion is missing (nothing would shake): write motion: {file: floor.csv} or motion: {pulse: B, "
                 "period_s: 0.5, peak_acceleration_g: 0.6}");
    return {};
  }
  Section section(*node, "motion", file.line("motion"), file.problems());
  if (!node->IsMap()) return {};
  MotionSource source = read_source(section, {"file", "vertical_file", "cross_file", folder, Files::look, false});
  if (source.kind == MotionSource::Kind::synthetic)
    section.problem("synthetic",
                    "motion.synthetic is a set of motions (a case has one motion): write one with `freestand motion "
                    "--synthetic FILE --number 0 --convert floor.csv`, and give that as file");
  if (source.pulses.values.size() > 1)
    section.problem("pulse", "motion.pulse is a list (a case is one sample): name one pulse");
  if (source.pulse.any())
    section.problem("file",
                    "motion says pulse_type or pulse_period_s (a case has no demand that looks at them): remove them");
  if (source.files.size() > 1)
    section.problem("file",
                    fmt::format("motion.file matches {} files (a case has one motion): name one", source.files.size()));
  return source;
}

}  // namespace freestand::study
