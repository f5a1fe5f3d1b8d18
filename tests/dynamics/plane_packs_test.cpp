// Sliding in the plane in packs: each lane has the bits of a single sample, with any instruction set and in company of any others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <freestand/simulate.hpp>
#include <limits>
#include <vector>

#include "base/units.hpp"
#include "support/isa.hpp"
#include "support/keyed_random.hpp"
#include "support/plane_motions.hpp"

namespace freestand::test::plane_packs_test {
namespace {

struct Samples {
  std::vector<FloorMotion> motions;
  std::vector<Specimen> specimens;
  std::vector<Shaking> shakings;

  std::vector<Response> batch(const Settings& settings) const {
    std::vector<Response> responses(specimens.size());
    respond_batch(specimens, shakings, settings, responses);
    return responses;
  }
};

// Friction that differs between directions or not, floors that shake vertically or not, each sample with its own numbers.
Samples random_samples(std::size_t count) {
  Samples s;
  for (std::uint64_t i = 0; i < 24; ++i) s.motions.push_back(plane_case(i).motion());
  for (std::uint64_t i = 0; i < count; ++i) {
    KeyedRandom random(31, i);
    const std::uint64_t number = i * 7 % 24;
    const PlaneCase c = plane_case(number);
    Specimen block = c.specimen;
    block.block = Block::rectangular(random.uniform(0.2, 1), random.uniform(0.3, 3), 100);
    block.friction.mu_k *= random.uniform(0.6, 1.6);
    block.friction.mu_s = block.friction.mu_k * (random.chance(0.5) ? 1 : random.uniform(1, 1.5));
    if (random.chance(0.5)) {
      block.friction.ratio_across = random.log_uniform(0.4, 2.5);
      block.friction.axis_rad = random.uniform(-3, 3);
    }
    s.specimens.push_back(block);
    s.shakings.push_back({&s.motions[number], random.uniform(-2, 2), random.uniform(0.5, 1.5),
                          random.chance(0.7) ? c.vertical_scale() : 0});
  }
  return s;
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

void expect_same(const Response& a, const Response& b, std::size_t sample) {
  EXPECT_EQ(a.outcome, b.outcome) << sample;
  EXPECT_EQ(a.events, b.events) << sample;
  EXPECT_EQ(a.impacts, b.impacts) << sample;
  EXPECT_TRUE(same_bits(a.peak_slip_m, b.peak_slip_m)) << sample << ' ' << a.peak_slip_m << ' ' << b.peak_slip_m;
  EXPECT_TRUE(same_bits(a.residual_slip_m, b.residual_slip_m)) << sample;
  EXPECT_TRUE(same_bits(a.residual_cross_slip_m, b.residual_cross_slip_m)) << sample;
  EXPECT_TRUE(same_bits(a.slid_path_m, b.slid_path_m)) << sample;
  EXPECT_TRUE(same_bits(a.peak_acceleration_mps2, b.peak_acceleration_mps2)) << sample;
  EXPECT_TRUE(same_bits(a.end_time_s, b.end_time_s)) << sample;
}

std::vector<Response> one_by_one(const Samples& s, const Settings& settings) {
  std::vector<Response> alone;
  for (std::size_t i = 0; i < s.specimens.size(); ++i)
    alone.push_back(respond(s.specimens[i], s.shakings[i], settings));
  return alone;
}

class PlanePacks : public testing::TestWithParam<const char*> {};

// More samples than lanes, so that lanes are filled again, and fewer.
TEST_P(PlanePacks, HaveTheBitsOfSingleSamples) {
  const Isa isa(GetParam());
  if (!isa.there()) GTEST_SKIP() << "this machine or this build does not have " << GetParam();
  for (const double tolerance : {1e-9, 1e-6, 1e-12}) {
    const Samples s = random_samples(tolerance == 1e-9 ? 240 : 40);
    const Settings settings{.tolerance = tolerance};
    const std::vector<Response> alone = one_by_one(s, settings), together = s.batch(settings);
    int moved = 0, thrown = 0;
    for (std::size_t i = 0; i < alone.size(); ++i) {
      expect_same(together[i], alone[i], i);
      moved += alone[i].outcome == Outcome::moved;
      thrown += alone[i].impacts > 0;
    }
    EXPECT_GT(moved, 20);
    EXPECT_GT(thrown, 0);
  }
  for (const std::size_t count : {1, 2, 3, 5, 9}) {
    const Samples s = random_samples(count);
    const std::vector<Response> alone = one_by_one(s, {}), together = s.batch({});
    for (std::size_t i = 0; i < count; ++i) expect_same(together[i], alone[i], i);
  }
}

// What cannot be computed says so, and its neighbours in the pack do not notice. A floor that does not move leaves the block at rest.
TEST_P(PlanePacks, BadNumbersStayWithTheirSample) {
  const Isa isa(GetParam());
  if (!isa.there()) GTEST_SKIP() << "this machine or this build does not have " << GetParam();
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  Samples s = random_samples(40);
  const std::vector<Response> good = s.batch({});
  std::vector<std::size_t> bad;
  for (const double scale : {nan, infinite, -infinite, 1e300}) {
    bad.push_back(4 * bad.size());
    s.shakings[bad.back()].scale = scale;
  }
  for (const double mu : {nan, infinite, -0.1}) {
    bad.push_back(4 * bad.size());
    s.specimens[bad.back()].friction.mu_k = mu;
  }
  s.shakings[30].scale = s.shakings[30].vertical_scale = 0;
  s.specimens[34].friction = {0, 0};
  const std::vector<Response> alone = one_by_one(s, {}), together = s.batch({});
  for (std::size_t i = 0; i < together.size(); ++i) {
    const bool is_bad = std::find(bad.begin(), bad.end(), i) != bad.end();
    if (is_bad)
      EXPECT_EQ(together[i].outcome, Outcome::not_finite) << i;
    else if (i != 30 && i != 34)
      expect_same(together[i], good[i], i);
    if (!is_bad) expect_same(together[i], alone[i], i);
  }
  EXPECT_EQ(together[30].outcome, Outcome::at_rest);
  EXPECT_EQ(together[30].peak_slip_m, 0);
  EXPECT_EQ(together[34].outcome, Outcome::moved);
}

INSTANTIATE_TEST_SUITE_P(Isa, PlanePacks, testing::ValuesIn(instruction_sets));

}  // namespace
}  // namespace freestand::test::plane_packs_test
