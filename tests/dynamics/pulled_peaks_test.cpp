// Peaks of blocks that a spring and a drag pull, in packs against single samples: where a search of tens of thousands of random cases found
// packs that missed them.
#include <gtest/gtest.h>

#include <algorithm>
#include <freestand/simulate.hpp>
#include <memory>
#include <vector>

#include "base/motion_table.hpp"
#include "support/random_cases.hpp"
#include "support/slip_laws.hpp"

namespace freestand::test {
namespace {

RandomCase case_of(std::uint64_t seed, std::uint64_t index, double stiffness, double drag, double asymmetric = 0.25,
                   double coulomb = 0) {
  CaseFamily family;
  family.seed = seed;
  family.one_model = family.vertical = 0;
  family.alpha_high = 0.8;
  family.asymmetric = asymmetric;
  family.coulomb = coulomb;
  RandomCase one = random_case(family, index);
  one.specimen.model = Model::slide_rock;
  one.specimen.effects = {{&pulled, {stiffness, drag}}};
  one.shaking.scale *= 1 + 0.01 * static_cast<double>(index % 7);
  return one;
}

// The record with every `stride`-th of its knots, up to knot `end`.
void thin_out(RandomCase& one, int stride, int end) {
  const MotionTable& table = *one.motion->table;
  std::vector<double> a;
  for (int k = 0; k < std::min(table.knots, end); k += stride)
    a.push_back(table.acceleration[static_cast<std::size_t>(k)]);
  one.motion = std::make_shared<FloorMotion>(piecewise_linear("thin", table.step_s * stride, a));
  one.shaking.motion = one.motion.get();
}

Response in_pack(const RandomCase& one, const Settings& settings = {}) {
  Response response;
  respond_batch(std::span(&one.specimen, 1), std::span(&one.shaking, 1), settings, std::span(&response, 1));
  return response;
}

// The corner stands far to the left while the block leans to the right, and a spring turns it round above the floor.
TEST(PulledPeaks, OfTheSlipWhereTheRotationIsLeast) {
  const RandomCase one = case_of(9101, 54885, 96.914559860364491, 0);
  const double peak = respond(one.specimen, one.shaking).peak_slip_m;
  EXPECT_NEAR(peak, 0.3215251, 1e-6);
  EXPECT_NEAR(in_pack(one).peak_slip_m, peak, 1e-8);
}

// Between the ends of a long step, at neither of which it comes near.
TEST(PulledPeaks, OfTheAccelerationWithinAStep) {
  RandomCase one = case_of(9110, 9295, 0, 6.745072407920957, 1);
  thin_out(one, static_cast<int>(0.06 / one.motion->table->step_s), one.motion->table->knots);
  const double peak = respond(one.specimen, one.shaking).peak_acceleration_mps2;
  EXPECT_NEAR(peak, 2.488565, 1e-5);
  EXPECT_NEAR(in_pack(one).peak_acceleration_mps2, peak, 1e-6 * peak);
}

// Coulomb's impacts: a slip that no hop follows ends with what the blow left of it.
TEST(PulledPeaks, OfTheAccelerationInRowsOfHops) {
  const RandomCase one = case_of(9213, 18919, 949.69163560440575, 21.973402988550717, 1, 1);
  const double peak = respond(one.specimen, one.shaking).peak_acceleration_mps2;
  EXPECT_NEAR(peak, 11.866795, 1e-5);
  EXPECT_NEAR(in_pack(one).peak_acceleration_mps2, peak, 1e-6 * peak);
}

// Records that end with a push, and nobody waits after them: what stops within the last interval is not told as if somebody had.
TEST(PulledEnds, AreNotLaterThanIsWaitedFor) {
  const Settings settings{.free_vibration_s = 0};
  for (const Model model : {Model::slide, Model::slide_rock})
    for (std::uint64_t i = 0; i < 200; ++i) {
      RandomCase one = case_of(9009, i, 0.5 + static_cast<double>(i % 60), 0.1 + static_cast<double>(i % 7));
      one.specimen.model = model;
      thin_out(one, 1, one.motion->table->knots / 2);
      const Response truth = respond(one.specimen, one.shaking, settings), pack = in_pack(one, settings);
      EXPECT_EQ(pack.outcome, truth.outcome) << i;
      EXPECT_NEAR(pack.peak_slip_m, truth.peak_slip_m, 1e-7 * std::max(1.0, truth.peak_slip_m)) << i;
      EXPECT_NEAR(pack.end_time_s, truth.end_time_s, 1e-6) << i;
    }
}

}  // namespace
}  // namespace freestand::test
