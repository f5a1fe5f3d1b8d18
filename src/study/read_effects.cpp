// `effects`: entries of the catalogue by name, and formulas.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dynamics/laws.hpp"
#include "effects/effects.hpp"
#include "formula/formula.hpp"
#include "study/read_parts.hpp"

namespace freestand::study {
namespace {

using dynamics::Effect;
using dynamics::Parameter;

std::vector<std::string> effect_names() {
  std::vector<std::string> names;
  for (const auto& effect : effects::all()) names.push_back(effect.name);
  return names;
}

std::string bounds_text(const Parameter& p) {
  const std::string lower = sampling::number_text(p.lower);
  if (!std::isfinite(p.upper)) return fmt::format("it must be {} {}", p.lower_open ? "above" : "at least", lower);
  return fmt::format("it must lie between {} and {}", lower, sampling::number_text(p.upper));
}

// Distributions may reach the bounds themselves, unless the lower one is open.
std::vector<Quantity> read_parameters(Section& section, const Effect& effect) {
  std::vector<Quantity> quantities;
  const std::string prefix = "effects." + effect.name;
  for (const Parameter& parameter : effect.parameters) {
    const std::string why = bounds_text(parameter);
    const Range range{.lower = parameter.lower,
                      .upper = parameter.upper,
                      .lower_open = parameter.lower_open,
                      .upper_open = false,
                      .why = why.c_str()};
    if (!section.has(parameter.name) && !parameter.fallback)
      section.problem(parameter.name, fmt::format("{} is missing ({}): add {}", section.name(parameter.name),
                                                  parameter.summary, parameter.name));
    quantities.push_back(section.quantity(prefix, parameter.name, range,
                                          parameter.fallback.value_or(parameter.neutral.value_or(parameter.low))));
  }
  return quantities;
}

// As a formula may write them, beside the variables.
std::string known_parameters(const std::vector<std::string>& names) {
  std::vector<std::string> short_names;
  for (const auto& name : names) short_names.emplace_back(without_unit(name));
  return names.empty() ? "; it has no parameters"
                       : fmt::format("; its parameters are {}", fmt::join(short_names, ", "));
}

// Laws take their parameters as they are given: in SI.
void check_unit(Section& section, const std::string& effect, const std::string& parameter) {
  if (in_si(parameter)) return;
  section.problem(
      "parameters",
      fmt::format("parameter {} of effect {} has a unit that is not of SI ({}; a formula takes the number as "
                  "it stands): convert the value, and give the name the ending of its SI unit, or one "
                  "that is no unit",
                  parameter, effect, unit_of(parameter)));
}

std::shared_ptr<const Effect> make_formula(Section& section, const EffectPart& part,
                                           const std::vector<std::string>& parameters) {
  for (const char* key : {"friction", "force"}) {
    const std::string& text = std::string(key) == "friction" ? part.friction : part.force;
    if (text.empty()) continue;
    try {
      formula::Formula(text, parameters);
    } catch (const formula::FormulaError& error) {
      const std::size_t place = std::min(error.position(), text.size());
      section.problem(
          key, fmt::format("{} of effect {} does not parse ({}, character {}{}): correct it\n    {}\n    {:>{}}", key,
                           part.name, error.what(), place + 1, known_parameters(parameters), text, '^', place + 1));
      return nullptr;
    }
  }
  return std::make_shared<const Effect>(formula::effect(part.name, part.friction, part.force, parameters));
}

// A law must give a finite number from rest on, and friction that resists; looked at where the parameters are numbers.
void check_values(Section& section, const EffectPart& part, const std::vector<std::string>& names) {
  std::vector<double> parameters;
  for (const Quantity& q : part.parameters) {
    if (!is_fixed(q.value)) return;
    parameters.push_back(std::get<sampling::Fixed>(q.value).value);
  }
  // At rest, and in slips either way.
  const std::vector<formula::Inputs> states = {{0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 0},
                                               {0, 0, 0, 0, 0, 0, 1, 0, -1, 0, 0},
                                               {0.01, 0.2, 0, 0, 1, 0.01, 1, 0, 1, 0.2, 0},
                                               {-0.01, -0.2, 0, 0, 1, 0.01, 1, 0, -1, 0.2, 0},
                                               {0, 0, 0, 0, 1, 0, 1, 0, 1, 0, 1}};
  for (const char* key : {"friction", "force"}) {
    const bool friction = std::string(key) == "friction";
    const std::string& text = friction ? part.friction : part.force;
    if (text.empty()) continue;
    const formula::Formula law(text, names);
    for (const auto& state : states) {
      const std::string where =
          fmt::format("at u = {} m, v = {} m/s, t = {} s, path = {} m", state[0], state[1], state[4], state[5]);
      const double low = law.value(state, 0.05, parameters), high = law.value(state, 1, parameters);
      if (!std::isfinite(low) && !std::isfinite(high))
        return section.problem(key, fmt::format("{} of effect {} is {} {} (a law must give a finite number from rest "
                                                "on): keep it away from such places, for example by max(...)",
                                                key, part.name, std::isnan(low) ? "no number" : "infinite", where));
      if (friction && low < 0 && high < 0)
        return section.problem(key, fmt::format("friction of effect {} is {:.3g} {} (below zero it would push the "
                                                "block on): correct the signs",
                                                part.name, law.value(state, 0.3, parameters), where));
    }
  }
}

void check_used(Section& section, const EffectPart& part, const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    bool used = false;
    for (const std::string* text : {&part.friction, &part.force})
      used |= !text->empty() && formula::Formula(*text, names).uses(i);
    if (!used)
      section.problem("parameters", fmt::format("parameter {} of effect {} stands in none of its formulas (it would do "
                                                "nothing): use or remove it",
                                                names[i], part.name));
  }
}

EffectPart read_formula(Section& section, const std::string& name) {
  EffectPart part{.name = name, .parameters = {}};
  part.friction = section.text("friction", "");
  part.force = section.text("force", "");
  std::vector<std::string> names;
  if (const YAML::Node* node = section.find("parameters")) {
    Section values(*node, section.name("parameters"), section.line("parameters"), section.problems());
    if (node->IsMap())
      for (const auto& item : *node) {
        names.push_back(item.first.Scalar());
        part.parameters.push_back(values.quantity("effects." + name, names.back(), range::any, 0));
      }
  }
  for (const auto& parameter : names) check_unit(section, name, parameter);
  for (const auto& parameter : names)
    if (formula::is_variable(parameter) || formula::is_variable(std::string(without_unit(parameter))))
      section.problem("parameters",
                      fmt::format("parameter {} of effect {} has the name of a variable (formulas know it "
                                  "already): choose another name",
                                  parameter, name));
  part.effect = make_formula(section, part, names);
  if (part.effect) {
    check_used(section, part, names);
    check_values(section, part, names);
    if (const std::string leap = leap_that_holds(part); !leap.empty()) section.problem("name", leap);
  }
  return part;
}

// The effect of an entry; without one where the entry is wrong.
EffectPart read_effect(Section& section) {
  const std::string name = section.text("name", "");
  if (name.empty()) {
    section.problem("name", fmt::format("{} is missing (an effect is chosen by its name): add name: {}",
                                        section.name("name"), "static_friction, or another of `freestand effects`"));
    return {};
  }
  const Effect* known = effects::find(name);
  const bool written = section.has("friction") || section.has("force");
  if (known && written) {
    section.problem("name", fmt::format("effect {} has a formula, and is in the catalogue (one name, one law): give "
                                        "the formula another name",
                                        name));
    return {};
  }
  if (known) return {name, read_parameters(section, *known), {}, {}, {std::shared_ptr<void>(), known}};
  if (written) return read_formula(section, name);
  section.problem("name", fmt::format("effect {} is not known ({}): choose one of `freestand effects`, or give it a "
                                      "formula, friction: \"...\" or force: \"...\"",
                                      name, hint(name, effect_names())));
  return {};
}

void check_company(Section& section, const EffectPart& part, const std::vector<EffectPart>& others, Model model) {
  constexpr const char* models[] = {"slide", "rock", "slide_rock", "bouc_wen"};
  const std::string in_model = models[static_cast<int>(model)];
  const auto excluded = [](const Effect& effect, const std::string& name) {
    return std::find(effect.excludes.begin(), effect.excludes.end(), name) != effect.excludes.end();
  };
  const bool other_wall = part.effect->wall && model == Model::rock;
  if (excluded(*part.effect, in_model))
    section.problem("name", fmt::format("effect {} does not go with model {} ({}): remove it, or choose another model",
                                        part.name, in_model,
                                        other_wall ? "the only wall there is the one behind a chain, chain.wall_gap_m"
                                                   : "it has nothing to act on there"));
  for (const EffectPart& other : others) {
    if (other.name == part.name)
      section.problem(
          "name", fmt::format("effect {} stands twice (it acts once{}): remove one", part.name,
                              part.effect->wall ? "; other_gap_m is how far a second wall is, on the other side" : ""));
    else if (excluded(*part.effect, other.name) || excluded(*other.effect, part.name))
      section.problem("name", fmt::format("effects {} and {} exclude each other (their laws cannot act together): "
                                          "remove one",
                                          other.name, part.name));
  }
}

}  // namespace

std::vector<EffectPart> read_effects(Section& file, Model model) {
  std::vector<EffectPart> effects;
  const YAML::Node* node = file.find("effects");
  if (!node) return effects;
  if (!node->IsSequence()) {
    file.problem("effects", "effects is no list (each effect is an entry): write effects: [{name: vertical_shaking}]");
    return effects;
  }
  if (lacks_braces(*node, "effects", file.line("effects"), file.problems())) return effects;
  for (std::size_t i = 0; i < node->size(); ++i) {
    const int line = line_of((*node)[i]) ? line_of((*node)[i]) : file.line("effects");
    Section section((*node)[i], fmt::format("effects[{}]", i), line, file.problems());
    if (!(*node)[i].IsMap()) continue;
    EffectPart effect = read_effect(section);
    if (!effect.effect) continue;
    section.finish();
    check_company(section, effect, effects, model);
    const bool room = no_room_for(effects, {}).empty();
    effects.push_back(std::move(effect));
    if (const std::string text = room ? no_room_for(effects, {}) : ""; !text.empty()) section.problem("name", text);
  }
  return effects;
}

}  // namespace freestand::study
