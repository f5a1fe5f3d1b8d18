// The fall of a block that overturns is no slip of it.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/units.hpp"
#include "support/floor_motions.hpp"
#include "support/random_cases.hpp"
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
    const double rocked = 0.25 * (1 - std::cos(std::atan(0.5 / 1.5)));
    EXPECT_NEAR(r.peak_slip_m, r.slid_path_m + rocked, 1e-12);
    EXPECT_LE(std::abs(r.residual_slip_m), r.peak_slip_m);
    if (model == Model::rock) {
      EXPECT_NEAR(std::abs(r.residual_slip_m), rocked, 1e-12);
    }
  }
}

// Where it began is no part of the fall.
TEST_P(OverturnedSlip, CountsFromWhereItBegan) {
  const FloorMotion push = rectangular_pulse(-8, 0.5);
  Specimen block{Block::rectangular(0.5, 1.5, 100), {2, 1.2}, {}, Model::slide_rock};
  block.start.slip_m = 0.1;
  const Response r = GetParam()(block, {&push});
  ASSERT_EQ(r.outcome, Outcome::overturned);
  const double rocked = 0.25 * (1 - std::cos(std::atan(0.5 / 1.5)));
  EXPECT_NEAR(r.peak_slip_m, 0.1 + r.slid_path_m + rocked, 1e-12);
}

// Slender blocks, of which many fall; one by one, and the fast ones in packs.
TEST_P(OverturnedSlip, IsNoLargerInTheEndThanItWas) {
  constexpr std::size_t count = 120;
  const CaseFamily family{.seed = 17, .alpha_high = 0.4, .vertical = 0.2};
  std::vector<RandomCase> cases;
  std::vector<Specimen> specimens;
  std::vector<Shaking> shakings;
  std::vector<Response> alone, block(count);
  for (std::size_t i = 0; i < count; ++i) {
    cases.push_back(random_case(family, i));
    specimens.push_back(cases.back().specimen);
    shakings.push_back(cases.back().shaking);
    alone.push_back(GetParam()(specimens[i], shakings[i]));
  }
  respond_batch(specimens, shakings, {}, block);
  for (const auto& responses : {alone, block}) {
    std::size_t fallen = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (responses[i].outcome != Outcome::overturned) continue;
      ++fallen;
      EXPECT_LE(std::abs(responses[i].residual_slip_m), responses[i].peak_slip_m) << cases[i].text();
    }
    EXPECT_GT(fallen, count / 5);
  }
}

}  // namespace
}  // namespace freestand::test
