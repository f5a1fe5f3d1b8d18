// What the step of the generator costs: its error falls with the step, and is far under the noise at the step of the
// sets.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hidden_effect/default_effects.hpp"
#include "hidden_effect/make_set.hpp"

namespace freestand::test::convergence_test {
namespace {

double distance(const TruthHistory& a, const TruthHistory& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.slip_m.size(); ++i)
    largest = std::max({largest, std::abs(a.slip_m[i] - b.slip_m[i]), std::abs(a.rotation_rad[i] - b.rotation_rad[i])});
  return largest;
}

class Convergence : public testing::TestWithParam<std::string> {};

TEST_P(Convergence, ErrorFallsWithTheStep) {
  const MadeSet set = make_set({split_effects(GetParam()), 2, 4, 8, 0});
  double coarse = 0, middle = 0, made = 0;
  for (const MadeTest& test : set.tests) {
    const TruthHistory exact = simulate(set.drawn.truth, test.floor, 6.25e-6);
    coarse += distance(simulate(set.drawn.truth, test.floor, 1e-3), exact);
    middle += distance(simulate(set.drawn.truth, test.floor, 2.5e-4), exact);
    made = std::max(made, distance(test.truth, exact));
  }
  EXPECT_LE(middle, coarse / 3);
  EXPECT_LE(made, 2e-5);  // a tenth of the least noise
}

std::string test_name(const testing::TestParamInfo<std::string>& info) { return info.param; }

INSTANTIATE_TEST_SUITE_P(HiddenEffect, Convergence,
                         testing::Values("static_friction", "rate_weakening", "flexible_legs", "moving_contents",
                                         "wall_impact", "slack_tether", "vertical_shaking", "rough_floor",
                                         "stick_ageing"),
                         test_name);

}  // namespace
}  // namespace freestand::test::convergence_test
