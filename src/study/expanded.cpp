// The whole study as text, every default written out.
#include <fmt/format.h>

#include <algorithm>

#include "base/random.hpp"
#include "study/paths.hpp"
#include "study/read_building.hpp"
#include "study/read_parts.hpp"
#include "study/read_synthetic.hpp"
#include "study/study.hpp"
#include "study/yaml_text.hpp"

namespace freestand::study {
namespace {

using sampling::number_text;

std::string list(const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(number_text(value));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

// Last part of a dotted name.
std::string key_of(const Quantity& quantity) { return quantity.name.substr(quantity.name.rfind('.') + 1); }

std::string pair(const Quantity& quantity) { return key_of(quantity) + ": " + to_string(quantity.value); }

class Mapping {
 public:
  void add(const std::string& key, const std::string& value) { entries_.push_back(key + ": " + value); }
  void add(const std::optional<Quantity>& quantity) {
    if (quantity) entries_.push_back(pair(*quantity));
  }
  std::string flow() const { return fmt::format("{{{}}}", fmt::join(entries_, ", ")); }
  // One entry a line, the first after a dash; or all of them below a key.
  std::string item() const { return fmt::format("  - {}\n", fmt::join(entries_, "\n    ")); }
  std::string block() const { return fmt::format("  {}\n", fmt::join(entries_, "\n  ")); }

 private:
  std::vector<std::string> entries_;
};

std::string block_text(const BlockPart& block) {
  Mapping m;
  for (const auto& quantity : {block.width, block.height, block.slenderness, block.size}) m.add(quantity);
  m.add(block.mass);
  for (const auto& quantity : {block.centre_height, block.gyration_radius, block.inertia}) m.add(quantity);
  return m.flow();
}

std::string friction_text(const FrictionPart& friction) {
  Mapping m;
  for (const auto& quantity :
       {friction.mu, friction.mu_k, friction.mu_s, friction.static_ratio, friction.ratio_across, friction.axis})
    m.add(quantity);
  return m.flow();
}

std::string effects_text(const std::vector<EffectPart>& effects) {
  if (effects.empty()) return " []\n";
  std::string text = "\n";
  for (const auto& effect : effects) {
    Mapping m;
    m.add("name", yaml_text(effect.name));
    if (effect.friction.empty() && effect.force.empty()) {
      for (const auto& quantity : effect.parameters) m.add(quantity);
    } else {
      if (!effect.friction.empty()) m.add("friction", yaml_text(effect.friction));
      if (!effect.force.empty()) m.add("force", yaml_text(effect.force));
      Mapping parameters;
      for (const auto& quantity : effect.parameters) parameters.add(quantity);
      m.add("parameters", parameters.flow());
    }
    text += m.item();
  }
  return text;
}

std::string bouc_wen_text(const std::optional<BoucWenPart>& part) {
  if (!part) return "";
  Mapping m;
  for (const auto& quantity : {part->yield_displacement, part->exponent, part->gamma, part->beta}) m.add(quantity);
  return fmt::format("bouc_wen: {}\n", m.flow());
}

std::string model_text(const ModelPart& model) {
  constexpr const char* models[] = {"slide", "rock", "slide_rock", "bouc_wen"};
  constexpr const char* laws[] = {"housner", "coulomb"};
  return fmt::format("block: {}\nfriction: {}\nmodel: {}\n{}impact: {{law: {}, {}}}\neffects:{}",
                     block_text(model.block), friction_text(model.friction), models[static_cast<int>(model.model)],
                     bouc_wen_text(model.bouc_wen), laws[static_cast<int>(model.impact.law)], pair(model.impact.factor),
                     effects_text(model.effects));
}

std::string chain_text(const std::optional<ChainPart>& chain) {
  if (!chain) return "";
  Mapping m;
  for (const auto& quantity : {chain->slack, chain->stiffness, chain->strength}) m.add(quantity);
  for (const auto& quantity : {chain->height, chain->number, chain->plan_angle, chain->elevation, chain->damping})
    m.add(quantity);
  m.add(chain->wall_gap);
  m.add("side", chain->side > 0 ? "right" : "left");
  return "chain: " + m.flow() + "\n";
}

std::string neighbour_text(const std::optional<NeighbourPart>& neighbour) {
  if (!neighbour) return "";
  Mapping m;
  for (const auto& quantity : neighbour->given()) m.add(quantity);
  m.add("side", neighbour->side > 0 ? "right" : "left");
  return "neighbour: " + m.flow() + "\n";
}

std::string legs_text(const std::optional<LegsPart>& legs) {
  if (!legs) return "";
  Mapping m;
  m.add(legs->frequency);
  m.add(legs->damping);
  return "legs: " + m.flow() + "\n";
}

std::string start_text(const StartPart& start) {
  Mapping m;
  for (const auto& quantity : start.given()) m.add(quantity);
  return start.any() ? "start: " + m.flow() + "\n" : "";
}

// The block, what holds it and what stands beside it, and how it begins.
std::string specimen_text(const ModelPart& model) {
  return model_text(model) + chain_text(model.chain) + neighbour_text(model.neighbour) + legs_text(model.legs) +
         start_text(model.start);
}

std::string height_text(const Study& study) {
  return study.acceleration_height_m
             ? fmt::format("acceleration_height_m: {}\n", number_text(*study.acceleration_height_m))
             : "";
}

std::string discrepancy_text(const std::optional<Quantity>& slip) {
  if (!slip) return "";
  Mapping m;
  m.add(*slip);
  return "discrepancy: " + m.flow() + "\n";
}

void add_amplitude(const MotionSource& source, Mapping& m) {
  if (!source.scale_to) return m.add(source.amplitude);
  Mapping target;
  target.add(source.amplitude);
  if (source.scale_to->period_s) target.add(source.scale_to->parameter, number_text(*source.scale_to->period_s));
  m.add("scale_to", target.flow());
}

void add_processing(const motion::Processing& processing, Mapping& m) {
  constexpr const char* baselines[] = {"linear", "quadratic"};
  if (processing.baseline) m.add("baseline", baselines[static_cast<int>(*processing.baseline)]);
  if (processing.band) m.add("band_pass_hz", list({processing.band->low_hz, processing.band->high_hz}));
  if (!processing.scale) return;
  m.add("time_scale", number_text(processing.scale->time));
  m.add("length_scale", number_text(processing.scale->length));
}

void add_turn(const std::optional<TurnPart>& turn, Mapping& m) {
  if (!turn) return;
  if (turn->to == TurnPart::To::angle) return m.add("rotate_deg", number_text(turn->angle_deg));
  m.add("rotate", turn->to == TurnPart::To::fault_normal ? "fault_normal" : "fault_parallel");
}

// The keys of recorded motions.
struct FileKeys {
  const char *file, *vertical, *cross;
};
Mapping source_mapping(const MotionSource& source, const FileKeys& keys) {
  Mapping m;
  if (source.kind == MotionSource::Kind::pulses) {
    m.add("pulse", to_string(source.pulses));
    m.add(source.period);
    add_amplitude(source, m);
    if (!source.scale_to) m.add("scale", number_text(source.pulse_scale));
  } else if (source.kind == MotionSource::Kind::synthetic) {
    if (source.synthetic) m.add("synthetic", synthetic_text(*source.synthetic));
    add_amplitude(source, m);
    if (source.building) m.add("building", building_text(*source.building));
    m.add(source.storey);
  } else {
    m.add(keys.file, yaml_text(source.records));
    if (!source.vertical_records.empty()) m.add(keys.vertical, yaml_text(source.vertical_records));
    if (!source.cross_records.empty()) m.add(keys.cross, yaml_text(source.cross_records));
    add_amplitude(source, m);
    if (source.dt_s) m.add("dt_s", number_text(*source.dt_s));
    if (!source.unit.empty()) m.add("unit", yaml_text(source.unit));
    if (!source.format.empty()) m.add("format", yaml_text(source.format));
    if (!source.channel.empty()) m.add("channel", yaml_text(source.channel));
    if (!source.group.empty()) m.add("group", yaml_text(source.group));
    if (source.building) m.add("building", building_text(*source.building));
    m.add(source.storey);
    if (!source.pulse.type.empty()) m.add("pulse_type", source.pulse.type);
    if (source.pulse.period_s) m.add("pulse_period_s", number_text(*source.pulse.period_s));
    add_turn(source.turn, m);
    if (source.begin_together) m.add("begin_together", "true");
    add_processing(source.processing, m);
  }
  return m;
}

std::string source_text(const MotionSource& source) {
  Mapping m = source_mapping(source, {"records", "vertical_records", "cross_records"});
  m.add("weight", number_text(source.weight));
  return m.item();
}

// Does anything of the study lie where a relative path says?
bool has_relative_paths(const Study& study) {
  const auto relative = [](const std::string& path) {
    return !path.empty() && !std::filesystem::path(path).is_absolute();
  };
  return std::any_of(study.motions.begin(), study.motions.end(), [&](const MotionSource& source) {
    return relative(source.records) || relative(source.vertical_records) || relative(source.cross_records);
  });
}

std::string paths_from(const Study& study, const std::filesystem::path& folder) {
  const std::string way = way_between(folder, study.folder);
  return way.empty() || !has_relative_paths(study) ? "" : fmt::format("paths_from: {}\n", yaml_text(way));
}

std::string bins_text(const BinsPart& bins) {
  constexpr const char* spacings[] = {"equal_width", "equal_count", "log"};
  if (!bins.edges.empty()) return fmt::format("{{edges: {}}}", list(bins.edges));
  if (bins.width > 0) return fmt::format("{{width: {}}}", number_text(bins.width));
  return fmt::format("{{count: {}, spacing: {}}}", bins.count, spacings[static_cast<int>(bins.spacing)]);
}

std::string intensity_text(const IntensityPart& im) {
  if (!im.period_s) return yaml_text(im.name);
  return fmt::format("{{name: {}, {}: {}}}", yaml_text(im.name), im.parameter, number_text(*im.period_s));
}

std::string fragility_text(const FragilityPart& f) {
  std::string text = "fragility:\n  im: " + intensity_text(f.im);
  text += fmt::format("\n  bins: {}\n  edp: [{}]\n  capacities:", bins_text(f.bins), fmt::join(f.edp, ", "));
  if (f.capacities.empty()) text += " {}";
  for (const auto& part : f.capacities) text += fmt::format("\n    {}: {}", part.edp, list(part.values));
  text += "\n  still:";
  if (f.still.empty()) text += " {}";
  for (const auto& [edp, threshold] : f.still) text += fmt::format("\n    {}: {}", edp, number_text(threshold));
  if (!f.damage.empty()) text += "\n  damage:";
  for (const auto& state : f.damage) {
    text += fmt::format("\n    {}:\n      when: {}", state.name, yaml_text(state.when));
    Mapping parameters;
    for (const auto& parameter : state.parameters) parameters.add(parameter);
    if (!state.parameters.empty()) text += fmt::format("\n      parameters: {}", parameters.flow());
  }
  text += "\n  axes:";
  if (f.axes.empty()) text += " []";
  for (const auto& axis : f.axes)
    text += fmt::format("\n    - {{name: {}, bins: {}}}", axis.name, bins_text(axis.bins));
  if (!f.target.empty()) text += "\n  target:";
  for (const Quantity& target : f.target) text += fmt::format("\n    {}: {}", target.name, to_string(target.value));
  return text + fmt::format(
                    "\n  resamples: {}\n  confidence: {}\n  minimum_samples: {}\n  false_discovery: {}\n"
                    "  adequate: {}\n  empirical_fallback: {}\n",
                    f.resamples, number_text(f.confidence), f.minimum_samples, number_text(f.false_discovery),
                    number_text(f.adequate), f.empirical_fallback);
}

std::string until_text(const UntilPart& until) {
  std::string text = fmt::format("until: {{half_width: {}, ", number_text(until.half_width));
  if (until.relative_error)
    text += fmt::format("relative_error: {}, down_to: {}, ", number_text(*until.relative_error),
                        number_text(until.down_to));
  return text + fmt::format("at_most: {}{}}}\n", until.at_most, until.everywhere ? ", everywhere: true" : "");
}

std::string keep_text(const KeepPart& keep) {
  return keep.one_in == 0 ? "none" : fmt::format("{{thin: {}}}", keep.one_in);
}

std::string forces_text(const Study& study) { return study.contact_forces ? "contact_forces: true\n" : ""; }

// What makes the samples: all but the name and the fragility block.
std::string samples_text(const Study& study) {
  std::string text = fmt::format("seed: {}\n", study.seed);
  if (study.until)
    text += until_text(*study.until);
  else
    text += fmt::format("samples: {}\n", study.samples);
  if (study.keep.one_in != 1) text += fmt::format("keep: {}\n", keep_text(study.keep));
  text += fmt::format("design: {}\n", name(study.design));
  text += height_text(study) + forces_text(study);
  if (study.slip_by_side) text += "slip_by_side: true\n";
  if (study.scrambles > 1) text += fmt::format("scrambles: {}\n", study.scrambles);
  text += fmt::format("block_size: {}\ntolerance: {}\nfree_vibration_s: {}\n", study.block_size,
                      number_text(study.tolerance), number_text(study.free_vibration_s));
  return text + specimen_text(study.model) + discrepancy_text(study.model.slip_discrepancy) +
         motions_text(study.motions);
}

std::string all_but_name(const Study& study) { return samples_text(study) + fragility_text(study.fragility); }

}  // namespace

std::string motions_text(const std::vector<MotionSource>& motions) {
  std::string text = "motions:\n";
  for (const auto& source : motions) text += source_text(source);
  return text;
}

std::string expanded(const Study& study) { return "name: " + yaml_text(study.name) + "\n" + all_but_name(study); }

std::string expanded(const Study& study, const std::filesystem::path& folder) {
  return paths_from(study, folder) + expanded(study);
}

std::string expanded(const Case& one, const std::filesystem::path& folder) {
  const Study& study = one.study;
  return paths_from(study, folder) +
         fmt::format("name: {}\ntolerance: {}\nfree_vibration_s: {}\n", yaml_text(study.name),
                     number_text(study.tolerance), number_text(study.free_vibration_s)) +
         height_text(study) + forces_text(study) + specimen_text(study.model) + "motion:\n" +
         source_mapping(study.motions.front(), {"file", "vertical_file", "cross_file"}).block() +
         fmt::format("output_step_s: {}\n", number_text(one.output_step_s));
}

std::string fingerprint(const Study& study) {
  // The first word changes whenever the same study begins to give other numbers.
  return fmt::format("{:016x}", random::stable_hash("freestand-draws/1\n" + all_but_name(study)));
}

std::string samples_fingerprint(const Study& study) {
  return fmt::format("{:016x}", random::stable_hash("freestand-draws/2\n" + samples_text(study)));
}

}  // namespace freestand::study
