#include "dynamics/restraints.hpp"

#include <algorithm>

#include "dynamics/effect.hpp"

namespace freestand::dynamics {
namespace {

// Slips of packs are good to 1e-9 (simulate.hpp). One that is nearer to its restraint than a thousand times that is computed with it.
constexpr double near = 1e-6;

bool restrains(const EffectUse& use) { return static_cast<bool>(use.effect->clear_within_m); }

}  // namespace

std::optional<Specimen> unrestrained(const Specimen& specimen) {
  if (std::none_of(specimen.effects.begin(), specimen.effects.end(), restrains)) return std::nullopt;
  Specimen without = specimen;
  std::erase_if(without.effects, restrains);
  return without;
}

bool stays_clear(const Specimen& specimen, double peak_slip_m) {
  return std::all_of(specimen.effects.begin(), specimen.effects.end(), [&](const EffectUse& use) {
    return !restrains(use) || peak_slip_m < (1 - near) * use.effect->clear_within_m(use.parameters);
  });
}

}  // namespace freestand::dynamics
