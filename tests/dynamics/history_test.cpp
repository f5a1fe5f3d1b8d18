// Histories agree with themselves and with the peaks: rates are derivatives, peaks are their largest values, events are
// in order, and impacts do what the law says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "support/floor_motions.hpp"
#include "support/random_cases.hpp"
#include "support/solvers.hpp"

namespace freestand::test {
namespace {

FREESTAND_ON_BOTH_SOLVERS(Histories);

CaseFamily history_family() {
  CaseFamily family;
  family.seed = 61;
  family.alpha_high = 0.6;
  family.mu_low = 0.2;
  family.one_model = 0;
  family.duration_low_s = 2;
  family.duration_high_s = 3;
  family.excess_low = 1.2;
  return family;
}

// Whether an event or a knot of the motion lies between two times.
bool quiet(const History& history, const FloorMotion& motion, double from, double to) {
  for (const Event& event : history.events)
    if (event.time_s >= from && event.time_s <= to) return false;
  const auto knot = std::lower_bound(motion.knot_s.begin(), motion.knot_s.end(), from);
  return knot == motion.knot_s.end() || *knot > to;
}

TEST_P(Histories, RatesAreTheDerivatives) {
  int compared = 0;
  const std::uint64_t samples = std::string(GetParam().name) == "fast" ? 15 : 2;  // the reference stops at every point
  for (std::uint64_t number = 0; number < samples; ++number) {
    const RandomCase c = random_case(history_family(), number);
    History history;
    const double h = history.step_s = 1e-4;
    GetParam()(c.specimen, c.shaking, {}, &history);
    for (std::size_t i = 1; i + 1 < history.points.size(); ++i) {
      const HistoryPoint &a = history.points[i - 1], &b = history.points[i], &d = history.points[i + 1];
      if (b.mode == Mode::rest || b.mode == Mode::overturned || d.mode == Mode::overturned) continue;
      if (!quiet(history, *c.motion, a.time_s, d.time_s)) continue;
      ASSERT_NEAR((d.slip_m - a.slip_m) / (2 * h), b.slip_velocity_mps, 1e-5) << c.text() << " at " << b.time_s;
      ASSERT_NEAR((d.rotation_rad - a.rotation_rad) / (2 * h), b.rotation_rate_radps, 1e-5);
      ++compared;
    }
  }
  EXPECT_GT(compared, 3000);
}

// A floor that is quiet for many segments, then shakes, one that is cubic between its knots, and one that shakes vertically too: while
// the block rests it moves as its floor does, point by point.
TEST_P(Histories, RestIsWrittenWhenAndAsTheFloorMoves) {
  std::vector<double> a, v;
  for (int i = 0; i < 900; ++i) {
    a.push_back((i < 600 ? 0.5 : 4) * std::sin(0.7 * i) + 0.01 * (i % 7));
    v.push_back(0.6 * std::sin(0.3 * i));
  }
  FloorMotion cubic = piecewise_linear("cubic", 0.005, a, {});
  cubic.degree = 3;
  cubic.horizontal_mps2.clear();
  for (std::size_t i = 0; i + 1 < a.size(); ++i)
    for (const double c : {a[i], 20 * v[i], -400 * a[i], 5000.0}) cubic.horizontal_mps2.push_back(c);
  index_runs(cubic);
  const FloorMotion line = piecewise_linear("line", 0.005, a, {}), both = piecewise_linear("both", 0.005, a, v);
  Specimen specimen;
  specimen.block = Block::rectangular(0.8, 0.6, 100);
  specimen.friction = {0.3, 0.3};
  for (const FloorMotion* motion : {&line, &both, static_cast<const FloorMotion*>(&cubic)}) {
    const Shaking shaking{.motion = motion, .vertical_scale = motion == &both ? 1.0 : 0.0};
    History history{.step_s = 0.0031337, .points = {}, .events = {}, .forces = true};
    GetParam()(specimen, shaking, {.free_vibration_s = 0}, &history);
    ASSERT_GT(history.points.size(), 1400U) << motion->name;
    int rested = 0;
    for (std::size_t i = 0; i < history.points.size(); ++i) {
      const HistoryPoint& p = history.points[i];
      EXPECT_DOUBLE_EQ(p.time_s, 0.0031337 * static_cast<double>(i)) << motion->name;
      EXPECT_NEAR(p.floor_acceleration_mps2, horizontal_acceleration(shaking, p.time_s), 1e-11) << p.time_s;
      if (p.mode != Mode::rest) continue;
      EXPECT_NEAR(p.acceleration_mps2, p.floor_acceleration_mps2, 1e-12) << p.time_s;
      EXPECT_NEAR(p.vertical_acceleration_mps2, vertical_acceleration(shaking, p.time_s), 1e-11) << p.time_s;
      ++rested;
    }
    EXPECT_GT(rested, 900) << motion->name;
  }
}

TEST_P(Histories, PeaksAreTheLargestValues) {
  int moved = 0;
  for (std::uint64_t number = 0; number < 30; ++number) {
    const RandomCase c = random_case(history_family(), number);
    History history;
    history.step_s = 1e-3;
    const Response r = GetParam()(c.specimen, c.shaking, {}, &history);
    double slip = 0, rotation = 0, rate = 0, speed = 0;
    for (const HistoryPoint& p : history.points) {
      slip = std::max(slip, std::abs(p.slip_m));
      rotation = std::max(rotation, std::abs(p.rotation_rad));
      speed = std::max(speed, std::abs(p.slip_velocity_mps));
      rate = std::max(rate, std::abs(p.rotation_rate_radps));
    }
    // Between two points the peak may stand out by what the largest rate covers in half a step.
    if (r.outcome != Outcome::overturned) {  // the fall is no slip, but stands in the history
      ASSERT_GE(r.peak_slip_m, slip * (1 - 1e-12));
      // The last point lies less than an output step before the end.
      ASSERT_NEAR(r.residual_slip_m, history.points.back().slip_m, 2 * speed * history.step_s + 1e-9);
    }
    ASSERT_LE(r.peak_slip_m, slip + 2 * speed * history.step_s + 1e-9);
    ASSERT_GE(r.peak_rotation_rad, rotation * (1 - 1e-12));
    ASSERT_LE(r.peak_rotation_rad, rotation + 2 * rate * history.step_s + 1e-9);
    ASSERT_GE(r.slid_path_m, 0);
    moved += r.outcome == Outcome::moved ? 1 : 0;
  }
  EXPECT_GT(moved, 12);
}

TEST_P(Histories, EventsAreInOrderAndChain) {
  int events = 0;
  for (std::uint64_t number = 0; number < 30; ++number) {
    const RandomCase c = random_case(history_family(), number);
    History history;
    history.step_s = 0;
    const Response r = GetParam()(c.specimen, c.shaking, {}, &history);
    ASSERT_TRUE(history.points.empty());
    Mode mode = Mode::rest;
    double time = 0;
    int impacts = 0;
    for (const Event& event : history.events) {
      ASSERT_EQ(event.from, mode);
      ASSERT_GE(event.time_s, time);
      const bool one_corner = event.to == Mode::rock || event.to == Mode::slide_rock;
      if (event.to != Mode::overturned) {
        ASSERT_EQ(event.pivot != 0, one_corner);
      }
      mode = event.to;
      time = event.time_s;
      impacts += event.impact ? 1 : 0;
      ++events;
    }
    ASSERT_GE(impacts, r.impacts);  // hops too small to tell are in the history only
    ASSERT_EQ(static_cast<int>(history.events.size()), r.events);
    ASSERT_LE(time, r.end_time_s);
    if (r.outcome == Outcome::moved) {
      ASSERT_EQ(mode, Mode::rest) << c.text();
    }
  }
  EXPECT_GT(events, 200);
}

// [KM05 6.17, 6.32] A slipping impact of law `housner` turns the rate by e and leaves the slip speed.
TEST(Impacts, HousnersLawLeavesTheSlipSpeed) {
  int impacts = 0;
  for (std::uint64_t number = 0; number < 40; ++number) {
    CaseFamily family = history_family();
    family.alpha_low = 0.2;
    family.alpha_high = 0.4;
    family.mu_high = 0.5;
    family.asymmetric = 0;
    family.coulomb = 0;
    const RandomCase c = random_case(family, number);
    const double alpha = c.specimen.block.alpha_rad();
    const double e = c.specimen.impact.factor * (1 - 1.5 * std::pow(std::sin(alpha), 2));
    History history;
    const double h = history.step_s = 1e-4;
    respond(c.specimen, c.shaking, {}, &history);
    for (const Event& event : history.events) {
      if (!event.impact || event.from != Mode::slide_rock || event.to != Mode::slide_rock) continue;
      const auto i = static_cast<std::size_t>(event.time_s / h);
      if (i < 3 || i + 4 >= history.points.size()) continue;
      int near = 0;  // no other event among the points used
      for (const Event& other : history.events) near += std::abs(other.time_s - event.time_s) < 4 * h ? 1 : 0;
      if (near > 1) continue;
      // Straight lines through two points on each side, taken to the impact.
      const auto at_impact = [&](std::size_t first, auto value) {
        const HistoryPoint &a = history.points[first], &b = history.points[first + 1];
        return value(a) + (value(b) - value(a)) * (event.time_s - a.time_s) / h;
      };
      const auto rate = [](const HistoryPoint& p) { return p.rotation_rate_radps; };
      const auto speed = [](const HistoryPoint& p) { return p.slip_velocity_mps; };
      const double before = at_impact(i - 1, rate), after = at_impact(i + 1, rate);
      if (std::abs(before) < 0.02) continue;
      EXPECT_NEAR(after, e * before, 2e-4) << c.text() << " at " << event.time_s;
      EXPECT_NEAR(at_impact(i + 1, speed), at_impact(i - 1, speed), 2e-4) << c.text() << " at " << event.time_s;
      ++impacts;
    }
  }
  EXPECT_GE(impacts, 3);
}

}  // namespace
}  // namespace freestand::test
