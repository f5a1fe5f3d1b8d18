#include <algorithm>

#include "study/study.hpp"

namespace freestand::study {

std::vector<Quantity> StartPart::given() const {
  std::vector<Quantity> all;
  for (const auto& q : {rotation, rotation_rate, slip, slip_velocity})
    if (q) all.push_back(*q);
  return all;
}

std::vector<Quantity> NeighbourPart::given() const {
  std::vector<Quantity> all = {gap, mass, mu_k};
  for (const auto& q : {static_ratio, restitution})
    if (q) all.push_back(*q);
  return all;
}

std::vector<Quantity> quantities(const ModelPart& model) {
  std::vector<Quantity> all;
  const auto add = [&](const std::optional<Quantity>& quantity) {
    if (quantity) all.push_back(*quantity);
  };
  for (const auto& q : {model.block.width, model.block.height, model.block.slenderness, model.block.size}) add(q);
  add(model.block.mass);
  for (const auto& q : {model.block.centre_height, model.block.gyration_radius, model.block.inertia}) add(q);
  const FrictionPart& friction = model.friction;
  for (const auto& q :
       {friction.mu, friction.mu_k, friction.mu_s, friction.static_ratio, friction.ratio_across, friction.axis})
    add(q);
  if (const auto& b = model.bouc_wen)
    for (const auto& q : {b->yield_displacement, b->exponent, b->gamma, b->beta}) add(q);
  add(model.impact.factor);
  for (const auto& effect : model.effects)
    for (const auto& q : effect.parameters) add(q);
  add(model.slip_discrepancy);
  if (model.chain) {
    for (const auto& q : {model.chain->slack, model.chain->stiffness, model.chain->strength}) add(q);
    for (const auto& q : {model.chain->height, model.chain->number, model.chain->plan_angle, model.chain->elevation,
                          model.chain->damping})
      add(q);
    add(model.chain->wall_gap);
  }
  if (model.neighbour)
    for (const auto& q : model.neighbour->given()) add(q);
  if (model.legs) {
    add(model.legs->frequency);
    add(model.legs->damping);
  }
  for (const auto& q : model.start.given()) add(q);
  return all;
}

bool shakes_vertically(const ModelPart& model) {
  return std::any_of(model.effects.begin(), model.effects.end(),
                     [](const EffectPart& effect) { return effect.name == "vertical_shaking"; });
}

}  // namespace freestand::study
