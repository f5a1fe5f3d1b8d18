// Laws between two times of a block that rests: at every instant they are within what was told beforehand.
#include "dynamics/law_range.hpp"

#include <gtest/gtest.h>

#include "dynamics/laws_by_hand.hpp"

namespace freestand::test {
namespace {

using dynamics::At;

struct Resting {
  Specimen specimen;
  dynamics::Rig rig;
  dynamics::State state;

  explicit Resting(const Law& friction)
      : specimen{Block::rectangular(0.5, 1.6, 100), {0.2, 0.2}, {}, Model::slide_rock, {friction_law(friction)}},
        rig(specimen, {}) {
    state.xi = 0.03;
    state.path = 0.2;
    state.still_since = 1.2;
    state.sides = rig.laws->initial_sides();
  }
  dynamics::LawRange between(double from, double to) const { return dynamics::law_range(rig, state, from, to, 1); }
  double at(double time) const { return dynamics::law_values(rig, state, time, 1).factor; }
};

const std::vector<Law> laws = {
    [](const At& at) { return 1.0 + 0.3 * at.t; },
    [](const At& at) { return 1.0 - 0.3 * (1.0 - exp(-at.t / 0.7)); },
    [](const At& at) { return 1.0 + 0.2 * log(1.0 + at.rest / 0.05); },
    [](const At& at) { return 1.0 + 0.5 * sin(4.0 * at.t) * cos(9.0 * at.rest); },
    [](const At& at) { return 2.0 + 0.5 * sin(40.0 * at.t); },
    [](const At& at) { return sqrt(at.rest) + pow(at.t, 1.7) / (1.0 + at.t * at.t); },
    [](const At& at) { return pow(at.t, -0.5) + pow(at.rest, at.t); },
    [](const At& at) { return 2.0 + (at.t - 2.2) * (at.t - 2.2) - at.t / (at.rest + 0.5); },
    [](const At& at) { return 1.0 + tanh(at.t - 2.2) * at.u + at.path; },
    [](const At& at) { return 1.0 + max(at.t, at.u) + min(at.rest, at.t) + abs(at.v) + abs(-1.0 * at.t); },
    [](const At& at) { return where(at.t - 1.0, 1.0 + at.t, log(at.t - 3.0)); }};

TEST(LawRange, HoldsTheLawAtEveryInstant) {
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const Resting block(laws[i]);
    for (const double lasts : {0.0, 0.01, 0.4}) {
      const dynamics::LawRange range = block.between(2, 2 + lasts);
      ASSERT_TRUE(range.known) << i;
      double least = 1e300, most = -1e300;
      for (int k = 0; k <= 100; ++k) {
        const double value = block.at(2 + lasts * k / 100);
        least = std::fmin(least, value);
        most = std::fmax(most, value);
      }
      EXPECT_LE(range.factor.lower, least + 1e-14) << i;
      EXPECT_GE(range.factor.upper, most - 1e-14) << i;
      // As wide as a law could change that changes by 25 in a second, and no wider, so that short waits are told apart.
      EXPECT_LE(range.factor.upper - range.factor.lower, 25 * lasts) << i;
    }
  }
}

// A kink that is passed turns the law, which an event has to tell; where it has no value rest may end, too.
TEST(LawRange, TellsWhereALawTurnsOrEnds) {
  const std::vector<Law> turning = {
      [](const At& at) { return 1.0 + abs(at.t - 2.2); },     [](const At& at) { return 2.0 - step(at.rest - 1.0); },
      [](const At& at) { return 1.0 + 0.01 / (at.t - 2.2); }, [](const At& at) { return 4.0 + log(at.t - 2.2); },
      [](const At& at) { return sqrt(at.t - 2.2); },          [](const At& at) { return 2.2 - at.t; }};
  for (std::size_t i = 0; i < turning.size(); ++i) {
    EXPECT_FALSE(Resting(turning[i]).between(2, 2.4).known) << i;
    EXPECT_EQ(Resting(turning[i]).between(2.3, 2.4).known, i < 5) << i;
  }
}

}  // namespace
}  // namespace freestand::test
