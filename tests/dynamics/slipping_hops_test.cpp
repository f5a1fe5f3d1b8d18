// Where slipping hops end, the slip that goes on is the limit of the endless row of hops, not what the threshold of
// rest leaves: the demands at the default tolerance are those of a tolerance ten thousand times smaller, to 1e-6 m (a local
// error of 1e-9 grows to some 1e-7 over the hundred impacts of such samples; cutting the row short costs up to 5e-4 m). A slip that
// ends within the row is followed by no slide on both corners, which would rub under the whole weight.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <vector>

#include "base/motion_table.hpp"
#include "base/units.hpp"
#include "dynamics/row_of_hops.hpp"
#include "support/random_cases.hpp"
#include "support/solvers.hpp"

namespace freestand::test {
namespace {

bool hops_end_slipping(const History& history) {
  return std::any_of(history.events.begin(), history.events.end(), [](const Event& event) {
    return event.impact && event.from == Mode::slide_rock && event.to == Mode::slide;
  });
}

void expect_limit(ImpactLaw law) {
  CaseFamily family;
  family.seed = 71;
  family.alpha_low = 0.25;
  family.mu_low = 0.3;
  family.excess_low = 1.2;
  family.one_model = 0;
  family.duration_low_s = 2;
  family.duration_high_s = 3;
  int compared = 0, apart = 0;
  double worst = 0;
  for (std::uint64_t number = 0; number < 400; ++number) {
    RandomCase c = random_case(family, number);
    if (c.specimen.impact.law != law) continue;
    History history;
    history.step_s = 0;
    const Response usual = respond(c.specimen, c.shaking, {}, &history);
    if (!hops_end_slipping(history)) continue;
    Settings tight;
    tight.tolerance = 1e-13;
    const Response exact = respond(c.specimen, c.shaking, tight);
    const double difference = std::max(std::abs(usual.peak_slip_m - exact.peak_slip_m),
                                       std::abs(usual.residual_slip_m - exact.residual_slip_m));
    ++compared;
    apart += difference > 1e-6 ? 1 : 0;
    worst = std::max(worst, difference);
  }
  std::printf("%d samples whose hops end slipping, %d of them off by more than 1e-6 m, worst %.1e m\n", compared, apart,
              worst);
  EXPECT_GE(compared, 10);
  EXPECT_LE(apart, compared / 10);
}

CaseFamily unequal_corners() {
  CaseFamily family;
  family.seed = 71;
  family.alpha_low = 0.25;
  family.mu_low = 0.3;
  family.mu_high = 0.7;
  family.excess_low = 1.2;
  family.one_model = family.vertical = 0;
  family.asymmetric = 0.7;
  family.duration_low_s = 2;
  family.duration_high_s = 3;
  return family;
}

// What the floor changes in the row of hops that a tolerance t leaves out. Its first hop turns the block by t at most; with the pull
// alpha = g b/J, which slipping may take to a quarter, it lasts 2 sqrt(2 t/alpha), and the hops after it are each at most
// e = 1 - b (b_l + b_r)/J times the one before. b: the smaller half width, J about the other corner.
double change_in_row(const RandomCase& c, double tolerance) {
  const auto steepest = [&](const auto& record) {
    double most = 0;
    for (std::size_t i = 1; i < record.size(); ++i) most = std::max(most, std::abs(record[i] - record[i - 1]));
    return most / c.motion->table->step_s;
  };
  const Block& block = c.specimen.block;
  const auto [small, large] = std::minmax(block.left_m, block.right_m);
  const double inertia = block.gyration2_m2 + block.height_m * block.height_m + large * large;
  const double pull = standard_gravity_mps2 * small / inertia, lost = small * (small + large) / inertia;
  const double row = 2 * std::sqrt(2 * tolerance / (0.25 * pull)) / lost;
  return row * (steepest(c.motion->table->acceleration) + steepest(c.motion->table->vertical));
}

// The hops of a row are felt, whether a tolerance goes through them or not: as the floor is at its beginning, and at its end, whose time
// is that of accelerations that stay. What that misses of the floor's change is less than this share (measured: all of these pass).
constexpr double at_its_ends = 0.05;
template <class Respond>
void expect_the_same_peaks(const CaseFamily& family, const std::vector<std::uint64_t>& numbers, Respond&& respond) {
  Settings settings;
  settings.tolerance = 1e-12;
  std::vector<Response> exact;
  for (const std::uint64_t number : numbers) exact.push_back(respond(random_case(family, number), settings));
  for (settings.tolerance = 1e-9; settings.tolerance < 2e-7; settings.tolerance *= 10) {
    std::size_t compared = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const RandomCase c = random_case(family, numbers[i]);
      const Response r = respond(c, settings);
      if (std::abs(r.residual_slip_m - exact[i].residual_slip_m) > 1e-6 || r.outcome != exact[i].outcome) continue;
      ++compared;
      EXPECT_NEAR(r.peak_acceleration_mps2, exact[i].peak_acceleration_mps2,
                  1e-6 * exact[i].peak_acceleration_mps2 + at_its_ends * change_in_row(c, settings.tolerance))
          << numbers[i] << ", tolerance " << settings.tolerance << ' ' << c.text();
    }
    EXPECT_GE(compared, numbers.size() * 98 / 100);
  }
}

Response alone(const RandomCase& c, const Settings& settings) { return respond(c.specimen, c.shaking, settings); }
Response in_packs(const RandomCase& c, const Settings& settings) {
  Response r;
  respond_batch({&c.specimen, 1}, {&c.shaking, 1}, settings, {&r, 1});
  return r;
}
Response by_reference(const RandomCase& c, const Settings& settings) {
  return respond_reference(c.specimen, c.shaking, settings);
}

// In 1804 the slip of each blow ends within its hop; 1294 and 2595 end a slip in hops of microseconds; a blow stops the slip of 12300,
// which goes on after it. In 8108, 21845, 26259 and 29662 the floor's push takes nearly all of the weight's pull: what starts as a
// small hop is none.
TEST(SlippingHops, AreFeltAtAnyTolerance) {
  std::vector<std::uint64_t> all(1500);
  std::iota(all.begin(), all.end(), 0);
  const std::vector<std::uint64_t> telling = {57,   1197, 1294,  1804,  2022,  2309, 2595,
                                              2832, 8108, 12300, 21845, 26259, 29662};
  for (const double vertical : {0.0, 1.0}) {
    CaseFamily family = unequal_corners();
    family.vertical = vertical;
    for (const auto& numbers : {all, telling}) {
      expect_the_same_peaks(family, numbers, alone);
      expect_the_same_peaks(family, numbers, in_packs);
    }
    expect_the_same_peaks(family, telling, by_reference);
  }
}

// The same where nothing but the upright block's rocking can be felt, and in packs what it feels at the end of its record.
TEST(RockingHops, AreFeltAtAnyToleranceAndInPacks) {
  CaseFamily family = unequal_corners();
  family.one_model = 1;
  std::vector<std::uint64_t> all(1000);
  std::iota(all.begin(), all.end(), 0);
  expect_the_same_peaks(family, all, alone);
  expect_the_same_peaks(family, all, in_packs);
  for (const double free_vibration_s : {60.0, 0.05}) {
    Settings settings;
    settings.free_vibration_s = free_vibration_s;
    for (const std::uint64_t number : all) {
      const RandomCase c = random_case(family, number);
      const Response single = alone(c, settings), pack = in_packs(c, settings);
      EXPECT_EQ(single.outcome, pack.outcome) << number << ' ' << c.text();
      EXPECT_NEAR(single.peak_acceleration_mps2, pack.peak_acceleration_mps2,
                  1e-6 * single.peak_acceleration_mps2 + change_in_row(c, settings.tolerance))
          << number << ' ' << c.text();
    }
  }
}

// Two hops keep q of the rate r, and take c r from the slip: from w it is w - c r (1 - q^n)/(1 - q) after n times two, in which it stops
// if w (1 - q) < c r. From then on two hops end at the slip k r', r' their rate, or have none (k = 0): stopped once, or each time.
TEST(RowOfHops, LeavesTheSlipThatItStopsAndThatGoesOn) {
  constexpr double q = 0.6, c = 1, lasts = 2;
  const auto leaves = [&](double w, double k, bool once) {
    bool stopped = false;
    dynamics::HopRow row{1, w};
    const double slip = dynamics::slip_after_stops(row, [&](dynamics::HopRow& at) {
      const bool stops = stopped ? !once : at.slip - c * at.rate <= 0;
      at.lasts += lasts * at.rate;
      at.slip = stops ? -k * at.rate : at.slip - c * at.rate;
      at.stops = at.stops || stops;
      stopped = stopped || stops;
      at.rate *= q;
      return true;
    });
    return std::pair(slip, row.lasts);
  };
  EXPECT_NEAR(leaves(3, 0, true).first, 3 - c / (1 - q), 1e-12);  // it does not stop
  EXPECT_NEAR(leaves(3, 0, true).second, lasts / (1 - q), 1e-12);
  EXPECT_EQ(leaves(2.4, 0, false).first, 0);
  EXPECT_EQ(leaves(2.4, 0.3, false).first, 0);
  // It stops in the seventh two hops: 2.4 < 2.5 (1 - q^7); then it goes on at -0.3 q^6, and so for good.
  ASSERT_GT(2.4, c * (1 - std::pow(q, 6)) / (1 - q));
  ASSERT_LT(2.4, c * (1 - std::pow(q, 7)) / (1 - q));
  EXPECT_NEAR(leaves(2.4, 0.3, true).first, -0.3 * std::pow(q, 6) - c * std::pow(q, 7) / (1 - q), 1e-12);
  EXPECT_NEAR(leaves(2.4, 0.3, true).second, lasts / (1 - q), 1e-12);
}

TEST(SlippingHops, EndInTheirLimitUnderHousnersLaw) { expect_limit(ImpactLaw::housner); }
TEST(SlippingHops, EndInTheirLimitUnderCoulombsLaw) { expect_limit(ImpactLaw::coulomb); }

}  // namespace
}  // namespace freestand::test
