// Simulations in tests: how often they are repeated, and how far what they count may lie from its chance.
#pragma once

#include <cmath>
#include <cstdlib>

namespace freestand::test {

// FREESTAND_LONG_TESTS: variants of what the short run has shown once.
inline bool long_tests() { return std::getenv("FREESTAND_LONG_TESTS") != nullptr; }

// FREESTAND_REPEATS, where more are wanted than a test takes.
inline int repeats_asked(int otherwise) {
  const char* asked = std::getenv("FREESTAND_REPEATS");
  return asked ? std::atoi(asked) : otherwise;
}

// Of repeats that take seconds each: so many with FREESTAND_LONG_TESTS, a third of them without.
inline int dear_repeats(int with_long_tests) {
  return repeats_asked(long_tests() ? with_long_tests : (with_long_tests + 2) / 3);
}

// Standard deviation of a share that has this chance.
inline double error_of_share(double chance, int repeats) { return std::sqrt(chance * (1 - chance) / repeats); }

// Of so many trials of this chance, the least and the most that happen: fewer, and more, in at most one run of 500 each (binomial).
struct Counts {
  int least = 0, most = 0;
};

inline Counts likely_counts(int trials, double chance) {
  constexpr double beyond = 1.0 / 500;
  Counts counts;
  double below = 0, up_to = 0;  // P(X < k), P(X <= k)
  for (int k = 0; k <= trials; ++k) {
    below = up_to;
    up_to += std::exp(std::lgamma(trials + 1) - std::lgamma(k + 1) - std::lgamma(trials - k + 1) +
                      k * std::log(chance) + (trials - k) * std::log1p(-chance));
    if (below <= beyond) counts.least = k;
    if (1 - below > beyond) counts.most = k;
  }
  return counts;
}

}  // namespace freestand::test
