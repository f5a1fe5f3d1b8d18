// The integrator of the sweep against the event-driven reference, over thousands of random samples.
//
// Stated tolerance: peak and residual slip 1e-7 m (of slips up to 1 m, relative above), peak rotation 1e-7 rad, same
// outcome, same order of modes. Two samples in a thousand may lie so near an edge (grazing, long rattling, the balance
// point) that round-off decides; they are counted and printed, not hidden.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "support/random_cases.hpp"
#include "support/solvers.hpp"

namespace freestand::test {
namespace {

constexpr double tolerance = 1e-7;

struct Count {
  int samples = 0, still = 0, overturned = 0, impacts = 0, outcome = 0, edp = 0, modes = 0;
  double worst_slip_m = 0, worst_rotation_rad = 0;  // of the samples within the tolerance
};

double slip_difference(double a, double b) { return std::abs(a - b) / std::max({1.0, std::abs(a), std::abs(b)}); }

bool same_modes(const History& a, const History& b) {
  if (a.events.size() != b.events.size()) return false;
  for (std::size_t i = 0; i < a.events.size(); ++i)
    if (a.events[i].to != b.events[i].to || a.events[i].pivot != b.events[i].pivot) return false;
  return true;
}

// The first few of each family, so that a bad day does not flood the log.
void print_difference(const Count& count, const char* what, std::uint64_t number, const RandomCase& c,
                      const Response& fast, const Response& reference) {
  if (count.outcome + count.edp + count.modes > 12) return;
  std::printf(
      "  %s differs: sample %llu, %s/%s, slip %.9f/%.9f, residual %.9f/%.9f, rotation %.9f/%.9f, events %d/%d; %s\n",
      what, static_cast<unsigned long long>(number), name(fast.outcome), name(reference.outcome), fast.peak_slip_m,
      reference.peak_slip_m, fast.residual_slip_m, reference.residual_slip_m, fast.peak_rotation_rad,
      reference.peak_rotation_rad, fast.events, reference.events, c.text().c_str());
}

void compare(const CaseFamily& family, std::uint64_t number, Count& count) {
  const RandomCase c = random_case(family, number);
  History a, b;
  a.step_s = b.step_s = 0;
  const Settings tight{.tolerance = 1e-12};
  const Response fast = respond(c.specimen, c.shaking, tight, &a);
  const Response reference = respond_reference(c.specimen, c.shaking, tight, &b);
  ++count.samples;
  count.still += reference.outcome == Outcome::at_rest ? 1 : 0;
  count.overturned += reference.outcome == Outcome::overturned ? 1 : 0;
  count.impacts += reference.impacts;
  if (fast.outcome != reference.outcome) {
    ++count.outcome;
    print_difference(count, "outcome", number, c, fast, reference);
    return;
  }
  const double slip = std::max(slip_difference(fast.peak_slip_m, reference.peak_slip_m),
                               slip_difference(fast.residual_slip_m, reference.residual_slip_m));
  const double rotation = std::abs(fast.peak_rotation_rad - reference.peak_rotation_rad);
  if (!(slip <= tolerance && rotation <= tolerance)) {
    ++count.edp;
    print_difference(count, "demand", number, c, fast, reference);
    return;
  }
  count.worst_slip_m = std::max(count.worst_slip_m, slip);
  count.worst_rotation_rad = std::max(count.worst_rotation_rad, rotation);
  if (!same_modes(a, b)) {
    ++count.modes;
    print_difference(count, "order of modes", number, c, fast, reference);
  }
}

Count compare_family(const char* label, const CaseFamily& family, int samples) {
  const bool longer = std::getenv("FREESTAND_LONG_TESTS") != nullptr;
  Count count;
  for (int i = 0; i < samples * (longer ? 10 : 1); ++i) compare(family, static_cast<std::uint64_t>(i), count);
  std::printf(
      "%s: %d samples, %d still, %d overturned, %d impacts; differ in outcome %d, demand %d, order of modes %d; "
      "the others agree within %.1e m and %.1e rad\n",
      label, count.samples, count.still, count.overturned, count.impacts, count.outcome, count.edp, count.modes,
      count.worst_slip_m, count.worst_rotation_rad);
  return count;
}

void expect_agreement(const Count& count) {
  EXPECT_LE(count.outcome + count.edp, 0.002 * count.samples);
  EXPECT_LE(count.modes, 0.005 * count.samples);
  EXPECT_LT(count.still, 0.5 * count.samples);
}

TEST(FastAgainstReference, AllKindsOfBlocks) { expect_agreement(compare_family("all kinds", {}, 2000)); }

TEST(FastAgainstReference, SlenderBlocks) {
  CaseFamily family;
  family.seed = 2;
  family.alpha_high = 0.4;
  family.mu_low = 0.2;
  family.excess_low = 1;
  family.one_model = 0;
  expect_agreement(compare_family("slender", family, 500));
}

TEST(FastAgainstReference, StrongVerticalShaking) {
  CaseFamily family;
  family.seed = 3;
  family.vertical = 1;
  family.vertical_peak_g = 1.6;
  family.one_model = 0;
  family.duration_low_s = 3;
  family.duration_high_s = 5;
  expect_agreement(compare_family("strong vertical shaking", family, 500));
}

}  // namespace
}  // namespace freestand::test
