// On which sides of their kinks the laws are, bit j for kink j. Several may be met at one instant (abs(v) and v > 0), and one that would
// turn back at once stands where a law looks at a force that it sets itself.
#pragma once

#include <cmath>
#include <cstdint>

#include "dynamics/tape.hpp"

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

// The argument of a kink, positive on its present side: from zero where it was just met, and zero where it cannot turn. values: of the
// tape's nodes, known to order N - 1.
template <int N>
Series<double, N> kink_argument(const Tape& tape, const Kinks& kinks, int kink, const Series<double, N>* values) {
  const Series<double, N>& argument = values[tape.kink_argument(kink)];
  if (!tape.turns(kink, kinks.sides, argument[0])) return Series<double, N>::zero();
  Series<double, N> facing = scaled(kinks.sides >> kink & 1U ? -1.0 : 1.0, argument);
  facing[N] = 0;
  if (kinks.has_met(kink)) facing[0] = 0;
  return facing;
}

// First terms that later ones outweigh within an instant are the round-off of a place where the argument is zero.
template <int N>
Series<double, N> past_instant(Series<double, N> y, double instant_s) {
  for (int k = 0; k < N; ++k) {
    double rest = 0;
    for (int j = N; j > k; --j) rest = (rest + std::abs(y[j])) * instant_s;
    if (!(std::abs(y[k]) <= rest)) break;
    y[k] = 0;
  }
  return y;
}

}  // namespace freestand::dynamics
