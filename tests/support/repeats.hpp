// Simulations in tests: how often they are repeated, and how far a share that they find may lie from its chance.
#pragma once

#include <cmath>
#include <cstdlib>

namespace freestand::test {

// FREESTAND_REPEATS, where more are wanted than a test takes.
inline int repeats_asked(int otherwise) {
  const char* asked = std::getenv("FREESTAND_REPEATS");
  return asked ? std::atoi(asked) : otherwise;
}

// Standard deviation of a share that has this chance.
inline double error_of_share(double chance, int repeats) { return std::sqrt(chance * (1 - chance) / repeats); }

}  // namespace freestand::test
