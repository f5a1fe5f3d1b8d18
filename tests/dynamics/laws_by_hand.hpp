// Laws that a test writes down itself, outside of the catalogue.
#pragma once

#include <freestand/specimen.hpp>
#include <functional>

#include "dynamics/effect.hpp"

namespace freestand::test {

using Law = std::function<dynamics::Value(const dynamics::At&)>;

// Each call's declaration lasts as long as the program, as an effect's must.
inline EffectUse law(Law friction, Law force, Law moment = {}) {
  using dynamics::At;
  using dynamics::Parameters;
  auto* effect = new dynamics::Effect{};
  const auto hook = [](Law of) { return [of](const At& at, const Parameters&) { return of(at); }; };
  if (friction) effect->friction = hook(friction);
  if (force) effect->force = hook(force);
  if (moment) effect->moment = hook(moment);
  return {effect, {}};
}
inline EffectUse friction_law(Law friction) { return law(std::move(friction), {}); }
inline EffectUse force_law(Law force) { return law({}, std::move(force)); }

}  // namespace freestand::test
