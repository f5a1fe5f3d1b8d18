// The fall of a block that overturns is no slip of it.
#include <gtest/gtest.h>

#include <cmath>

#include "base/units.hpp"
#include "support/floor_motions.hpp"
#include "support/solvers.hpp"

namespace freestand::test {
namespace {

FREESTAND_ON_BOTH_SOLVERS(OverturnedSlip);

// With friction that holds, its middle is displaced by half the base times 1 - cos(alpha) where it can still stand.
TEST_P(OverturnedSlip, LeavesOutTheFall) {
  const FloorMotion push = rectangular_pulse(-8, 0.5);
  for (const Model model : {Model::rock, Model::slide_rock}) {
    const Specimen block{Block::rectangular(0.5, 1.5, 100), {2, 1.2}, {}, model};
    const Response r = GetParam()(block, {&push});
    ASSERT_EQ(r.outcome, Outcome::overturned);
    EXPECT_NEAR(r.peak_slip_m, r.slid_path_m + 0.25 * (1 - std::cos(std::atan(0.5 / 1.5))), 1e-12);
  }
}

}  // namespace
}  // namespace freestand::test
