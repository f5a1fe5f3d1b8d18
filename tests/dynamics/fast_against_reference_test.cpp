// The integrator of the sweep against the event-driven reference, over thousands of random samples.
//
// Stated tolerance: peak and residual slip 1e-7 m (of slips up to 1 m, relative above), peak rotation 1e-7 rad, same
// outcome, same order of modes. Both run at 1e-12. Long rattling, grazing and the balance point amplify round-off; a
// sample is called sensitive when a change of its shaking by 1e-10 or less changes its answer (or its modes) as far as the two
// are apart. Of the others all but one in a thousand, and one, must agree in outcome and demand, and five in a thousand
// in the order of modes; the sensitive ones that differ are counted and printed, not hidden.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "support/random_cases.hpp"
#include "support/repeats.hpp"
#include "support/solvers.hpp"

namespace freestand::test::fast_against_reference_test {
namespace {

constexpr double tolerance = 1e-7;

struct Count {
  int samples = 0, still = 0, overturned = 0, impacts = 0, outcome = 0, edp = 0, modes = 0;
  int sensitive = 0;                                // of those that differ
  double worst_slip_m = 0, worst_rotation_rad = 0;  // of the samples within the tolerance
};

double slip_difference(double a, double b) { return std::abs(a - b) / std::max({1.0, std::abs(a), std::abs(b)}); }

bool same_modes(const History& a, const History& b) {
  if (a.events.size() != b.events.size()) return false;
  for (std::size_t i = 0; i < a.events.size(); ++i)
    if (a.events[i].to != b.events[i].to || a.events[i].pivot != b.events[i].pivot) return false;
  return true;
}

struct Run {
  Response response;
  History history;
};

template <class Solver>
Run run(Solver solver, const RandomCase& c, double factor = 1) {
  Run run;
  run.history.step_s = 0;
  Shaking shaking = c.shaking;
  shaking.scale *= factor;
  run.response = solver(c.specimen, shaking, {.tolerance = 1e-12}, &run.history);
  return run;
}

double slip_difference(const Run& a, const Run& b) {
  return std::max(slip_difference(a.response.peak_slip_m, b.response.peak_slip_m),
                  slip_difference(a.response.residual_slip_m, b.response.residual_slip_m));
}

double rotation_difference(const Run& a, const Run& b) {
  return std::abs(a.response.peak_rotation_rad - b.response.peak_rotation_rad);
}

// What two runs differ in, in this order; null: nothing.
const char* difference(const Run& a, const Run& b) {
  if (a.response.outcome != b.response.outcome) return "outcome";
  if (!(slip_difference(a, b) <= tolerance && rotation_difference(a, b) <= tolerance)) return "demand";
  return same_modes(a.history, b.history) ? nullptr : "order of modes";
}

// In what a demand may differ by; of modes in another order at least 1.
double apart(const Run& a, const Run& b) {
  if (a.response.outcome != b.response.outcome) return std::numeric_limits<double>::infinity();
  const double demands = std::max(slip_difference(a, b), rotation_difference(a, b)) / tolerance;
  return same_modes(a.history, b.history) ? demands : std::max(demands, 1.0);
}

// Does 1e-10 of the shaking, or less, move the answer as far as that? How far is a matter of luck where it jumps.
bool sensitive(const RandomCase& c, const Run& fast, double as_far_as) {
  for (const double part : {1e-10, 1e-11, 1e-12})
    for (const double factor : {1 + part, 1 - part})
      if (apart(fast, run(respond, c, factor)) >= as_far_as) return true;
  return false;
}

void print(const char* what, std::uint64_t number, const RandomCase& c, const Run& fast, const Run& reference) {
  const Response &a = fast.response, &b = reference.response;
  std::printf(
      "  %s differs: sample %llu, %s/%s, slip %.9f/%.9f, residual %.9f/%.9f, rotation %.9f/%.9f, events %d/%d; %s\n",
      what, static_cast<unsigned long long>(number), name(a.outcome), name(b.outcome), a.peak_slip_m, b.peak_slip_m,
      a.residual_slip_m, b.residual_slip_m, a.peak_rotation_rad, b.peak_rotation_rad, a.events, b.events,
      c.text().c_str());
}

void compare(const CaseFamily& family, std::uint64_t number, Count& count) {
  const RandomCase c = random_case(family, number);
  const Run fast = run(respond, c), reference = run(respond_reference, c);
  ++count.samples;
  count.still += reference.response.outcome == Outcome::at_rest ? 1 : 0;
  count.overturned += reference.response.outcome == Outcome::overturned ? 1 : 0;
  count.impacts += reference.response.impacts;
  const char* what = difference(fast, reference);
  if (!what) {
    count.worst_slip_m = std::max(count.worst_slip_m, slip_difference(fast, reference));
    count.worst_rotation_rad = std::max(count.worst_rotation_rad, rotation_difference(fast, reference));
  } else if (sensitive(c, fast, apart(fast, reference))) {
    ++count.sensitive;
  } else {
    ++(*what == 'o' ? (what[1] == 'u' ? count.outcome : count.modes) : count.edp);
    print(what, number, c, fast, reference);
  }
}

Count compare_family(const char* label, const CaseFamily& family, int samples) {
  const bool longer = long_tests();
  Count count;
  for (int i = 0; i < samples * (longer ? 10 : 1); ++i) compare(family, static_cast<std::uint64_t>(i), count);
  std::printf(
      "%s: %d samples, %d still, %d overturned, %d impacts; differ in outcome %d, demand %d, order of modes %d, and %d "
      "sensitive ones; the others agree within %.1e m and %.1e rad\n",
      label, count.samples, count.still, count.overturned, count.impacts, count.outcome, count.edp, count.modes,
      count.sensitive, count.worst_slip_m, count.worst_rotation_rad);
  return count;
}

void expect_agreement(const Count& count) {
  EXPECT_LE(count.outcome + count.edp, 0.001 * count.samples + 1);
  EXPECT_LE(count.modes, 0.005 * count.samples);
  EXPECT_LE(count.sensitive, 0.01 * count.samples);
  EXPECT_LT(count.still, 0.5 * count.samples);
}

TEST(FastAgainstReference, AllKindsOfBlocks) { expect_agreement(compare_family("all kinds", {}, 600)); }

TEST(FastAgainstReference, SlenderBlocks) {
  CaseFamily family;
  family.seed = 2;
  family.alpha_high = 0.4;
  family.mu_low = 0.2;
  family.excess_low = 1;
  family.one_model = 0;
  expect_agreement(compare_family("slender", family, 300));
}

TEST(FastAgainstReference, StrongVerticalShaking) {
  CaseFamily family;
  family.seed = 3;
  family.vertical = 1;
  family.vertical_peak_g = 1.6;
  family.one_model = 0;
  family.duration_low_s = 3;
  family.duration_high_s = 5;
  expect_agreement(compare_family("strong vertical shaking", family, 300));
}

}  // namespace
}  // namespace freestand::test::fast_against_reference_test
