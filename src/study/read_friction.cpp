// The friction of a block, and what does not go with it.
#include <fmt/format.h>

#include "study/read_parts.hpp"

namespace freestand::study {
namespace {

using sampling::number_text;
using sampling::support;

constexpr Range ratio_range = {
    .lower = 1, .lower_open = false, .why = "static friction is never below kinetic friction"};

// mu_s must not fall below mu_k in any sample. They are drawn independently, so their ranges must not overlap.
void check_static_friction(Section& section, const FrictionPart& friction) {
  if (!friction.mu_s || !friction.mu_k) return;
  const double most = support(friction.mu_k->value).upper, least = support(friction.mu_s->value).lower;
  if (most <= least) return;
  const bool numbers = is_fixed(friction.mu_k->value) && is_fixed(friction.mu_s->value);
  section.problem("mu_s",
                  numbers ? fmt::format("friction.mu_s {} is below friction.mu_k {} (static friction is never below "
                                        "kinetic friction): raise mu_s",
                                        number_text(least), number_text(most))
                          : std::string("friction.mu_s can fall below friction.mu_k (they are drawn independently and "
                                        "their ranges overlap): use mu_k with static_ratio"));
}

// A formula of friction stands in the place of mu_k, and static friction is mu_s/mu_k times as much.
void check_ratio_of_formulas(Section& file, const ModelPart& model) {
  const auto& [mu, mu_k, mu_s, static_ratio, across, axis] = model.friction;
  if (!mu_k || !mu_s || support(mu_k->value).lower > 0 || !(support(mu_s->value).upper > 0)) return;
  for (const EffectPart& effect : model.effects)
    if (!effect.friction.empty())
      file.problem("friction", fmt::format("friction.mu_k can be 0 beside mu_s (while the block is stuck, friction is "
                                           "mu_s/mu_k times what effect {} says): give mu, or a mu_k above 0",
                                           effect.name));
}

// The effect static_friction says what mu_s is.
void check_static_friction_once(Section& file, const ModelPart& model) {
  const auto is_one = [](const std::optional<Quantity>& ratio) {
    return !ratio || (is_fixed(ratio->value) && support(ratio->value).upper == 1);
  };
  for (const EffectPart& effect : model.effects)
    if (effect.name == "static_friction" && (model.friction.mu_s || !is_one(model.friction.static_ratio)))
      file.problem("friction",
                   fmt::format("friction.{} and effect static_friction are both given (one determines the other): "
                               "remove one",
                               model.friction.mu_s ? "mu_s" : "static_ratio"));
}

}  // namespace

FrictionPart read_friction(Section& file) {
  FrictionPart friction;
  const YAML::Node* node = file.find("friction");
  if (!node) {
    file.problem("friction", "friction is missing (the block cannot stand without it): add friction: {mu: ...}");
    return friction;
  }
  Section section(*node, "friction", file.line("friction"), file.problems());
  friction.mu = section.quantity("friction", "mu", range::not_negative);
  friction.mu_k = section.quantity("friction", "mu_k", range::not_negative);
  friction.mu_s = section.quantity("friction", "mu_s", range::not_negative);
  friction.static_ratio = section.quantity("friction", "static_ratio", ratio_range);
  friction.ratio_across = section.quantity("friction", "ratio_across", range::size);
  friction.axis = section.quantity("friction", "axis_rad", range::any);
  section.finish();
  if (!node->IsMap()) return friction;

  if (section.has("mu")) {
    for (const char* key : {"mu_k", "mu_s", "static_ratio"})
      if (section.has(key)) both_given(section, "mu", key, "mu stands for both coefficients");
  } else if (!section.has("mu_k")) {
    missing_key(section, "mu_k", "mu_k, or mu for both coefficients");
  } else if (section.has("mu_s") && section.has("static_ratio")) {
    both_given(section, "mu_s", "static_ratio", "one determines the other");
  }
  if (section.has("axis_rad") && !section.has("ratio_across"))
    section.problem(
        "axis_rad",
        "friction.axis_rad turns what is the same in all directions: add friction.ratio_across, or remove it");
  check_static_friction(section, friction);
  return friction;
}

void check_friction(Section& file, const ModelPart& model) {
  check_ratio_of_formulas(file, model);
  check_static_friction_once(file, model);
}

}  // namespace freestand::study
