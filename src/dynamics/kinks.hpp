// On which sides of their kinks the laws are, bit j for kink j. Several may be met at one instant (abs(v) and v > 0), and one that would
// turn back at once stands where a law looks at a force that it sets itself.
#pragma once

#include <cstdint>

namespace freestand::dynamics {

struct Kinks {
  std::uint32_t sides = 0;   // on its negative side
  std::uint32_t turned = 0;  // met at this instant
  std::uint32_t held = 0;    // met twice: left as it is until the next step

  bool has_met(int kink) const { return turned >> kink & 1U; }
  bool watches(int kink) const { return !(held >> kink & 1U); }
  void turn_kink(int kink) {
    const std::uint32_t bit = 1U << kink;
    if (turned & bit)
      held |= bit;
    else
      sides ^= bit;
    turned |= bit;
  }
  void left_kinks() { turned = held = 0; }
};

}  // namespace freestand::dynamics
