// Sliding in packs on records as rough as they come: white and red noise, in steps, longer than what the kernel looks over
// at once, against the same samples one by one. Every slip counts: the same events, and paths to 1e-9.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <freestand/simulate.hpp>
#include <vector>

#include "base/units.hpp"
#include "support/keyed_random.hpp"

namespace freestand::test {
namespace {

FloorMotion rough_record(KeyedRandom& random) {
  constexpr std::size_t knots = 9001;
  const double memory = random.uniform(0, 0.95), grain = random.chance(0.3) ? 0.25 : 0;
  std::vector<double> a(knots);
  double state = 0;
  for (double& value : a) {
    state = memory * state + random.normal();
    value = grain > 0 ? grain * std::round(state / grain) : state;
  }
  if (random.chance(0.3)) std::fill(a.begin() + 500, a.begin() + 7000, 0.0);
  return piecewise_linear("rough", 1.0 / 128, a);
}

TEST(RoughRecord, SlidesTheSameInPacks) {
  std::vector<FloorMotion> records;
  for (std::uint64_t i = 0; i < 6; ++i) {
    KeyedRandom random(90, i);
    records.push_back(rough_record(random));
    ASSERT_TRUE(records.back().table);
  }
  std::vector<Specimen> specimens(120);
  std::vector<Shaking> shakings(specimens.size());
  for (std::size_t i = 0; i < specimens.size(); ++i) {
    KeyedRandom random(91, i);
    const double mu_k = random.uniform(0.05, 0.5);
    specimens[i].model = Model::slide;
    specimens[i].block = Block::rectangular(0.6, 0.9, 100);
    specimens[i].friction = {mu_k * (random.chance(0.5) ? 1.0 : random.uniform(1, 1.3)), mu_k};
    const FloorMotion& record = records[i % records.size()];
    double peak = 0;
    for (std::size_t k = 0; k < record.segments(); ++k) peak = std::max(peak, std::abs(record.horizontal_mps2[2 * k]));
    const double scale = standard_gravity_mps2 * mu_k * random.log_uniform(0.9, 5) / peak;
    shakings[i] = {&record, random.chance(0.5) ? scale : -scale};
  }
  std::vector<Response> packs(specimens.size());
  respond_batch(specimens, shakings, {}, packs);
  int events = 0;
  for (std::size_t i = 0; i < specimens.size(); ++i) {
    const Response single = respond(specimens[i], shakings[i]);
    EXPECT_EQ(packs[i].events, single.events) << i;
    const double near = 1e-9 * single.slid_path_m + 1e-12;
    EXPECT_NEAR(packs[i].slid_path_m, single.slid_path_m, near) << i;
    EXPECT_NEAR(packs[i].peak_slip_m, single.peak_slip_m, near) << i;
    EXPECT_NEAR(packs[i].residual_slip_m, single.residual_slip_m, near) << i;
    EXPECT_NEAR(packs[i].peak_acceleration_mps2, single.peak_acceleration_mps2, 1e-9) << i;
    events += single.events;
  }
  EXPECT_GT(events, 30000);
}

}  // namespace
}  // namespace freestand::test
