#include "effects/effects.hpp"

#include <algorithm>

namespace freestand::effects {

const std::vector<Effect>& all() { return registry<Effect>(); }

const Effect* find(const std::string& name) {
  const auto found =
      std::find_if(all().begin(), all().end(), [&](const Effect& effect) { return effect.name == name; });
  return found == all().end() ? nullptr : &*found;
}

}  // namespace freestand::effects
