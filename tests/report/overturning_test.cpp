// Boundaries of the overturning spectrum against an integration of its own (tests/support/rocking): above the lowest
// overturning amplitude the block stands again, in a cape that may be narrower than a step of the search.
#include "report/overturning.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/rocking.hpp"

namespace freestand::report {
namespace {

bool own(double amplitude, double frequency) {
  const SpectrumBlock block;
  return test::rock_under_one_sine({block.p_radps, block.alpha_rad}, amplitude * block.alpha_rad,
                                   frequency * block.p_radps)
      .overturned;
}

TEST(OverturningSearch, BoundariesAreThoseOfAnIntegrationOfItsOwn) {
  for (const double frequency : {2.5, 4.0, 7.0}) {
    const std::vector<Boundary> found = boundaries({}, "A", frequency, 20);
    ASSERT_EQ(found.size(), 3u) << frequency;
    EXPECT_TRUE(found[0].falls_above && !found[1].falls_above && found[2].falls_above);
    EXPECT_EQ(found[0].impacts, 1);
    EXPECT_EQ(found[1].impacts, 1);
    EXPECT_EQ(found[2].impacts, 0);
    for (const Boundary& one : found) {
      EXPECT_EQ(own(one.amplitude * (1 - 2e-5), frequency), !one.falls_above) << frequency << ' ' << one.amplitude;
      EXPECT_EQ(own(one.amplitude * (1 + 2e-5), frequency), one.falls_above) << frequency << ' ' << one.amplitude;
    }
    if (frequency < 3) {
      EXPECT_LT(found[2].amplitude / found[1].amplitude, amplitude_step);  // narrower than a step of the search
    }
  }
}

// On a grid of its own, every outcome between two boundaries is the one that they say.
TEST(OverturningSearch, NothingIsMissedBetweenBoundaries) {
  const double frequency = 1.0;
  const std::vector<Boundary> found = boundaries({}, "A", frequency, 3);
  int compared = 0;
  for (double amplitude = 1.02; amplitude < 3; amplitude *= 1.0037) {
    bool falls = false, near = false;
    for (const Boundary& one : found) {
      if (one.amplitude < amplitude) falls = one.falls_above;
      near = near || std::abs(one.amplitude / amplitude - 1) < 2e-5;
    }
    if (near) continue;
    EXPECT_EQ(own(amplitude, frequency), falls) << amplitude;
    ++compared;
  }
  EXPECT_GT(compared, 250);
}

}  // namespace
}  // namespace freestand::report
