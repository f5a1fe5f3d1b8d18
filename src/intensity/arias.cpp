#include "intensity/intensity.hpp"

namespace freestand::intensity {

// With the square of the motion's scale, so that no motion is scaled to it.
const Register arias{{
    .name = "arias_mps",
    .unit = "m/s",
    .symbol = "I_A",
    .summary = "Arias intensity: pi/(2 g) times the integral of the squared acceleration of the floor",
    .source = "Arias (1970)",
    .value = [](const Input& in) { return in.scale * in.scale * in.stretch * in.motion.arias_mps; },
}};

}  // namespace freestand::intensity
