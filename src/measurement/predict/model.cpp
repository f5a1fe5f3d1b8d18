#include "measurement/predict/model.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/chain.hpp"

namespace freestand::measurement {
namespace {

const char* model_name(Model model) {
  constexpr const char* names[] = {"slide", "rock", "slide_rock", "bouc_wen"};
  return names[static_cast<int>(model)];
}

bool excludes(const dynamics::Effect& effect, const std::string& name) {
  return std::find(effect.excludes.begin(), effect.excludes.end(), name) != effect.excludes.end();
}

double dimension(const std::optional<Number>& number, const std::optional<double>& measured, std::span<const double> x,
                 double fallback = 0) {
  return number ? number->of(x) : measured.value_or(fallback);
}

}  // namespace

bool ModelSpec::has(const std::string& name) const {
  return std::any_of(effects.begin(), effects.end(), [&](const EffectTerm& term) { return term.effect->name == name; });
}

Specimen specimen(const ModelSpec& model, const Test& test, std::span<const double> x) {
  Specimen s = specimen(model, test.specimen, x);
  if (const auto own = model.friction_of_test.find(test.id); own != model.friction_of_test.end()) {
    s.friction.mu_k *= own->second.of(x);
    s.friction.mu_s *= own->second.of(x);
  }
  s.start = test.start;
  return s;
}

Specimen specimen(const ModelSpec& model, const Dimensions& measured, std::span<const double> x) {
  Specimen s;
  double width = dimension(model.width, measured.width_m, x);
  double height = dimension(model.height, measured.height_m, x);
  if (model.slenderness && model.size) {
    width = 2 * model.size->of(x) * std::sin(model.slenderness->of(x));
    height = 2 * model.size->of(x) * std::cos(model.slenderness->of(x));
  }
  width *= model.width_factor.of(x);
  const double mass = dimension(model.mass, measured.mass_kg, x, 1);
  auto centre_height = measured.centre_height_m, gyration_radius = measured.gyration_radius_m;
  if (model.centre_height) centre_height = model.centre_height->of(x);
  if (const double factor = model.centre_height_factor.of(x); factor != 1)
    centre_height = factor * centre_height.value_or(height / 2);
  if (model.gyration_radius) gyration_radius = model.gyration_radius->of(x);
  if (model.inertia) gyration_radius = std::sqrt(model.inertia->of(x) / mass);
  s.block = Block::of_outline(width, height, mass, centre_height, gyration_radius);
  s.friction.mu_k = model.mu_k.of(x);
  s.friction.mu_s = s.friction.mu_k;
  if (model.mu_s) s.friction.mu_s = std::max(s.friction.mu_k, model.mu_s->of(x));
  if (model.static_ratio) s.friction.mu_s = s.friction.mu_k * model.static_ratio->of(x);
  const double factor = model.friction_factor.of(x);
  s.friction.mu_k *= factor;
  s.friction.mu_s *= factor;
  s.impact = {model.impact_law, model.impact_factor.of(x)};
  s.model = model.model;
  s.bouc_wen = model.bouc_wen;
  for (const EffectTerm& term : model.effects) {
    EffectUse use{.effect = term.effect, .parameters = {}};
    for (const Number& number : term.parameters) use.parameters.push_back(number.of(x));
    s.effects.push_back(std::move(use));
  }
  if (const auto& chain = model.chain)
    s.effects.push_back(
        dynamics::use({.slack_m = chain->slack.of(x),
                       .stiffness_npm = chain->stiffness.of(x),
                       .strength_n = chain->strength.of(x),
                       .height_m = chain->height ? chain->height->of(x) : s.block.full_height_m(),
                       .side = chain->side,
                       .number = chain->number.of(x),
                       .plan_angle_rad = chain->plan_angle.of(x),
                       .elevation_rad = chain->elevation.of(x),
                       .damping_nspm = chain->damping.of(x),
                       .wall_gap_m = chain->wall_gap ? std::optional(chain->wall_gap->of(x)) : std::nullopt},
                      s.block));
  return s;
}

std::string missing_dimension(const ModelSpec& model, const Test& test) {
  if (model.chain && !model.mass && !test.specimen.mass_kg) return "mass_kg";  // its forces are in newtons
  if (model.slenderness && model.size) return {};
  if (!model.width && !test.specimen.width_m) return "width_m";
  if (!model.height && !test.specimen.height_m) return "height_m";
  return {};
}

Free free_parameter(const dynamics::Effect& effect, const dynamics::Parameter& p, const Reach& reach) {
  Free free{.name = "effects." + effect.name + "." + p.name, .unit = p.unit, .low = p.low, .high = p.high};
  if (p.unit == "m" && p.lower < 0 && reach.greatest_m > reach.least_m) {
    free.low = 1.1 * reach.least_m;
    free.high = 1.1 * reach.greatest_m;
    free.landmarks = {reach.least_m, reach.greatest_m};
  }
  free.logarithmic = free.low > 0 && free.high / free.low >= 4;
  const auto [lower, upper] = fitted_within(p, free.low, free.high);
  free.lower = lower;
  free.upper = upper;
  return free;
}

Bounds fitted_within(const dynamics::Parameter& p, double low, double high) {
  constexpr double beyond = 10;
  const double largest = beyond * std::max(std::abs(low), std::abs(high));
  return {std::max(p.lower, low > 0 ? low / beyond : -largest), std::min(p.upper, largest)};
}

ModelSpec with_effect(const ModelSpec& base, const dynamics::Effect& effect, const Reach& reach) {
  ModelSpec model = base;
  EffectTerm term{.effect = &effect, .parameters = {}};
  for (const auto& parameter : effect.parameters) {
    if (!parameter.fitted) {
      term.parameters.push_back({.value = parameter.fallback.value_or(parameter.low)});
      continue;
    }
    term.parameters.push_back({.free = static_cast<int>(model.free.size())});
    model.free.push_back(free_parameter(effect, parameter, reach));
  }
  model.effects.push_back(std::move(term));
  return model;
}

std::size_t fitted_numbers(const dynamics::Effect& effect) {
  return static_cast<std::size_t>(
      std::count_if(effect.parameters.begin(), effect.parameters.end(), [](const auto& p) { return p.fitted; }));
}

bool goes_with(const ModelSpec& model, const dynamics::Effect& effect) {
  if (model.has(effect.name) || excludes(effect, model_name(model.model))) return false;
  if (model.model == Model::bouc_wen && effect.dynamic()) return false;
  return std::none_of(model.effects.begin(), model.effects.end(), [&](const EffectTerm& term) {
    return excludes(effect, term.effect->name) || excludes(*term.effect, effect.name);
  });
}

}  // namespace freestand::measurement
