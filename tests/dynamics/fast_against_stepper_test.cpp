// The integrator of the sweep against the time-stepping with contact impulses (tests/support/contact_stepper), which
// shares no line with it: slipping impacts, flight and landing, tipping while sliding, unequal half widths, two
// friction coefficients.
//
// Tolerance: the stepper's own difference between two steps, 10 and 17 microseconds (no whole ratio, so that they do
// not fall together by chance), measures its error: at any time the two programs may differ by `least` plus `margin`
// times the largest own difference so far. Once the stepper disagrees with itself by more than `fanned_out`, the
// history is chaotic and says nothing more.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "base/units.hpp"
#include "support/contact_stepper.hpp"
#include "support/random_cases.hpp"
#include "support/solvers.hpp"

namespace freestand::test::fast_against_stepper_test {
namespace {

constexpr double step_s = 1e-5, coarse_step_s = 1e-3 / 59, output_s = 1e-3, margin = 6, fanned_out = 1e-4, least = 1e-6;

struct Count {
  int samples = 0, flights = 0, slipping_impacts = 0, slide_rocked = 0, tipped_while_sliding = 0, impacts = 0,
      failed = 0;
  double compared_s = 0, total_s = 0, worst = 0;
};

bool tips_while_sliding(const History& history) {
  for (const Event& event : history.events)
    if (event.from == Mode::slide && (event.to == Mode::slide_rock || event.to == Mode::rock)) return true;
  return false;
}

void compare(const CaseFamily& family, std::uint64_t number, Count& count) {
  const RandomCase c = random_case(family, number);
  const double end = c.shaking.duration_s() + 0.5;
  const StepperResult coarse = step_contacts(c.specimen, floor_of(c.shaking), {coarse_step_s, end, output_s});
  const StepperResult fine = step_contacts(c.specimen, floor_of(c.shaking), {step_s, end, output_s});
  ASSERT_FALSE(fine.inconsistent) << number << ' ' << c.text();
  History history;
  history.step_s = output_s;
  const Response fast = respond(c.specimen, c.shaking, {}, &history);
  ++count.samples;
  count.flights += fine.flew ? 1 : 0;
  count.slipping_impacts += fine.slipping_impact ? 1 : 0;
  count.slide_rocked += fine.slide_rocked ? 1 : 0;
  count.tipped_while_sliding += tips_while_sliding(history) ? 1 : 0;
  count.impacts += fine.impacts;
  const std::size_t points = std::min({coarse.points.size(), fine.points.size(), history.points.size()});
  count.total_s += static_cast<double>(fine.points.size()) * output_s;
  double own_slip = 0, own_rotation = 0;
  for (std::size_t i = 0; i < points; ++i) {
    const StepperPoint& p = fine.points[i];
    own_slip = std::max(own_slip, std::abs(p.slip_m - coarse.points[i].slip_m));
    own_rotation = std::max(own_rotation, std::abs(p.rotation_rad - coarse.points[i].rotation_rad));
    if (own_slip > fanned_out || own_rotation > fanned_out) break;
    const HistoryPoint& q = history.points[i];
    ASSERT_NEAR(q.time_s, p.time_s, 1e-9);
    count.compared_s += output_s;
    const double slip = std::abs(p.slip_m - q.slip_m), rotation = std::abs(p.rotation_rad - q.rotation_rad);
    count.worst = std::max({count.worst, slip, rotation});
    if (slip > least + margin * own_slip || rotation > least + margin * own_rotation) {
      ++count.failed;
      std::printf(
          "  differs: sample %llu at %.3f s, mode %s, slip %.7f/%.7f m (own %.1e), rotation %.7f/%.7f rad (own %.1e); "
          "%s\n",
          static_cast<unsigned long long>(number), p.time_s, name(q.mode), q.slip_m, p.slip_m, own_slip, q.rotation_rad,
          p.rotation_rad, own_rotation, c.text().c_str());
      break;
    }
  }
  ASSERT_NE(fast.outcome, Outcome::not_finite);
}

Count compare_family(const char* label, const CaseFamily& family, int samples) {
  Count count;
  for (int i = 0; i < samples; ++i) compare(family, static_cast<std::uint64_t>(i), count);
  std::printf(
      "%s: %d samples, %.1f of %.1f s compared, %d impacts, with slide-rock %d, slipping impact %d, flight %d, "
      "tip while sliding %d; worst difference %.1e; failed %d\n",
      label, count.samples, count.compared_s, count.total_s, count.impacts, count.slide_rocked, count.slipping_impacts,
      count.flights, count.tipped_while_sliding, count.worst, count.failed);
  return count;
}

CaseFamily short_family(std::uint64_t seed) {
  CaseFamily family;
  family.seed = seed;
  family.coulomb = 1;
  family.one_model = 0;
  family.vertical = 0;
  family.duration_low_s = 1;
  family.duration_high_s = 2;
  family.excess_low = 1.2;
  family.alpha_high = 0.7;
  family.mu_low = 0.15;
  return family;
}

TEST(FastAgainstStepper, SlideAndRock) {
  const Count count = compare_family("slide and rock", short_family(41), 25);
  EXPECT_EQ(count.failed, 0);
  EXPECT_GT(count.compared_s, 0.5 * count.total_s);
  EXPECT_GE(count.slide_rocked, 5);
}

// Friction a little above b/h, where blocks rock, slip and tip while they slide.
TEST(FastAgainstStepper, SlideRock) {
  CaseFamily family = short_family(42);
  family.alpha_low = 0.25;
  family.alpha_high = 0.4;
  family.mu_low = 0.3;
  family.mu_high = 0.55;
  family.excess_low = 1.5;
  const Count count = compare_family("slide-rock", family, 30);
  EXPECT_EQ(count.failed, 0);
  EXPECT_GT(count.compared_s, 0.4 * count.total_s);
  EXPECT_GE(count.slide_rocked, 15);
  EXPECT_GE(count.slipping_impacts, 5);
}

TEST(FastAgainstStepper, UnequalHalfWidthsAndGivenInertia) {
  CaseFamily family = short_family(43);
  family.asymmetric = 1;
  family.alpha_low = 0.25;
  family.alpha_high = 0.5;
  family.mu_low = 0.2;
  family.mu_high = 0.6;
  family.excess_low = 1.5;
  const Count count = compare_family("unequal half widths", family, 60);
  EXPECT_EQ(count.failed, 0);
  EXPECT_GT(count.compared_s, 0.4 * count.total_s);
  EXPECT_GE(count.tipped_while_sliding, 3);  // slides one way, reverses, and the other corner is too near
}

TEST(FastAgainstStepper, FlightAndLanding) {
  CaseFamily family = short_family(44);
  family.vertical = 1;
  family.vertical_peak_g = 2.5;
  const Count count = compare_family("strong vertical shaking", family, 25);
  EXPECT_EQ(count.failed, 0);
  EXPECT_GE(count.flights, 8);
  EXPECT_GT(count.compared_s, 0.3 * count.total_s);
}

}  // namespace
}  // namespace freestand::test::fast_against_stepper_test
