// What a surface may have as its second axis.
#include <algorithm>

#include "study/read_parts.hpp"

namespace freestand::study {
namespace {

bool varies(const std::optional<Quantity>& quantity) { return quantity && !is_fixed(quantity->value); }

void block_axes(const BlockPart& block, std::vector<AxisChoice>& axes) {
  const bool shape = varies(block.width) || varies(block.height), angle = varies(block.slenderness),
             size = varies(block.size);
  axes.push_back({"block.width_m", varies(block.width) || angle || size});
  axes.push_back({"block.height_m", varies(block.height) || angle || size});
  axes.push_back({"block.mass_kg", varies(block.mass)});
  for (const auto& q : {block.centre_height, block.gyration_radius, block.inertia})
    if (q) axes.push_back({q->name, varies(q)});
  const bool centre = varies(block.centre_height), inertia = varies(block.gyration_radius) || varies(block.inertia);
  if (block.slenderness) axes.push_back({"block.slenderness_rad", angle});
  axes.push_back({"block.alpha_rad", shape || angle || centre});
  axes.push_back({"block.size_m", shape || size || centre});
  axes.push_back({"block.p_radps", shape || size || centre || inertia});
}

void friction_axes(const FrictionPart& friction, std::vector<AxisChoice>& axes) {
  const bool kinetic = varies(friction.mu) || varies(friction.mu_k);
  axes.push_back({"friction.mu_k", kinetic});
  axes.push_back(
      {"friction.mu_s", varies(friction.mu_s) || varies(friction.static_ratio) || (kinetic && !friction.mu_s)});
  if (friction.mu) axes.push_back({"friction.mu", kinetic});
  for (const auto& q : {friction.static_ratio, friction.ratio_across, friction.axis})
    if (q) axes.push_back({q->name, varies(*q)});
}

}  // namespace

std::vector<AxisChoice> axis_choices(const ModelPart& model, const std::vector<MotionSource>& motions) {
  std::vector<AxisChoice> axes;
  block_axes(model.block, axes);
  friction_axes(model.friction, axes);
  axes.push_back({"impact.factor", varies(model.impact.factor)});
  if (const auto& b = model.bouc_wen)
    for (const auto& q : {b->yield_displacement, b->exponent, b->gamma, b->beta}) axes.push_back({q.name, varies(q)});
  for (const auto& effect : model.effects)
    for (const auto& parameter : effect.parameters) axes.push_back({parameter.name, varies(parameter)});
  if (const auto& c = model.chain)
    for (const auto& q : {std::optional(c->slack), std::optional(c->stiffness), std::optional(c->strength), c->height,
                          c->number, c->plan_angle, c->elevation, c->damping, c->wall_gap})
      if (q) axes.push_back({q->name, varies(q)});
  if (model.neighbour)
    for (const auto& q : model.neighbour->given()) axes.push_back({q.name, varies(q)});
  if (model.legs)
    for (const auto& q : {std::optional(model.legs->frequency), model.legs->damping})
      if (q) axes.push_back({q->name, varies(*q)});
  for (const auto& q : model.start.given()) axes.push_back({q.name, varies(q)});
  const bool several = motions.size() > 1;
  const auto any = [&](const auto& test) { return std::any_of(motions.begin(), motions.end(), test); };
  const bool pulses = any([](const MotionSource& s) { return s.kind == MotionSource::Kind::pulses; });
  const bool records = any([](const MotionSource& s) {
    return s.synthetic ? s.synthetic->count > 1 : s.kind == MotionSource::Kind::records && s.files.size() != 1;
  });
  const bool amplitude = any([](const MotionSource& s) { return varies(s.amplitude); });
  const bool period = any([](const MotionSource& s) { return varies(s.period); });
  if (pulses) axes.push_back({"motion.period_s", period || several});
  if (any([](const MotionSource& s) { return s.building.has_value(); }))
    axes.push_back({"motion.storey", several || any([](const MotionSource& s) { return varies(s.storey); })});
  axes.push_back({"motion.pulse_period_s", period || records || several});
  axes.push_back({"motion.pta_g", amplitude || period || records || several});
  return axes;
}

}  // namespace freestand::study
