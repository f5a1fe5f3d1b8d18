// A truth of the generator as the specimen of freestand, for tests that hold one against the other.
#pragma once

#include <algorithm>
#include <freestand/floor_motion.hpp>
#include <freestand/specimen.hpp>
#include <stdexcept>

#include "dynamics/chain.hpp"
#include "effects/effects.hpp"
#include "formula/formula.hpp"
#include "hidden_effect/generator.hpp"

namespace freestand::test {

// What stands in no catalogue, as a study may write it.
inline const effects::Effect* formula_of(const std::string& name) {
  using formula::effect;
  static const std::vector<effects::Effect> all = {
      effect("rough_floor", "mu*(1 + ratio*sin(2*pi*u/length))", "", {"ratio", "length_m"}),
      effect("friction_heating", "mu*(1 + rise*(1 - exp(-t/time)))", "", {"rise", "time_s"}),
      effect("quadratic_drag", "", "-per*v*abs(v)", {"per_m"}),
      effect("stick_ageing", "mu*(1 + rise*log(1 + rest/time))", "", {"rise", "time_s"}),
  };
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& effect) { return effect.name == name; });
  return found == all.end() ? nullptr : &*found;
}

inline EffectUse effect_use(const TruthEffect& truth) {
  const effects::Effect* effect = effects::find(truth.name);
  if (!effect) effect = formula_of(truth.name);
  if (!effect) throw std::invalid_argument(truth.name);
  EffectUse use{effect, {}};
  for (const auto& parameter : effect->parameters) {
    const auto given = truth.parameters.find(parameter.name);
    use.parameters.push_back(given != truth.parameters.end() ? given->second : parameter.fallback.value());
  }
  return use;
}

inline EffectUse chain_use(const TruthEffect& truth, const Block& block) {
  const auto& p = truth.parameters;
  dynamics::Chain chain;
  chain.slack_m = p.at("slack_m");
  chain.stiffness_npm = p.at("stiffness_per_s2") * block.mass_kg;
  chain.strength_n = p.at("strength_mps2") * block.mass_kg;
  chain.height_m = p.at("height_m");
  chain.side = static_cast<int>(p.at("side"));
  if (p.count("elevation_rad")) chain.elevation_rad = p.at("elevation_rad");
  return dynamics::use(chain, block);
}

inline Specimen specimen_of(const Truth& truth) {
  static constexpr Model models[] = {Model::slide, Model::rock, Model::slide_rock, Model::bouc_wen};
  Specimen specimen;
  specimen.block = {truth.left_m, truth.right_m, truth.height_m, truth.gyration2_m2, 1};
  specimen.friction = {truth.mu_s, truth.mu_k};
  specimen.model = models[static_cast<int>(truth.model)];
  specimen.impact = {truth.impact == TruthImpact::housner ? ImpactLaw::housner : ImpactLaw::coulomb,
                     truth.impact_factor};
  specimen.bouc_wen = {truth.contact.yield_m, truth.contact.exponent, truth.contact.gamma, truth.contact.beta};
  for (const TruthEffect& effect : truth.effects)
    specimen.effects.push_back(effect.name == "chain" ? chain_use(effect, specimen.block) : effect_use(effect));
  return specimen;
}

inline FloorMotion motion_of(const FloorSamples& floor) {
  return piecewise_linear("samples", floor.dt_s, floor.horizontal_mps2, floor.vertical_mps2);
}

}  // namespace freestand::test
