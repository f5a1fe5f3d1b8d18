// block, model, impact, chain, start; friction, effects, neighbours and legs have readers of their own.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "study/read_parts.hpp"

namespace freestand::study {
namespace {

using sampling::number_text;
using sampling::support;

constexpr Range slenderness_range = {.lower = 0, .upper = pi / 2, .why = "a slenderness lies between 0 and pi/2"};
constexpr Range exponent_range = {.lower = 1,
                                  .upper = 100,
                                  .lower_open = false,
                                  .upper_open = false,
                                  .why = "it must lie between 1 and 100; a sharper contact is Coulomb's, model slide"};
// The centre of mass lies within the block, and no mass lies farther from it than the farthest corner, in any sample. Numbers
// are drawn independently, so that their ranges are compared.
void check_mass_distribution(Section& section, const BlockPart& block) {
  if (!block.width || !block.height) return;
  const auto width = support(block.width->value), height = support(block.height->value);
  const auto centre = block.centre_height ? support(block.centre_height->value)
                                          : sampling::Support{0.5 * height.lower, 0.5 * height.upper, true, true};
  if (block.centre_height && !(centre.upper < height.lower))
    section.problem(
        "centre_height_m",
        fmt::format("block.centre_height_m goes up to {}, block.height_m down to {} (the centre of mass lies "
                    "within the block): narrow the one or the other, by min and max where it is a distribution",
                    number_text(centre.upper), number_text(height.lower)));
  if (block.gyration_radius && block.inertia)
    both_given(section, "gyration_radius_m", "inertia_kgm2", "one determines the other");
  if (block.inertia && block.mass.line == 0)
    section.problem("inertia_kgm2",
                    "block.inertia_kgm2 needs the mass (k^2 = I/m): add block.mass_kg, or give gyration_radius_m");
  if (!block.gyration_radius && !block.inertia) return;
  const double least = block.gyration_radius
                           ? support(block.gyration_radius->value).lower
                           : std::sqrt(support(block.inertia->value).lower / support(block.mass.value).upper);
  const double farthest = std::hypot(0.5 * width.upper, std::max(centre.upper, height.upper - centre.lower));
  if (least > farthest)
    section.problem(
        block.gyration_radius ? "gyration_radius_m" : "inertia_kgm2",
        fmt::format("the radius of gyration is {:.4g} m or more (no point of the block is farther than {:.4g} m "
                    "from its centre of mass): is it about the centre of mass, and in {}?",
                    least, farthest, block.gyration_radius ? "metres" : "kg m2"));
}

BlockPart read_block(Section& file) {
  BlockPart block;
  const YAML::Node* node = file.find("block");
  if (!node) {
    file.problem("block", "block is missing (there is nothing to shake): add block: {width_m: ..., height_m: ...}");
    return block;
  }
  Section section(*node, "block", file.line("block"), file.problems());
  block.width = section.quantity("block", "width_m", range::size);
  block.height = section.quantity("block", "height_m", range::size);
  block.slenderness = section.quantity("block", "slenderness_rad", slenderness_range);
  block.size = section.quantity("block", "size_m", range::size);
  block.mass = section.quantity("block", "mass_kg", {.lower = 0, .why = "a mass must be above zero"}, 1);
  block.centre_height = section.quantity("block", "centre_height_m", range::size);
  block.gyration_radius = section.quantity("block", "gyration_radius_m", range::size);
  block.inertia = section.quantity("block", "inertia_kgm2", {.lower = 0, .why = "an inertia must be above zero"});
  section.finish();
  if (!node->IsMap()) return block;

  const bool sides = section.has("width_m") || section.has("height_m");
  const bool angles = section.has("slenderness_rad") || section.has("size_m");
  if (sides && angles)
    both_given(section, section.has("width_m") ? "width_m" : "height_m",
               section.has("slenderness_rad") ? "slenderness_rad" : "size_m",
               "the block is given either by its sides or by slenderness and size");
  else if (angles) {
    if (!section.has("slenderness_rad"))
      missing_key(section, "slenderness_rad", "slenderness_rad, the angle atan(W/H)");
    if (!section.has("size_m")) missing_key(section, "size_m", "size_m, half the diagonal of the block");
  } else {
    if (!section.has("width_m")) missing_key(section, "width_m", "width_m, or slenderness_rad and size_m");
    if (!section.has("height_m")) missing_key(section, "height_m", "height_m");
  }
  if (angles)
    for (const char* key : {"centre_height_m", "gyration_radius_m", "inertia_kgm2"})
      if (section.has(key))
        section.problem(key, fmt::format("{} does not go with slenderness_rad and size_m (they are those of a uniform "
                                         "block): give width_m and height_m",
                                         section.name(key)));
  check_mass_distribution(section, block);
  return block;
}

Model read_model_name(Section& file) {
  return static_cast<Model>(file.choice("model", {"slide", "rock", "slide_rock", "bouc_wen"}, 2));
}

// |beta| <= gamma in every sample. They are drawn independently, so the range of the one bounds the other.
void check_shape(Section& section, const BoucWenPart& part) {
  const auto beta = support(part.beta.value), gamma = support(part.gamma.value);
  if (std::max(beta.upper, -beta.lower) <= gamma.lower && beta.lower + gamma.lower > 0) return;
  section.problem("beta",
                  "bouc_wen.beta can be above bouc_wen.gamma, or at or below -gamma (such a contact would make energy, "
                  "or never yield): choose |beta| <= gamma, beta + gamma > 0");
}

std::optional<BoucWenPart> read_bouc_wen(Section& file, Model model) {
  const YAML::Node* node = file.find("bouc_wen");
  if (!node) {
    if (model == Model::bouc_wen)
      file.problem("model",
                   "bouc_wen is missing (model bouc_wen stands on its contact): add bouc_wen: {yield_displacement_m: "
                   "..., exponent: ...}");
    return {};
  }
  Section section(*node, "bouc_wen", file.line("bouc_wen"), file.problems());
  BoucWenPart part;
  part.yield_displacement = section.quantity("bouc_wen", "yield_displacement_m", range::size, 1);
  part.exponent = section.quantity("bouc_wen", "exponent", exponent_range, 1);
  part.gamma = section.quantity("bouc_wen", "gamma", range::positive, 0.5);
  part.beta = section.quantity("bouc_wen", "beta", range::any, 0.5);
  section.finish();
  if (!node->IsMap()) return {};
  if (model != Model::bouc_wen)
    file.problem("bouc_wen",
                 "bouc_wen is given, and model is another (its contact would not be used): choose model: bouc_wen, or "
                 "remove it");
  for (const char* key : {"yield_displacement_m", "exponent"})
    if (!section.has(key)) missing_key(section, key, std::string(key) + ", of the contact");
  check_shape(section, part);
  return part;
}

ImpactPart read_impact(Section& file) {
  ImpactPart impact{ImpactLaw::housner, {"impact.factor", "1", sampling::Fixed{1}}};
  const YAML::Node* node = file.find("impact");
  if (!node) return impact;
  Section section(*node, "impact", file.line("impact"), file.problems());
  impact.law = static_cast<ImpactLaw>(section.choice("law", {"housner", "coulomb"}, 0));
  impact.factor = section.quantity("impact", "factor", range::fraction, 1);
  section.finish();
  const auto* fixed = std::get_if<sampling::Fixed>(&impact.factor.value);
  if (impact.law == ImpactLaw::coulomb && !(fixed && fixed->value == 1))
    section.problem("factor",
                    "impact.factor does not go with law coulomb (its impulse follows from friction alone): "
                    "remove factor, or use housner");
  return impact;
}

// What has no edges that a wall could stop, or a foot that slips under them.
std::string knows_no_walls(const ModelPart& model) {
  if (model.model == Model::bouc_wen) return "model bouc_wen";
  for (const EffectPart& effect : model.effects)
    if (effect.name == "flexible_legs") return "effect flexible_legs";
  return "";
}

std::optional<ChainPart> read_chain(Section& file, const ModelPart& model) {
  const YAML::Node* node = file.find("chain");
  if (!node) return {};
  Section section(*node, "chain", file.line("chain"), file.problems());
  ChainPart chain;
  chain.slack = section.quantity("chain", "slack_m", range::not_negative, 0);
  chain.stiffness = section.quantity("chain", "stiffness_npm", range::positive, 0);
  chain.strength = section.quantity("chain", "strength_n", range::positive, 0);
  chain.height = section.quantity("chain", "height_m", range::size);
  chain.number = section.quantity(
      "chain", "number", {.lower = 1, .lower_open = false, .why = "fewer chains than one are none: remove chain"});
  chain.plan_angle = section.quantity("chain", "plan_angle_rad",
                                      {.lower = 0,
                                       .upper = pi / 2,
                                       .lower_open = false,
                                       .why = "chains stand at less than a right angle to the shaking"});
  chain.elevation = section.quantity(
      "chain", "elevation_rad",
      {.lower = -pi / 2, .upper = pi / 2, .why = "chains stand at less than a right angle to the floor"});
  if (chain.elevation && model.model == Model::bouc_wen)
    section.problem(
        "elevation_rad",
        "chain.elevation_rad does not go with model bouc_wen (whose contact carries the whole weight): remove it");
  chain.damping = section.quantity("chain", "damping_nspm", range::not_negative);
  if (const std::string without = knows_no_walls(model); without.empty())
    chain.wall_gap = section.quantity("chain", "wall_gap_m", range::not_negative, 0);
  else if (section.find("wall_gap_m"))
    section.problem("wall_gap_m",
                    "chain.wall_gap_m does not go with " + without + " (which meets no walls): remove it");
  chain.side = section.choice("side", {"right", "left"}, 0) == 0 ? 1 : -1;
  section.finish();
  if (!node->IsMap()) return {};
  for (const char* key : {"stiffness_npm", "strength_n"})
    if (!section.has(key)) missing_key(section, key, std::string(key) + ", of the chain and its connection");
  return chain;
}

StartPart read_start(Section& file, const ModelPart& model) {
  StartPart start;
  const YAML::Node* node = file.find("start");
  if (!node) return start;
  Section section(*node, "start", file.line("start"), file.problems());
  start.rotation = section.quantity("start", "rotation_rad", range::leaning);
  start.rotation_rate = section.quantity("start", "rotation_rate_radps", range::any);
  start.slip = section.quantity("start", "slip_m", range::any);
  start.slip_velocity = section.quantity("start", "slip_velocity_mps", range::any);
  section.finish();
  const auto refuse = [&](const char* key, const char* why) {
    if (section.has(key))
      section.problem(key, fmt::format("{} does not go with model {}: remove it, or choose model: slide_rock",
                                       section.name(key), why));
  };
  if (model.model == Model::slide)
    for (const char* key : {"rotation_rad", "rotation_rate_radps"}) refuse(key, "slide (which does not tip)");
  if (model.model == Model::rock) refuse("slip_velocity_mps", "rock (which does not slip)");
  if (model.model == Model::bouc_wen)
    file.problem("start",
                 "start does not go with model bouc_wen (what its contact has gone through is not known): remove it");
  for (const EffectPart& effect : model.effects)
    if (effect.name == "flexible_legs")
      file.problem("start",
                   "start does not go with effect flexible_legs (how far its legs are bent is not known): remove one");
  return start;
}

// No sample begins with a part of the block beyond a wall. Numbers are drawn independently, so that their ranges are compared.
class RoomAtStart {
 public:
  RoomAtStart(Section& file, const ModelPart& model) : file_(file), model_(model) {}
  void check() const {
    if (!model_.start.slip && !model_.start.rotation) return;
    for (const EffectPart& effect : model_.effects) {
      if (effect.name != "wall_impact") continue;
      const NearestWalls walls = nearest_walls(effect);
      if (walls.right) stands("wall_impact", 1, *walls.right);
      if (walls.left) stands("wall_impact", -1, *walls.left);
    }
    if (model_.chain && model_.chain->wall_gap) stands("chain", -model_.chain->side, of(*model_.chain->wall_gap).lower);
  }

 private:
  static sampling::Support of(const std::optional<Quantity>& quantity) {
    return quantity ? support(quantity->value) : sampling::Support{0, 0, false, false};
  }
  // Where the block tips towards the wall, its upper edge leads.
  double reach(int side) const {
    const sampling::Support slip = of(model_.start.slip), lean = of(model_.start.rotation);
    const double height = model_.block.height ? of(model_.block.height).upper : 2 * of(model_.block.size).upper;
    const double leans = std::max(0.0, side > 0 ? lean.upper : -lean.lower);
    return (side > 0 ? slip.upper : -slip.lower) + (leans > 0 ? height * std::sin(leans) : 0);
  }
  void stands(const char* what, int side, double gap) const {
    constexpr double touches = 1e-9;
    if (reach(side) <= gap + touches) return;
    file_.problem(
        "start",
        fmt::format("start sets the block down to {:.4g} m to the {}, and the wall of {} stands {:.4g} m there "
                    "(a block cannot begin within a wall): start it nearer, or set the wall farther away",
                    reach(side), side > 0 ? "right" : "left", what, gap));
  }

  Section& file_;
  const ModelPart& model_;
};

std::optional<Quantity> read_discrepancy(Section& file) {
  const YAML::Node* node = file.find("discrepancy");
  if (!node) return {};
  Section section(*node, "discrepancy", file.line("discrepancy"), file.problems());
  auto slip = section.quantity("discrepancy", "slip", range::size);
  section.finish();
  return slip;
}

}  // namespace

NearestWalls nearest_walls(const EffectPart& wall) {
  const sampling::Support gap = support(wall.parameters[0].value), side = support(wall.parameters[2].value),
                          other = support(wall.parameters[3].value);
  const bool by_sign = side.lower == 0 && side.upper == 0, may_go_by_sign = side.lower <= 0 && side.upper >= 0;
  const double to_right = std::max(gap.lower, 0.0), to_left = std::max(-gap.upper, 0.0),
               to_either = std::max(to_right, to_left);
  NearestWalls walls;
  if (side.upper > 0 || (may_go_by_sign && gap.upper >= 0)) walls.right = by_sign ? to_right : to_either;
  if (side.lower < 0 || (may_go_by_sign && gap.lower < 0)) walls.left = by_sign ? to_left : to_either;
  if (!(other.upper >= 0)) return walls;
  const double second = std::max(other.lower, 0.0);
  const auto beside = [&](const std::optional<double>& of, const std::optional<double>& opposite) {
    return opposite ? std::optional(of ? std::min(*of, second) : second) : of;
  };
  return {beside(walls.right, walls.left), beside(walls.left, walls.right)};
}

ModelPart read_model(Section& file) {
  ModelPart model;
  model.block = read_block(file);
  model.friction = read_friction(file);
  model.model = read_model_name(file);
  model.bouc_wen = read_bouc_wen(file, model.model);
  model.impact = read_impact(file);
  model.effects = read_effects(file, model.model);
  for (const EffectPart& effect : model.effects)
    if (effect.name == "impact_loss" && model.impact.law == ImpactLaw::coulomb)
      file.problem("impact",
                   "effect impact_loss does not go with impact law coulomb (its impulse follows from friction alone): "
                   "remove the effect, or use housner");
  check_friction(file, model);
  model.slip_discrepancy = read_discrepancy(file);
  model.chain = read_chain(file, model);
  model.start = read_start(file, model);
  RoomAtStart(file, model).check();
  model.neighbour = read_neighbour(file, model);
  model.legs = read_legs(file, model);
  if (const std::string text = no_room_for(model.effects, model.chain);
      model.chain && !text.empty() && no_room_for(model.effects, {}).empty())
    file.problem("chain", text);
  if (model.chain && model.chain->height && model.block.height) {
    const double highest = support(model.chain->height->value).upper, top = support(model.block.height->value).lower;
    if (highest > top)
      file.problem("chain",
                   fmt::format("chain.height_m is up to {:g}, and the block as low as {:g} m (a chain holds it nowhere "
                               "above that): lower it, or remove it to hold the block at its top",
                               highest, top));
  }
  if (model.chain && model.block.mass.line == 0)
    file.problem("chain",
                 "chain holds a block whose mass is not given (its stiffness and strength are forces): add "
                 "block.mass_kg");
  return model;
}

}  // namespace freestand::study
