// Where the floor motions of a study come from: pulses and records.
#include <fmt/format.h>

#include "motion/component.hpp"
#include "motion/pulse.hpp"
#include "motion/record.hpp"
#include "study/read_parts.hpp"

namespace freestand::study {
namespace {

constexpr Range period_range = {
    .lower = 1e-6, .lower_open = false, .why = "a period must be above zero, and a shorter one moves nothing"};
constexpr Range pta_range = {.lower = 0, .why = "a peak that a record is scaled to must be above zero"};
constexpr Range weight_range = {.lower = 0, .why = "a weight must be above zero"};

const std::vector<std::string> pulse_keys = {"period_s", "peak_acceleration_g", "peak_velocity_mps"};
const std::vector<std::string> record_keys = {"scale_to",         "dt_s",         "unit", "format", "channel",
                                              "vertical_records", "vertical_file"};

// Keys of the other kind of source are not unknown, but out of place.
void out_of_place(Section& section, const std::vector<std::string>& keys, const std::string& with) {
  for (const auto& key : keys)
    if (section.find(key))
      section.problem(
          key, fmt::format("{} does not go with {} (it has no meaning there): remove it", section.name(key), with));
}

// Checks the names and gives each the form that the pulse itself has (c1 -> C1).
void settle_pulse_names(Section& section, sampling::Names& names) {
  for (auto& name : names.values) {
    try {
      name = motion::find_pulse(name).name;
    } catch (const Error& error) {
      section.problem("pulse", section.name("pulse") + ": " + error.what());
    }
  }
}

void read_pulses(Section& section, MotionSource& source) {
  source.kind = MotionSource::Kind::pulses;
  if (const auto names =
          read_names(*section.find("pulse"), section.name("pulse"), section.line("pulse"), section.problems())) {
    source.pulses = *names;
    settle_pulse_names(section, source.pulses);
  }
  source.period = section.quantity("motion", "period_s", period_range);
  const auto acceleration = section.quantity("motion", "peak_acceleration_g", range::any);
  const auto velocity = section.quantity("motion", "peak_velocity_mps", range::any);
  source.amplitude = acceleration ? acceleration : velocity;
  source.pulse_scale = section.number("scale", 1);
  const std::string name = section.name("pulse");
  if (!section.has("period_s")) section.problem("pulse", name + " has no period (a pulse has a length): add period_s");
  if (section.has("peak_acceleration_g") && section.has("peak_velocity_mps"))
    section.problem("peak_velocity_mps",
                    fmt::format("{} and peak_acceleration_g are both given (one determines the other): {}",
                                section.name("peak_velocity_mps"), "remove one"));
  if (!section.has("peak_acceleration_g") && !section.has("peak_velocity_mps"))
    section.problem("pulse",
                    name + " has no amplitude (how strong is it?): add peak_acceleration_g or peak_velocity_mps");
  out_of_place(section, record_keys, "pulse");
}

// Files of a glob, a folder or one file; a problem at the key when there is none.
std::vector<std::filesystem::path> find_files(Section& section, const std::string& key, const std::string& pattern,
                                              const std::filesystem::path& folder, Files look) {
  if (pattern.empty() || look == Files::ignore) return {};
  try {
    return motion::expand_glob(pattern, folder);
  } catch (const Error& error) {
    section.problem(key, section.name(key) + ": " + error.what());
    return {};
  }
}

// A folder holds more than records: what is none is left out, and told. Where a format is named, nothing is judged.
void leave_out_others(Section& section, const std::string& key, const std::string& pattern,
                      const std::filesystem::path& folder, MotionSource& source,
                      std::vector<std::filesystem::path>& files) {
  if (!source.format.empty() || !motion::names_whole_folder(pattern, folder)) return;
  const std::size_t found = files.size();
  std::vector<std::string> others;
  std::erase_if(files, [&](const std::filesystem::path& file) {
    const std::string why = motion::why_no_record(file);
    if (!why.empty()) others.push_back(fmt::format("{} ({})", file.filename().string(), why));
    return !why.empty();
  });
  if (found > 0 && files.empty())
    section.problem(key, fmt::format("{}: {} holds no record ({}): name the folder of the records, or their format",
                                     section.name(key), pattern, some(others)));
  source.no_records.insert(source.no_records.end(), others.begin(), others.end());
}

// Vertical components that a pattern matched are left out; one that is named itself is a problem.
void leave_out_vertical(Section& section, const std::string& key, MotionSource& source) {
  std::string named;
  std::erase_if(source.files, [&](const std::filesystem::path& file) {
    const std::string sign = motion::vertical_sign(file);
    if (sign.empty()) return false;
    source.left_out.push_back(fmt::format("{} ({})", file.filename().string(), sign));
    if (source.records.ends_with(file.filename().string())) named = file.string();
    return true;
  });
  if (source.left_out.empty() || !(source.files.empty() || !named.empty())) return;
  section.problem(key,
                  fmt::format("{}: {} {} (it would shake the floor sideways): give a horizontal component here, and "
                              "this one as {}, with the effect vertical_shaking",
                              section.name(key), joined(source.left_out),
                              source.left_out.size() == 1 ? "is a vertical component" : "are vertical components",
                              key == "file" ? "vertical_file" : "vertical_records"));
}

void read_amplitude(Section& section, MotionSource& source) {
  std::optional<Quantity> peak;
  if (const YAML::Node* node = section.find("scale_to")) {
    Section scale_to(*node, section.name("scale_to"), section.line("scale_to"), section.problems());
    peak = scale_to.quantity("motion", "pta_g", pta_range);
    if (node->IsMap() && !scale_to.has("pta_g"))
      scale_to.problem("pta_g", scale_to.name("pta_g") + " is missing (what are the records scaled to?): add pta_g");
    scale_to.finish();
    if (section.has("scale"))
      section.problem("scale", fmt::format("{} and scale_to are both given (one determines the other): remove one",
                                           section.name("scale")));
  }
  const Quantity factor = section.quantity("motion", "scale", range::any, 1);
  source.amplitude = peak ? *peak : factor;
}

void read_records(Section& section, MotionSource& source, const std::string& key, const std::string& vertical_key,
                  const std::filesystem::path& folder, Files look) {
  source.kind = MotionSource::Kind::records;
  source.records = section.text(key, "");
  source.vertical_records = section.text(vertical_key, "");
  source.dt_s = section.optional_number("dt_s", {.lower = 0, .why = "a time step must be above zero"});
  source.unit = section.text("unit", "");
  source.format = section.text("format", "");
  source.channel = section.text("channel", "");
  read_amplitude(section, source);
  source.files = find_files(section, key, source.records, folder, look);
  leave_out_others(section, key, source.records, folder, source, source.files);
  leave_out_vertical(section, key, source);
  source.vertical_files = find_files(section, vertical_key, source.vertical_records, folder, look);
  leave_out_others(section, vertical_key, source.vertical_records, folder, source, source.vertical_files);
  if (!source.vertical_files.empty() && source.vertical_files.size() != source.files.size())
    section.problem(
        vertical_key,
        fmt::format("{} matches {} files but {} matches {} (they are paired in the order of their names): {}",
                    section.name(vertical_key), source.vertical_files.size(), key, source.files.size(),
                    "make the two patterns match the same records"));
  if (!source.unit.empty()) {
    try {
      motion::acceleration_unit_mps2(source.unit);
    } catch (const Error& error) {
      section.problem("unit", section.name("unit") + ": " + error.what());
    }
  }
  out_of_place(section, pulse_keys, key);
}

MotionSource read_source(Section& section, const std::string& file_key, const std::string& vertical_key,
                         const std::filesystem::path& folder, Files look) {
  MotionSource source;
  const bool pulse = section.find("pulse") != nullptr, file = section.find(file_key) != nullptr;
  if (pulse && file)
    section.problem(file_key, fmt::format("{} and pulse are both given (a motion is one or the other): {}",
                                          section.name(file_key), "make two entries, or remove one"));
  else if (pulse)
    read_pulses(section, source);
  else if (file)
    read_records(section, source, file_key, vertical_key, folder, look);
  else
    section.problem("pulse",
                    fmt::format("a motion has neither pulse nor {} (nothing would shake): add one of them", file_key));
  if (pulse == file)
    for (const auto& keys : {pulse_keys, record_keys, {"scale"}})
      for (const auto& key : keys) section.find(key);
  section.finish();
  return source;
}

}  // namespace

std::vector<MotionSource> read_motions(Section& file, const std::filesystem::path& folder, Files look) {
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
    sources.push_back((*node)[i].IsMap() ? read_source(section, "records", "vertical_records", folder, look)
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
  MotionSource source = read_source(section, "file", "vertical_file", folder, Files::look);
  if (source.pulses.values.size() > 1)
    section.problem("pulse", "motion.pulse is a list (a case is one sample): name one pulse");
  if (source.files.size() > 1)
    section.problem("file",
                    fmt::format("motion.file matches {} files (a case has one motion): name one", source.files.size()));
  return source;
}

}  // namespace freestand::study
