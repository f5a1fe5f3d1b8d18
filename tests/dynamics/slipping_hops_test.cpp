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

// Beyond the hops of a tighter tolerance's rows, which may press harder, nothing changes with the tolerance: of two peaks the one of
// more hops is the larger.
template <class Respond>
void expect_no_peak_after_a_row(const std::vector<std::uint64_t>& numbers, double first_tolerance, Respond&& respond) {
  for (const std::uint64_t number : numbers) {
    const RandomCase c = random_case(unequal_corners(), number);
    double most = 0, slip = 0;
    Settings settings;
    for (settings.tolerance = first_tolerance; settings.tolerance > 0.9e-12; settings.tolerance *= 0.316227766) {
      const Response r = respond(c, settings);
      if (most > 0 && std::abs(r.residual_slip_m - slip) < 1e-6) {
        EXPECT_GT(r.peak_acceleration_mps2, (1 - 1e-3) * most) << number << ", tolerance " << settings.tolerance;
      }
      most = std::max(most, r.peak_acceleration_mps2);
      slip = r.residual_slip_m;
    }
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

// Under Housner's law number 2832, under Coulomb's 1197.
TEST(SlippingHops, SlideNoFurtherThanTheRowInWhichTheySlip) {
  std::vector<std::uint64_t> all(3000);
  std::iota(all.begin(), all.end(), 0);
  expect_no_peak_after_a_row(all, 1e-7, alone);
  expect_no_peak_after_a_row(all, 1e-7, in_packs);
  expect_no_peak_after_a_row({1197, 2832}, 1e-10, by_reference);
}

TEST(SlippingHops, EndInTheirLimitUnderHousnersLaw) { expect_limit(ImpactLaw::housner); }
TEST(SlippingHops, EndInTheirLimitUnderCoulombsLaw) { expect_limit(ImpactLaw::coulomb); }

}  // namespace
}  // namespace freestand::test
