// Law: centre of mass at e b to the right of the middle.
#include "effects/effect_fixture.hpp"

namespace freestand::test {
namespace {

TEST(OffsetMass, General) { expect_general({"offset_mass", {0.2}, {-0.2}, {0}, {Model::rock, Model::slide_rock}}); }

// Over the right corner rocking starts at |a| = g b (1 - e)/h, over the left one at g b (1 + e)/h. A floor that
// accelerates to the left leaves the block behind, over its right corner.
TEST(OffsetMass, RocksMoreEasilyOverTheNearerCorner) {
  const double e = 0.2;
  for (const Solver& solver : both_solvers)
    for (const int corner : {1, -1})
      for (const double share : {1 - 1e-6, 1 + 1e-6}) {
        const FloorMotion push = rectangular_pulse(-corner * g * 0.4 / 1.8 * (1 - corner * e) * share, 0.3);
        const Path r = run(solver, slender(1, {effect("offset_mass", {e})}), {&push}, 5);
        EXPECT_EQ(r.response.outcome, share < 1 ? Outcome::at_rest : Outcome::moved) << solver.name << corner;
        EXPECT_EQ(corner * r.points.at(290).rotation_rad > 0, share > 1) << solver.name;
      }
}

}  // namespace
}  // namespace freestand::test
