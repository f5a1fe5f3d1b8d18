// Specimens with hidden effects, drawn at random within what is plausible.
#pragma once

#include <string>
#include <vector>

#include "hidden_effect/generator.hpp"
#include "support/keyed_random.hpp"

namespace freestand::test {

// What the specimen does, which follows from what is hidden in it: the effects of rocking need a slender block, and
// friction that depends on the normal force shows, without vertical shaking, only where a block slides on one corner.
enum class Habit { slides, rocks, slides_and_rocks };

struct DrawnTruth {
  Habit habit = Habit::slides;
  double width_m = 0, height_m = 0, mass_kg = 0;
  Truth truth;
};

// Both throw std::invalid_argument on an effect that does not exist.
// strength: over what was drawn, of what makes the effect more than nothing.
TruthEffect draw_effect(KeyedRandom& random, const std::string& name, double strength = 1);
DrawnTruth draw_truth(KeyedRandom& random, const std::vector<std::string>& effects, double strength = 1);

}  // namespace freestand::test
