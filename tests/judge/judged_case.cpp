#include "judge/judged_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "effects/effects.hpp"
#include "hidden_effect/draw_truth.hpp"
#include "hidden_effect/shaking.hpp"

namespace freestand::test {
namespace {

constexpr double g = standard_gravity_mps2, floor_step_s = 0.005, most_mu = 0.65;

bool excludes(const std::string& effect, const std::string& other) {
  const effects::Effect* found = effects::find(effect);
  if (!found) return effect == "stick_ageing" && other == "bouc_wen";  // a contact that never stands still
  return std::find(found->excludes.begin(), found->excludes.end(), other) != found->excludes.end();
}

bool go_together(const std::string& a, const std::string& b) {
  if (a == b) return a == "slack_tether" || a == "wall_impact";
  return !excludes(a, b) && !excludes(b, a);
}

const char* model_name(TruthModel model) {
  static constexpr const char* names[] = {"slide", "rock", "slide_rock", "bouc_wen"};
  return names[static_cast<int>(model)];
}

bool goes_with(const std::vector<std::string>& effects, TruthModel model) {
  return std::none_of(effects.begin(), effects.end(),
                      [&](const std::string& effect) { return excludes(effect, model_name(model)); });
}

bool possible(const Recipe& recipe) {
  const auto holds = [&](const char* effect) {
    return std::find(recipe.effects.begin(), recipe.effects.end(), effect) != recipe.effects.end();
  };
  switch (recipe.setting) {
    case Setting::slide:
      return goes_with(recipe.effects, TruthModel::slide);
    case Setting::rock:
      return goes_with(recipe.effects, TruthModel::rock);
    case Setting::bouc_wen:
      return goes_with(recipe.effects, TruthModel::bouc_wen);
    case Setting::thrown:
      return !holds("vertical_shaking");  // it is in there anyway
    case Setting::on_a_slope:
      return !holds("floor_tilt");
    default:
      return true;
  }
}

TruthModel draw_model(KeyedRandom& random, const Recipe& recipe) {
  switch (recipe.setting) {
    case Setting::slide:
      return TruthModel::slide;
    case Setting::rock:
      return TruthModel::rock;
    case Setting::slide_rock:
      return TruthModel::slide_rock;
    case Setting::bouc_wen:
      return TruthModel::bouc_wen;
    default:
      break;
  }
  const double which = random.unit();
  const TruthModel model = which < 0.7 ? TruthModel::slide_rock : which < 0.85 ? TruthModel::slide : TruthModel::rock;
  return goes_with(recipe.effects, model) ? model : TruthModel::slide_rock;
}

// Half width over height of the centre of mass from 0.12 to 1.2, friction about that ratio, so that the block slides,
// rocks, or does both. Friction stays well under 4/3, Painleve's paradox, with the effects that raise it.
Truth draw_block(KeyedRandom& random, TruthModel model, bool chained) {
  const double height_m = random.log_uniform(0.6, 2.4), slenderness = random.log_uniform(0.12, 1.2);
  double mu = slenderness * random.log_uniform(0.5, 2);
  if (model == TruthModel::slide || model == TruthModel::bouc_wen) mu = random.log_uniform(0.08, 0.6);
  Truth truth = rectangular_truth(slenderness * height_m, height_m, std::min(mu, most_mu));
  if (!chained && random.chance(0.25)) {  // a chain's face is told by the width alone
    truth.left_m *= random.uniform(0.75, 1.2);
    truth.right_m *= random.uniform(0.75, 1.2);
    truth.gyration2_m2 *= random.uniform(0.85, 1.2);
  }
  if (random.chance(0.25)) truth.mu_s *= random.uniform(1.05, 1.5);
  truth.model = model;
  truth.impact = random.chance(0.4) ? TruthImpact::coulomb : TruthImpact::housner;
  return truth;
}

// From the report's stiffest contact, 1e-5 in, to a soft one. Other than gamma = beta it unloads along a curve.
TruthContact draw_contact(KeyedRandom& random) {
  TruthContact contact;
  contact.yield_m = random.chance(0.1) ? 2.54e-7 : random.log_uniform(1e-5, 1e-2);
  contact.exponent = random.chance(0.4) ? std::floor(random.uniform(1, 4)) : random.log_uniform(1, 40);
  if (random.chance(0.4)) {
    contact.gamma = random.uniform(0.3, 1);
    contact.beta = contact.gamma * random.uniform(-0.6, 1);
  }
  return contact;
}

// A second tether or wall stands on the other side.
void to_other_side(TruthEffect& effect, const TruthEffect& first) {
  for (const char* key : {"slack_m", "gap_m"}) {
    if (!effect.parameters.count(key)) continue;
    double& own = effect.parameters[key];
    if (own == 0) own = 0.03;
    own = std::copysign(own, first.parameters.at(key) < 0 ? 1 : -1);
  }
}

TruthEffect draw_chain(KeyedRandom& random, const Truth& truth) {
  const double circular = 2 * pi * random.log_uniform(1, 8), steepest = 1.2;
  const bool level = truth.model == TruthModel::bouc_wen || random.chance(0.4);
  return {"chain",
          {{"side", random.chance(0.5) ? 1 : -1},
           {"height_m", random.uniform(0.6, 2) * truth.height_m},
           {"slack_m", random.chance(0.3) ? 0 : random.uniform(0, 0.03)},
           {"stiffness_per_s2", circular * circular},
           {"strength_mps2", random.chance(0.5) ? 1e3 : random.log_uniform(0.3, 5)},
           {"elevation_rad", level ? 0 : random.uniform(-steepest, steepest)}}};
}

// A wall in three touches the block from the start, on its right.
TruthEffect draw_wall(KeyedRandom& random) {
  TruthEffect wall = draw_effect(random, "wall_impact");
  if (random.chance(1.0 / 3)) wall.parameters["gap_m"] = 0;
  return wall;
}

std::vector<TruthEffect> draw_effects(KeyedRandom& random, const Recipe& recipe, const Truth& truth) {
  std::vector<TruthEffect> drawn;
  for (const std::string& name : recipe.effects) {
    drawn.push_back(name == "chain"         ? draw_chain(random, truth)
                    : name == "wall_impact" ? draw_wall(random)
                                            : draw_effect(random, name));
    if (drawn.size() == 2 && drawn[0].name == name) to_other_side(drawn[1], drawn[0]);
  }
  const auto holds = [&](const char* name) {
    return std::any_of(drawn.begin(), drawn.end(), [&](const TruthEffect& effect) { return effect.name == name; });
  };
  const bool contact = recipe.setting == Setting::bouc_wen;
  const bool thrown = recipe.setting == Setting::thrown || (contact && random.chance(0.25));
  const bool on_a_slope = recipe.setting == Setting::on_a_slope || (contact && random.chance(0.25));
  if (thrown && !holds("vertical_shaking")) drawn.push_back({"vertical_shaking", {}});
  if (on_a_slope && !holds("floor_tilt")) drawn.push_back({"floor_tilt", {{"angle_rad", random.uniform(-0.15, 0.15)}}});
  return drawn;
}

// From three quarters to five times what moves the block; vertically up to 0.8 g, or from 1.1 to 2.5 g where it is to
// be thrown.
FloorSamples draw_floor(KeyedRandom& random, const Truth& truth, Setting setting) {
  static constexpr Shaking kinds[] = {Shaking::pulse, Shaking::stochastic, Shaking::both};
  FloorSamples floor;
  floor.dt_s = floor_step_s;
  const Shaking kind = kinds[static_cast<int>(3 * random.unit())];
  floor.horizontal_mps2 = draw_shaking(random, kind, {}, floor_step_s, kind == Shaking::pulse ? 6 : 3);
  floor.vertical_mps2 = draw_vertical(random, floor_step_s, floor.horizontal_mps2.size());
  const double tips = std::min(truth.left_m, truth.right_m) / truth.height_m;
  const double moves = truth.model == TruthModel::slide  ? truth.mu_s
                       : truth.model == TruthModel::rock ? tips
                                                         : std::min(truth.mu_s, tips);
  const double sign = random.chance(0.5) ? 1 : -1, peak = sign * moves * g * random.log_uniform(0.75, 5);
  const bool thrown = setting == Setting::thrown || (setting == Setting::bouc_wen && random.chance(0.5));
  const double up = g * (thrown ? random.uniform(1.1, 2.5) : random.uniform(0.1, 0.8));
  for (double& a : floor.horizontal_mps2) a *= peak;
  for (double& v : floor.vertical_mps2) v *= up;
  if (setting == Setting::bouc_wen) {  // what follows it begins without a jump
    floor.horizontal_mps2.push_back(0);
    floor.vertical_mps2.push_back(0);
  }
  return floor;
}

}  // namespace

const char* name(Setting setting) {
  static constexpr const char* names[setting_count] = {"slide",  "rock",       "slide_rock",
                                                       "thrown", "on_a_slope", "bouc_wen"};
  return names[static_cast<int>(setting)];
}

const std::vector<std::string>& judged_effects() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> names = catalogue_effects();
    names.emplace_back("chain");
    names.insert(names.end(), outside_effects().begin(), outside_effects().end());
    return names;
  }();
  return all;
}

bool outside_catalogue(const std::string& effect) {
  const auto& all = outside_effects();
  return std::find(all.begin(), all.end(), effect) != all.end();
}

std::vector<Recipe> recipes(Family family) {
  const bool on_contact = family == Family::bouc_wen, formulas = family == Family::formulas;
  const int first = on_contact ? static_cast<int>(Setting::bouc_wen) : 0;
  const int settings = on_contact ? 1 : rigid_setting_count;
  std::vector<Recipe> all;
  const auto add = [&](std::vector<std::string> effects, int setting) {
    Recipe recipe{std::move(effects), static_cast<Setting>(first + setting % settings)};
    if (possible(recipe)) all.push_back(std::move(recipe));
  };
  const auto stands = [&](const std::string& effect) {
    return on_contact ? goes_with({effect}, TruthModel::bouc_wen) && !outside_catalogue(effect)
                      : formulas || !outside_catalogue(effect);
  };
  std::vector<std::string> effects;
  std::copy_if(judged_effects().begin(), judged_effects().end(), std::back_inserter(effects), stands);
  for (int setting = 0; setting < settings && !formulas; ++setting) add({}, setting);
  for (const std::string& effect : effects)
    for (int setting = 0; setting < settings && (!formulas || outside_catalogue(effect)); ++setting)
      add({effect}, setting);
  int turn = 0;
  for (std::size_t i = 0; i < effects.size(); ++i)
    for (std::size_t j = i; j < effects.size(); ++j)
      if (go_together(effects[i], effects[j]) && (!formulas || outside_catalogue(effects[j]))) {
        // Settings that the pair does not go with are passed over.
        const std::size_t before = all.size();
        while (all.size() == before) add({effects[i], effects[j]}, turn++);
      }
  return all;
}

std::string JudgedCase::text() const {
  std::string line =
      fmt::format("{}: {}, {}, left {:.6g} m, right {:.6g} m, height {:.6g} m, k2 {:.6g} m2, mu_s {:.6g}, mu_k {:.6g}",
                  number, model_name(truth.model), truth.impact == TruthImpact::housner ? "housner" : "coulomb",
                  truth.left_m, truth.right_m, truth.height_m, truth.gyration2_m2, truth.mu_s, truth.mu_k);
  if (truth.model == TruthModel::bouc_wen)
    line += fmt::format(", u_y {:.6g} m, n {:.6g}, gamma {:.6g}, beta {:.6g}", truth.contact.yield_m,
                        truth.contact.exponent, truth.contact.gamma, truth.contact.beta);
  for (const TruthEffect& effect : truth.effects) {
    line += ", " + effect.name + " {";
    for (const auto& [key, value] : effect.parameters) line += fmt::format(" {}: {:.6g}", key, value);
    line += " }";
  }
  return line;
}

namespace {

// A pair comes in another setting each time that its turn comes.
Recipe recipe_of(std::uint64_t number, Family family) {
  static const std::vector<Recipe> known[] = {recipes(), recipes(Family::bouc_wen), recipes(Family::formulas)};
  const std::vector<Recipe>& all = known[static_cast<int>(family)];
  Recipe recipe = all[number % all.size()];
  if (recipe.effects.size() < 2 || family == Family::bouc_wen) return recipe;
  const auto next = [&] {
    recipe.setting = static_cast<Setting>((static_cast<int>(recipe.setting) + 1) % rigid_setting_count);
  };
  for (std::uint64_t turns = number / all.size(); turns > 0; --turns) {
    next();
    while (!possible(recipe)) next();
  }
  return recipe;
}

}  // namespace

JudgedCase judged_case(std::uint64_t seed, std::uint64_t number, Family family) {
  KeyedRandom random(seed, number);
  JudgedCase result{seed, number, family, recipe_of(number, family), {}, {}};
  const auto& about = result.recipe.effects;
  const bool chained = std::find(about.begin(), about.end(), "chain") != about.end();
  result.truth = draw_block(random, draw_model(random, result.recipe), chained);
  if (family == Family::bouc_wen) result.truth.contact = draw_contact(random);
  result.truth.effects = draw_effects(random, result.recipe, result.truth);
  result.floor = draw_floor(random, result.truth, result.recipe.setting);
  return result;
}

}  // namespace freestand::test
