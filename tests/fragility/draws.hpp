// Random numbers for the tests of this folder.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "base/random.hpp"
#include "base/units.hpp"
#include "support/repeats.hpp"

namespace freestand::test {

inline double uniform(std::uint64_t i, std::uint64_t stream) { return random::uniform(2005, i, stream); }

inline double normal(std::uint64_t i, std::uint64_t stream) {
  const auto [first, second] = random::bits(2005, i, stream);
  return std::sqrt(-2 * std::log(random::unit_interval(first))) * std::cos(2 * pi * random::unit_interval(second));
}

inline std::vector<double> lognormals(std::size_t n, double lambda, double omega, std::uint64_t stream) {
  std::vector<double> samples;
  for (std::size_t i = 0; i < n; ++i) samples.push_back(std::exp(lambda + omega * normal(i, stream)));
  return samples;
}

}  // namespace freestand::test
