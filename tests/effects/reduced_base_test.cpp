// Law: b becomes b (1 - r), the inertia about the centre of mass stays.
#include "effects/effect_fixture.hpp"

namespace freestand::test {
namespace {

TEST(ReducedBase, General) { expect_general({"reduced_base", {0.15}, {0.15}, {0}, {Model::rock, Model::slide_rock}}); }

// Rocking starts at a = g b (1 - r)/h.
TEST(ReducedBase, RocksEarlier) {
  const double r = 0.15, limit = g * 0.4 / 1.8 * (1 - r);
  for (const Solver& solver : both_solvers)
    for (const double share : {1 - 1e-6, 1 + 1e-6}) {
      const FloorMotion push = rectangular_pulse(limit * share, 0.3);
      const Response response = solver(slender(1, {effect("reduced_base", {r})}), {&push});
      EXPECT_EQ(response.outcome, share < 1 ? Outcome::at_rest : Outcome::moved) << solver.name;
    }
}

// It is the block with these numbers, given as such.
TEST(ReducedBase, IsTheNarrowerBlockOfTheSameInertia) {
  const FloorMotion push = staircase({0.2, 0.2}, {-4, 3});
  Specimen given = slender(0.6);
  given.block.left_m = given.block.right_m = 0.2 * 0.85;
  const Response a = respond(slender(0.6, {effect("reduced_base", {0.15})}), {&push}), b = respond(given, {&push});
  EXPECT_NEAR(a.peak_rotation_rad, b.peak_rotation_rad, 1e-12);
  EXPECT_GT(b.peak_rotation_rad, 0.01);
}

}  // namespace
}  // namespace freestand::test
