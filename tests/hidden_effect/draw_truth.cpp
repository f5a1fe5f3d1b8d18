#include "hidden_effect/draw_truth.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace freestand::test {
namespace {

enum class Draw { as_it_is, either_sign, or_its_inverse };
// Where the effect vanishes: its strength is how far the parameter lies from there. Others stay where they are.
enum class Nothing { elsewhere, zero, one, far };

struct Range {
  std::string key;
  double low, high;
  Draw draw = Draw::as_it_is;
  Nothing nothing = Nothing::elsewhere;
};

double weakened(double value, Nothing nothing, double strength) {
  switch (nothing) {
    case Nothing::zero:
      return strength * value;
    case Nothing::one:
      return 1 + strength * (value - 1);
    case Nothing::far:
      return value / strength;
    case Nothing::elsewhere:
      break;
  }
  return value;
}

const std::map<std::string, std::vector<Range>>& strengths() {
  static const std::map<std::string, std::vector<Range>> all{
      {"static_friction", {{"ratio", 1.25, 1.8, Draw::as_it_is, Nothing::one}}},
      {"rate_weakening", {{"drop", 0.2, 0.55, Draw::as_it_is, Nothing::zero}, {"speed_mps", 0.04, 0.3}}},
      {"rate_strengthening", {{"rise", 0.25, 0.9, Draw::as_it_is, Nothing::zero}, {"speed_mps", 0.04, 0.3}}},
      {"friction_wear", {{"ratio", 1.3, 1.7, Draw::or_its_inverse, Nothing::one}, {"path_m", 0.1, 1}}},
      {"directional_friction", {{"asymmetry", 0.06, 0.25, Draw::either_sign, Nothing::zero}}},
      {"pressure_friction", {{"exponent", 0.2, 0.4, Draw::either_sign, Nothing::zero}}},
      {"viscous_drag", {{"rate_per_s", 0.4, 5, Draw::as_it_is, Nothing::zero}}},
      {"floor_tilt", {{"angle_rad", 0.01, 0.04, Draw::either_sign, Nothing::zero}}},
      {"vertical_shaking", {}},
      {"flexible_legs", {{"frequency_hz", 2, 7, Draw::as_it_is, Nothing::far}, {"damping", 0.01, 0.06}}},
      {"slack_tether",
       {{"slack_m", 0.01, 0.06, Draw::either_sign, Nothing::far}, {"frequency_hz", 0.7, 4}, {"rate_per_s", 0.1, 3}}},
      {"centering_spring", {{"frequency_hz", 0.2, 1.1, Draw::as_it_is, Nothing::zero}}},
      {"wall_impact", {{"gap_m", 0.01, 0.06, Draw::either_sign, Nothing::far}, {"restitution", 0.1, 0.7}}},
      {"moving_contents",
       {{"mass_ratio", 0.15, 0.45, Draw::as_it_is, Nothing::zero}, {"frequency_hz", 0.7, 4}, {"damping", 0.02, 0.12}}},
      {"impact_loss", {{"factor", 0.72, 0.95, Draw::as_it_is, Nothing::one}}},
      {"reduced_base", {{"ratio", 0.05, 0.2, Draw::as_it_is, Nothing::zero}}},
      {"offset_mass", {{"eccentricity", 0.06, 0.2, Draw::either_sign, Nothing::zero}}},
      {"rough_floor", {{"ratio", 0.3, 0.6, Draw::as_it_is, Nothing::zero}, {"length_m", 0.05, 0.2}}},
      {"friction_heating", {{"rise", 0.4, 1, Draw::as_it_is, Nothing::zero}, {"time_s", 2, 8}}},
      {"quadratic_drag", {{"per_m", 1, 8, Draw::as_it_is, Nothing::zero}}},
      {"stick_ageing", {{"rise", 0.15, 0.45, Draw::as_it_is, Nothing::zero}, {"time_s", 0.02, 0.4}}},
  };
  return all;
}

// Three in ten of those that show on both kinds of block are slender.
Habit draw_habit(KeyedRandom& random, const std::vector<std::string>& effects) {
  const auto any = [&](std::initializer_list<const char*> names) {
    return std::any_of(effects.begin(), effects.end(), [&](const std::string& effect) {
      return std::find(names.begin(), names.end(), effect) != names.end();
    });
  };
  const bool slender = random.chance(0.3);
  if (any({"impact_loss", "reduced_base", "offset_mass"})) return Habit::rocks;
  if (any({"pressure_friction"}) && !any({"vertical_shaking"})) return Habit::slides_and_rocks;
  const bool on_both = std::all_of(effects.begin(), effects.end(), [](const std::string& effect) {
    return effect == "floor_tilt" || effect == "vertical_shaking";
  });
  return on_both && slender ? Habit::rocks : Habit::slides;
}

}  // namespace

TruthEffect draw_effect(KeyedRandom& random, const std::string& name, double strength) {
  const auto found = strengths().find(name);
  if (found == strengths().end()) throw std::invalid_argument("no effect is called " + name);
  TruthEffect effect{name, {}};
  for (const Range& range : found->second) {
    double& value = effect.parameters[range.key];
    value = random.log_uniform(range.low, range.high);
    const bool other = random.chance(0.5);
    if (range.draw == Draw::either_sign && other) value = -value;
    if (range.draw == Draw::or_its_inverse && other) value = 1 / value;
    value = weakened(value, range.nothing, strength);
  }
  return effect;
}

DrawnTruth draw_truth(KeyedRandom& random, const std::vector<std::string>& effects, double strength) {
  DrawnTruth d;
  d.habit = draw_habit(random, effects);
  double mu = 0;
  if (d.habit == Habit::slides) {
    d.width_m = random.uniform(0.7, 0.95);
    d.height_m = random.uniform(0.5, 0.75);
    mu = random.uniform(0.12, 0.32);
  } else {
    d.height_m = random.uniform(1.2, 1.7);
    d.width_m = d.height_m * random.uniform(0.26, 0.4);
    mu = d.habit == Habit::rocks ? random.uniform(0.6, 0.8) : d.width_m / d.height_m * random.uniform(1.01, 1.12);
  }
  d.mass_kg = random.uniform(60, 260);
  std::vector<TruthEffect> drawn;
  for (const std::string& name : effects) drawn.push_back(draw_effect(random, name, strength));
  d.truth = rectangular_truth(d.width_m, d.height_m, mu, drawn);
  return d;
}

}  // namespace freestand::test
