// Random numbers for the tests, each a pure function of (key, counter), so that a failing case can be made again alone.
#pragma once

#include <cmath>
#include <cstdint>

#include "base/units.hpp"

namespace freestand::test {

class KeyedRandom {
 public:
  KeyedRandom(std::uint64_t seed, std::uint64_t key) : state_(mixed(seed * 0x9e3779b97f4a7c15ULL + mixed(key))) {}

  // Uniform in [0, 1), from the top 53 bits.
  double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * unit(); }
  double log_uniform(double low, double high) { return low * std::pow(high / low, unit()); }
  bool chance(double probability) { return unit() < probability; }
  // Box and Muller.
  double normal() {
    const double radius = std::sqrt(-2 * std::log(1 - unit()));
    return radius * std::cos(2 * pi * unit());
  }

 private:
  // SplitMix64 (Steele, Lea & Flood 2014).
  static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  std::uint64_t next() { return mixed(state_ += 0x9e3779b97f4a7c15ULL); }

  std::uint64_t state_;
};

}  // namespace freestand::test
