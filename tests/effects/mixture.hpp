// Effects together: random mixtures of several.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "effects/effects.hpp"
#include "support/keyed_random.hpp"

namespace freestand::test {

inline const char* const model_names[] = {"slide", "rock", "slide_rock", "bouc_wen"};

inline bool excluded(const effects::Effect& effect, const std::string& name) {
  return std::find(effect.excludes.begin(), effect.excludes.end(), name) != effect.excludes.end();
}

// Up to four effects of the catalogue, in the usual ranges of their parameters.
inline std::vector<EffectUse> mixture(KeyedRandom& random, Model model) {
  std::vector<EffectUse> uses;
  const std::size_t wanted = 1 + static_cast<std::size_t>(random.uniform(0, 4));
  for (int attempt = 0; uses.size() < wanted && attempt < 100; ++attempt) {
    const auto& all = effects::all();
    const auto& effect = all[static_cast<std::size_t>(random.uniform(0, static_cast<double>(all.size())))];
    bool fits = !excluded(effect, model_names[static_cast<int>(model)]);
    for (const auto& other : uses)
      fits = fits && other.effect != &effect && !excluded(effect, other.effect->name) &&
             !excluded(*other.effect, effect.name);
    if (!fits) continue;
    uses.push_back({&effect, {}});
    for (const auto& p : effect.parameters) uses.back().parameters.push_back(random.uniform(p.low, p.high));
  }
  return uses;
}

}  // namespace freestand::test
