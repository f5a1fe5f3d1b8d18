#include "study/read_synthetic.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "motion/pulse.hpp"
#include "study/named_file.hpp"
#include "study/read_parts.hpp"
#include "study/synthetic_set.hpp"
#include "study/yaml_text.hpp"

namespace freestand::study {
namespace {

constexpr std::uint64_t most_motions = 10'000;  // each is held in memory, some tens of kilobytes of it
constexpr Range bandwidth_range = {
    .lower = 0,
    .upper = 1,
    .why = "it is the damping ratio of the filter: at 0 it never comes to rest, from 1 on it does not swing"};

// A number without which there is no motion.
Quantity needed(Section& section, const std::string& prefix, const std::string& key, const Range& range,
                const char* why, const char* example) {
  if (!section.has(key))
    section.problem(key, fmt::format("{} is missing ({}): add {}: {}", section.name(key), why, key, example));
  return section.quantity(prefix, key, range, 1);
}

std::optional<SyntheticPart::Pulse> read_pulse(Section& synthetic) {
  const YAML::Node* node = synthetic.find("pulse");
  if (!node) return {};
  Section section(*node, synthetic.name("pulse"), synthetic.line("pulse"), synthetic.problems());
  SyntheticPart::Pulse pulse;
  const std::string prefix = "synthetic.pulse";
  if (const YAML::Node* type = section.find("type")) {
    if (const auto names = read_names(*type, section.name("type"), section.line("type"), section.problems()))
      pulse.types = *names;
    settle_pulse_names(section, "type", pulse.types);
  } else if (node->IsMap()) {
    section.problem("type", section.name("type") + " is missing (which pulse is it?): add type: B, or [B, C1]");
  }
  if (node->IsMap()) {
    pulse.period = needed(section, prefix, "period_s", range::positive, "a pulse has a length", "1.5");
    pulse.peak_velocity = needed(section, prefix, "peak_velocity_mps", range::any, "how strong is it?", "0.6");
    pulse.middle = needed(section, prefix, "middle_s", range::positive, "when does it come?", "6");
  }
  section.finish();
  return pulse;
}

SyntheticPart read_mapping(const YAML::Node& node, const std::string& path, int line, Problems& problems,
                           const std::string& name) {
  Section section(node, path, line, problems);
  SyntheticPart part;
  if (!node.IsMap()) return part;
  const std::string prefix = "synthetic";
  part.name = section.text("name", name);
  if (part.name.empty() || part.name.find('/') != std::string::npos)
    section.problem("name",
                    fmt::format("{} is no word (files are named by it): write one without /", section.name("name")));
  part.count = static_cast<int>(section.integer("count", 100, 1, most_motions));
  part.arias = needed(section, prefix, "arias_mps", range::positive, "how strong is it?", "0.5");
  part.duration = needed(section, prefix, "duration_s", range::positive, "how long does it last?", "12");
  part.middle = needed(section, prefix, "middle_s", range::positive, "when is it strong?", "8");
  part.frequency = needed(section, prefix, "frequency_hz", range::positive, "how fast does it swing?", "4");
  part.slope = section.quantity(prefix, "frequency_slope_hzps", range::any, 0);
  part.bandwidth = needed(section, prefix, "bandwidth", bandwidth_range, "how mixed are its frequencies?", "0.3");
  part.corner = section.quantity(prefix, "corner_hz", range::positive, 0.1);
  part.step_s = section.number("step_s", part.step_s, range::positive);
  part.pulse = read_pulse(section);
  section.finish();
  return part;
}

std::string pair(const char* key, const Quantity& quantity) {
  return fmt::format("{}: {}", key, to_string(quantity.value));
}

}  // namespace

void read_synthetic(Section& section, MotionSource& source, const std::filesystem::path& folder, Files look) {
  source.kind = MotionSource::Kind::synthetic;
  const YAML::Node* node = section.find("synthetic");
  if (node->IsScalar() && look == Files::look)
    source.synthetic =
        read_named_file(section, "synthetic", folder / section.text("synthetic", ""), read_synthetic_file);
  else if (!node->IsScalar())
    source.synthetic =
        read_mapping(*node, section.name("synthetic"), section.line("synthetic"), section.problems(), "synthetic");
  if (source.synthetic) source.numbers = synthetic_numbers(*source.synthetic);
  read_amplitude(section, source);
}

void check_synthetic(Section& file, const Study& study) {
  std::set<std::string> names;
  for (const MotionSource& source : study.motions) {
    if (!source.synthetic) continue;
    if (!names.insert(source.synthetic->name).second)
      file.problem(
          "motions",
          fmt::format("two sets of synthetic motions are called {} (their draws would be the same): give one of "
                      "them another name",
                      source.synthetic->name));
    if (const std::string why = refusal(*source.synthetic, study.seed); !why.empty()) file.problem("motions", why);
  }
}

SyntheticPart read_synthetic_file(const std::filesystem::path& file) {
  Problems problems(file.string());
  const auto root = parse_yaml(read_text(file), problems);
  const SyntheticPart part = root ? read_mapping(*root, "", 1, problems, file.stem().string()) : SyntheticPart{};
  problems.throw_if_any();
  return part;
}

std::string synthetic_text(const SyntheticPart& part) {
  std::string text = fmt::format(
      "{{name: {}, count: {}, {}", yaml_text(part.name), part.count,
      fmt::join({pair("arias_mps", part.arias), pair("duration_s", part.duration), pair("middle_s", part.middle),
                 pair("frequency_hz", part.frequency), pair("frequency_slope_hzps", part.slope),
                 pair("bandwidth", part.bandwidth), pair("corner_hz", part.corner)},
                ", "));
  text += fmt::format(", step_s: {}", sampling::number_text(part.step_s));
  if (const auto& pulse = part.pulse)
    text += fmt::format(", pulse: {{type: {}, {}, {}, {}}}", to_string(pulse->types), pair("period_s", pulse->period),
                        pair("peak_velocity_mps", pulse->peak_velocity), pair("middle_s", pulse->middle));
  return text + "}";
}

}  // namespace freestand::study
