#include "study/read_validation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "effects/effects.hpp"
#include "study/calibrate_keys.hpp"
#include "study/paths.hpp"
#include "study/read_parts.hpp"

namespace freestand::study {
namespace {

using measurement::ModelSpec;
using measurement::Number;

std::vector<LadderStep> read_ladder(Section& file) {
  std::vector<LadderStep> ladder;
  const YAML::Node* node = file.find("ladder");
  if (!node) return ladder;
  for (std::size_t i = 0; i < node->size(); ++i) {
    Section section((*node)[i], fmt::format("ladder[{}]", i), file.line("ladder"), file.problems());
    const auto number = [&](const char* key) { return section.number(key, std::nan("")); };
    ladder.push_back({section.text("step", "base"), number("error_calibration"), number("error_holdout"),
                      number("noise_floor"), number("noise_floor_holdout"), number("explained_holdout"),
                      number("explained_calibration")});
    section.finish();
  }
  return ladder;
}

// Numbers that the measurements give may be left out of the model.
void fill_dimensions(YAML::Node model, Validation& v) {
  YAML::Node block = model["block"];
  if (!block) model["block"] = block = YAML::Node(YAML::NodeType::Map);
  if (!block.IsMap() || block["slenderness_rad"] || block["size_m"]) {
    v.width_given = v.height_given = true;
    return;
  }
  const auto fill = [&](const char* key, bool& given) {
    given = static_cast<bool>(block[key]);
    if (!given) block[key] = 1;
  };
  fill("width_m", v.width_given);
  fill("height_m", v.height_given);
  fill("mass_kg", v.mass_given);
}

// Every number of the model that is no distribution.
void check_fixed(const ModelPart& model, Problems& problems) {
  for (const Quantity& q : quantities(model))
    if (!is_fixed(q.value) && q.name.rfind("discrepancy.", 0) != 0)
      problems.add(q.line, fmt::format("{} is a distribution (a measured specimen has one value): give a number, or "
                                       "{{calibrate: [lower, upper]}}",
                                       q.name));
}

// What is calibrated must stay within what its effect can be, on the whole of its range.
void check_ranges(const Validation& v, int line, Problems& problems) {
  for (const EffectPart& part : v.model.effects)
    for (std::size_t i = 0; i < part.parameters.size() && i < part.effect->parameters.size(); ++i) {
      const dynamics::Parameter& p = part.effect->parameters[i];
      for (const Calibrated& c : v.calibrated)
        if (c.name == part.parameters[i].name && (c.lower < p.lower || c.upper > p.upper))
          problems.add(part.parameters[i].line ? part.parameters[i].line : line,
                       fmt::format("{}.calibrate is [{}, {}] (it must lie between {} and {}): narrow the range", c.name,
                                   c.lower, c.upper, p.lower, p.upper));
    }
  for (const Calibrated& c : v.calibrated)
    if (c.name.rfind("effects.", 0) != 0 && c.lower < 0)
      problems.add(
          line, fmt::format("{}.calibrate begins at {} (it must not be negative): narrow the range", c.name, c.lower));
}

void read_all(const YAML::Node& root, Validation& v, Problems& problems) {
  Section file(root, "", 1, problems);
  v.name = file.text("name", v.file.stem().string());
  v.folder = read_paths_from(file, v.file);
  if (file.find("measurements")) {
    v.measurements = v.folder / file.text("measurements", "");
    v.measurements_line = file.line("measurements");
  }
  const YAML::Node* node = file.find("model");
  if (!node || !node->IsMap()) {
    file.problem("model",
                 "model is missing or no mapping (what is held against the measurements?): add model: "
                 "{friction: {mu: {calibrate: [0.03, 1.2]}}, effects: []}");
    return;
  }
  YAML::Node model = *node;
  add_missing_parameters(model);
  v.calibrated = take_calibrated(model, problems);
  fill_dimensions(model, v);
  Section section(model, "model", file.line("model"), problems);
  v.model = read_model(section);
  v.placement_scatter = section.optional_number("placement_scatter", range::not_negative);
  section.finish();
  if (v.model.neighbour)
    problems.add(section.line("neighbour"),
                 "neighbour does not go with measurements (what stood beside the block is not in them): remove it");
  if (v.model.friction.ratio_across)
    problems.add(section.line("friction"),
                 "friction.ratio_across does not go with measurements (they are of one direction): remove it");
  if (v.model.legs)
    problems.add(section.line("legs"),
                 "legs does not go with measurements (models are fitted to them on rigid edges): remove it");
  if (section.has("start"))
    problems.add(section.line("start"),
                 "start is of a test (each begins in its own way): write it in dataset.yaml, beside the "
                 "test's id");
  check_fixed(v.model, problems);
  check_ranges(v, file.line("model"), problems);
  v.ladder = read_ladder(file);
  for (const char* key : {"seed", "samples", "until", "keep", "design", "block_size", "tolerance", "free_vibration_s",
                          "motions", "fragility"})
    file.find(key);  // of the sweep that takes the same file
  file.finish();
}

class NumberOf {
 public:
  NumberOf(const Validation& v, bool as_fitted, ModelSpec& spec) : v_(v), as_fitted_(as_fitted), spec_(spec) {}

  Number operator()(const Quantity& quantity) const {
    const double value = std::get<sampling::Fixed>(quantity.value).value;
    for (const Calibrated& c : v_.calibrated) {
      if (c.name != quantity.name) continue;
      if (as_fitted_ && c.value) break;
      spec_.free.push_back({.name = c.name,
                            .unit = unit_of(c.name),
                            .lower = c.lower,
                            .upper = c.upper,
                            .low = c.lower,
                            .high = c.upper,
                            .logarithmic = c.lower > 0 && c.upper / c.lower >= 4});
      return {.value = value, .free = static_cast<int>(spec_.free.size()) - 1};
    }
    return {.value = value};
  }
  std::optional<Number> operator()(const std::optional<Quantity>& quantity, bool given = true) const {
    return quantity && given ? std::optional<Number>((*this)(*quantity)) : std::nullopt;
  }

 private:
  const Validation& v_;
  bool as_fitted_;
  ModelSpec& spec_;
};

}  // namespace

bool Validation::fitted() const {
  return std::all_of(calibrated.begin(), calibrated.end(), [](const Calibrated& c) { return c.value.has_value(); });
}

Validation parse_validation(const std::string& text, const std::filesystem::path& file) {
  Problems problems(file.string());
  Validation v;
  v.file = file;
  v.text = text;
  if (const auto root = parse_yaml(text, problems)) {
    problems.throw_if_any();
    if (!root->IsMap())
      problems.add(1, "the file is no mapping (keys with values are needed): write measurements: and model:");
    else
      read_all(*root, v, problems);
  }
  problems.throw_if_any();
  return v;
}

Validation read_validation(const std::filesystem::path& file) { return parse_validation(read_text(file), file); }

ModelSpec model_spec(const Validation& v, bool as_fitted) {
  ModelSpec spec;
  const NumberOf number(v, as_fitted, spec);
  const ModelPart& m = v.model;
  spec.width = number(m.block.width, v.width_given);
  spec.height = number(m.block.height, v.height_given);
  spec.slenderness = number(m.block.slenderness);
  spec.size = number(m.block.size);
  if (v.mass_given) spec.mass = number(m.block.mass);
  spec.centre_height = number(m.block.centre_height);
  spec.gyration_radius = number(m.block.gyration_radius);
  spec.inertia = number(m.block.inertia);
  spec.mu_k = number(m.friction.mu ? *m.friction.mu : *m.friction.mu_k);
  spec.mu_s = number(m.friction.mu_s);
  spec.static_ratio = number(m.friction.static_ratio);
  spec.model = m.model;
  spec.impact_law = m.impact.law;
  spec.impact_factor = number(m.impact.factor);
  if (const auto& b = m.bouc_wen) {
    const auto fixed = [](const Quantity& q) { return std::get<sampling::Fixed>(q.value).value; };
    spec.bouc_wen = {fixed(b->yield_displacement), fixed(b->exponent), fixed(b->gamma), fixed(b->beta)};
  }
  if (v.placement_scatter)
    spec.placement_scatter = number(Quantity{"placement_scatter", "1", sampling::Fixed{*v.placement_scatter}});
  for (const EffectPart& part : m.effects) {
    measurement::EffectTerm term{.effect = part.effect.get(), .parameters = {}};
    for (const Quantity& q : part.parameters) term.parameters.push_back(number(q));
    spec.effects.push_back(std::move(term));
  }
  if (const auto& chain = m.chain) {
    measurement::ChainTerm term{.slack = number(chain->slack),
                                .stiffness = number(chain->stiffness),
                                .strength = number(chain->strength),
                                .height = number(chain->height),
                                .side = chain->side};
    if (chain->number) term.number = number(*chain->number);
    if (chain->plan_angle) term.plan_angle = number(*chain->plan_angle);
    if (chain->elevation) term.elevation = number(*chain->elevation);
    if (chain->damping) term.damping = number(*chain->damping);
    term.wall_gap = number(chain->wall_gap);
    spec.chain = term;
  }
  return spec;
}

std::vector<double> known_values(const Validation& v) {
  std::vector<double> values;
  if (!v.fitted()) return values;
  for (const auto& free : model_spec(v, false).free)
    for (const Calibrated& c : v.calibrated)
      if (c.name == free.name) values.push_back(*c.value);
  return values;
}

}  // namespace freestand::study
