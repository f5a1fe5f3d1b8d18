// Sliding in the plane of the floor: closed forms, lines, turns, energy, convergence.
#include "dynamics/plane_slide.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <freestand/error.hpp>
#include <freestand/simulate.hpp>

#include "base/units.hpp"
#include "dynamics/plane_slip.hpp"
#include "support/floor_motions.hpp"
#include "support/plane_motions.hpp"

namespace freestand::test::plane_slide_test {
namespace {

constexpr double g = standard_gravity_mps2;

Specimen sliding_block(double mu_s, double mu_k) {
  Specimen specimen;
  specimen.block = Block::rectangular(0.6, 1.2, 100);
  specimen.friction = {mu_s, mu_k};
  specimen.model = Model::slide;
  return specimen;
}

Shaking shaking_of(const FloorMotion& motion, double vertical_scale = 0) {
  return {.motion = &motion, .scale = 1, .stretch = 1, .vertical_scale = vertical_scale};
}

// What of a sample is compared to the bit.
std::vector<double> numbers(const Response& r) {
  return {r.peak_slip_m,
          r.residual_slip_m,
          r.residual_cross_slip_m,
          r.slid_path_m,
          r.peak_acceleration_mps2,
          r.end_time_s,
          static_cast<double>(r.outcome),
          static_cast<double>(r.events),
          static_cast<double>(r.impacts)};
}

// A slip across a constant drive: at first w = (v0, 0), the floor accelerates by A along y. With chi the angle between w and -a,
// p = tan(chi/2), k = F/A:  v' = -F + A cos(chi), v chi' = -A sin(chi), so that
//   v = (K/2) p^(k-1) (1 + p^2),  t = (K/(2 A)) ([p^(k-1)/(k-1)] + [p^(k+1)/(k+1)]) between p and p0 = 1,  K = v0,
//   along -a: (K^2/(4 A)) [p^(2k-2)/(2k-2) - p^(2k+2)/(2k+2)],  across it: (K^2/(2 A)) [p^(2k-1)/(2k-1) + p^(2k+1)/(2k+1)].
struct AcrossDrive {
  double A, k, K;

  static double between(double p, double power) { return (1 - std::pow(p, power)) / power; }
  double time(double p) const { return K / (2 * A) * (between(p, k - 1) + between(p, k + 1)); }
  double speed(double p) const { return 0.5 * K * std::pow(p, k - 1) * (1 + p * p); }
  double along(double p) const { return K * K / (4 * A) * (between(p, 2 * k - 2) - between(p, 2 * k + 2)); }
  double across(double p) const { return K * K / (2 * A) * (between(p, 2 * k - 1) + between(p, 2 * k + 1)); }
  // By bisection: time falls with p.
  double p_at(double t) const {
    double low = 0, high = 1;
    for (int i = 0; i < 200; ++i) (time(0.5 * (low + high)) > t ? low : high) = 0.5 * (low + high);
    return 0.5 * (low + high);
  }
};

TEST(PlaneSlide, ADriveThatTurnsByARightAngle) {
  for (const double mu : {0.1, 0.3})
    for (const double turned_over_grip : {0.3, 0.9, 1.3, 4.0}) {
      const double F = mu * g, first = 2 * F, T1 = 0.2, T2 = 0.15, A = turned_over_grip * F;
      const FloorMotion motion = in_plane(staircase({T1, T2}, {first, 0}), staircase({T1, T2}, {0, A}));
      const double v1 = (first - F) * T1, u1 = 0.5 * v1 * T1;
      const AcrossDrive drive{A, F / A, v1};
      // Slower than it may, A < F, it stops within T2 or not; p = 0 is the stop.
      const double stop = F > A ? v1 * F / (F * F - A * A) : 1e9, p = T2 < stop ? drive.p_at(T2) : 0;
      const double v2 = p > 0 ? drive.speed(p) : 0, chi = 2 * std::atan(p), on = v2 * v2 / (2 * F);
      // Along -x it went first; -a points along -y.
      const double x = -(u1 + drive.across(p) + on * std::sin(chi)), y = -(drive.along(p) + on * std::cos(chi));
      const Response r = respond(sliding_block(mu, mu), shaking_of(motion), {.tolerance = 1e-12});
      ASSERT_EQ(r.outcome, Outcome::moved);
      EXPECT_NEAR(r.residual_slip_m, x, 1e-11) << mu << ' ' << turned_over_grip;
      EXPECT_NEAR(r.residual_cross_slip_m, y, 1e-11) << mu << ' ' << turned_over_grip;
      EXPECT_NEAR(r.end_time_s, T1 + (T2 < stop ? T2 + v2 / F : T2), 1e-10);
    }
}

// A slip that ends while the floor holds still: its end, T = (F v - a.w)/(F^2 - A^2), and what it covers.
TEST(PlaneSlide, TheEndOfASlipInClosedForm) {
  const double F = 3, A = 2, v0 = 0.7;
  const AcrossDrive drive{A, F / A, v0};
  const dynamics::SlipEnd end = dynamics::slip_end({0, A}, F, {v0, 0});
  EXPECT_NEAR(end.after_s, drive.time(0), 1e-14);
  EXPECT_NEAR(end.covers_m.x, drive.across(0), 1e-14);
  EXPECT_NEAR(end.covers_m.y, -drive.along(0), 1e-14);
  // On a floor at rest a straight line.
  const dynamics::SlipEnd straight = dynamics::slip_end({0, 0}, F, {0.3, -0.4});
  EXPECT_NEAR(straight.after_s, 0.5 / F, 1e-15);
  EXPECT_NEAR(straight.path_m, 0.125 / F, 1e-15);
  EXPECT_NEAR(straight.covers_m.x, 0.6 * 0.125 / F, 1e-15);
  EXPECT_NEAR(straight.covers_m.y, -0.8 * 0.125 / F, 1e-15);
}

// a = A (cos(wt), sin(wt)), by chords, so many a turn.
FloorMotion circular(double A, double omega, int turns, int chords) {
  std::vector<double> x, y;
  for (int i = 0; i <= turns * chords; ++i) {
    const double phase = 2 * pi * (i % chords) / chords;
    x.push_back(A * std::cos(phase));
    y.push_back(A * std::sin(phase));
  }
  FloorMotion motion = piecewise_linear("circular", 2 * pi / omega / chords, x);
  add_cross(motion, 2 * pi / omega / chords, y);
  return motion;
}

// In the steady state w turns with the floor, at a speed V: w' stands across friction, A^2 = F^2 + (omega V)^2. The slip goes
// round in a circle of radius V/omega. Chords turn by the same angle each, so that all knots are alike; what they miss of the circle goes
// with the square of their length, and is left out by extrapolation.
TEST(PlaneSlide, CircularShaking) {
  for (const double ratio : {1.02, 1.2, 3.0}) {
    const double mu = 0.2, F = mu * g, A = ratio * F, omega = 6;
    const int turns = 30;
    double speed[2], diameter[2];
    for (const int finer : {0, 1}) {
      const FloorMotion motion = circular(A, omega, turns, finer ? 2048 : 1024);
      History history;
      history.step_s = 2 * pi / omega / 64;
      const Response r = respond(sliding_block(mu, mu), shaking_of(motion), {.tolerance = 1e-12}, &history);
      ASSERT_EQ(r.outcome, Outcome::moved);
      const auto late = static_cast<std::size_t>(64 * (turns - 3));
      for (std::size_t i = late; i < late + 64; ++i) {
        const HistoryPoint &now = history.points[i], &opposite = history.points[i + 32];
        const double v = std::hypot(now.slip_velocity_mps, now.cross_slip_velocity_mps);
        const double across = std::hypot(now.slip_m - opposite.slip_m, now.cross_slip_m - opposite.cross_slip_m);
        if (i == late) speed[finer] = v, diameter[finer] = across;
        EXPECT_NEAR(v, speed[finer], 1e-8 * v);
        EXPECT_NEAR(across, diameter[finer], 1e-8 * across);
      }
    }
    const double V = std::sqrt(A * A - F * F) / omega;
    EXPECT_NEAR((4 * speed[1] - speed[0]) / 3, V, 1e-8 * V);
    EXPECT_NEAR((4 * diameter[1] - diameter[0]) / 3, 2 * V / omega, 2e-8 * V / omega);
  }
}

TEST(PlaneSlide, StandsStillAsLongAsTheVectorIsSmall) {
  const double mu = 0.25, F = mu * g;
  const FloorMotion below = in_plane(staircase({1}, {0.8 * F * 0.999}), staircase({1}, {0.6 * F}));
  const FloorMotion above = in_plane(staircase({1}, {0.8 * F * 1.001}), staircase({1}, {0.6 * F}));
  EXPECT_EQ(respond(sliding_block(mu, mu), shaking_of(below)).outcome, Outcome::at_rest);
  EXPECT_EQ(respond(sliding_block(mu, mu), shaking_of(above)).outcome, Outcome::moved);
  // Either component alone would not move it.
  EXPECT_EQ(respond(sliding_block(mu, mu), {.motion = &below, .scale = -0.999}).outcome, Outcome::at_rest);
}

TEST(PlaneSlide, OneLineHasTheBitsOfOneDirection) {
  for (std::uint64_t i = 0; i < 40; ++i) {
    const PlaneCase c = plane_case(i);
    const FloorMotion alone = piecewise_linear("line", c.dt_s, c.x, c.up);
    FloorMotion zero = alone, slant = alone;
    add_cross(zero, c.dt_s, std::vector<double>(c.x.size(), 0.0));
    std::vector<double> across = c.x;
    for (double& value : across) value *= -0.75;
    add_cross(slant, c.dt_s, across);
    History one, two;
    const Response expected = respond(c.specimen, shaking_of(alone, c.vertical_scale()), {}, &one);
    EXPECT_EQ(numbers(respond(c.specimen, shaking_of(zero, c.vertical_scale()), {}, &two)), numbers(expected));
    ASSERT_EQ(one.points.size(), two.points.size());
    for (std::size_t k = 0; k < one.points.size(); ++k) {
      EXPECT_EQ(one.points[k].slip_m, two.points[k].slip_m);
      EXPECT_EQ(two.points[k].cross_slip_m, 0);
    }
    // In a batch, beside one that moves in the plane.
    const FloorMotion plane = c.motion();
    const std::vector<Specimen> specimens(3, c.specimen);
    const std::vector<Shaking> with = {shaking_of(zero, c.vertical_scale()), shaking_of(plane, c.vertical_scale()),
                                       shaking_of(zero, c.vertical_scale())};
    const std::vector<Shaking> without(3, shaking_of(alone, c.vertical_scale()));
    std::vector<Response> responses(3), lines(3);
    respond_batch(specimens, with, {}, responses);
    respond_batch(specimens, without, {}, lines);
    EXPECT_EQ(numbers(responses[0]), numbers(lines[0]));
    EXPECT_EQ(numbers(responses[2]), numbers(lines[2]));
    EXPECT_EQ(numbers(responses[1]), numbers(respond(c.specimen, with[1])));
    // Along another line the motion is 1.25 times as strong: to round-off.
    Shaking stronger = shaking_of(alone, c.vertical_scale());
    stronger.scale = 1.25;
    const Response by_line = respond(c.specimen, stronger);
    const Response slanting = respond(c.specimen, shaking_of(slant, c.vertical_scale()));
    EXPECT_NEAR(slanting.peak_slip_m, by_line.peak_slip_m, 1e-9 * by_line.peak_slip_m);
    EXPECT_NEAR(slanting.residual_slip_m, 0.8 * by_line.residual_slip_m, 1e-9 * by_line.peak_slip_m);
    EXPECT_NEAR(slanting.residual_cross_slip_m, -0.6 * by_line.residual_slip_m, 1e-9 * by_line.peak_slip_m);
  }
}

// The text for the plane itself, on a line to which it is not told to reduce: the first channel is a hair, or nothing at all.
TEST(PlaneSlide, GoesAlongALineByItself) {
  for (std::uint64_t i = 0; i < 40; ++i) {
    const PlaneCase c = plane_case(i);
    const FloorMotion line = piecewise_linear("line", c.dt_s, c.x, c.up);
    FloorMotion across = piecewise_linear("across", c.dt_s, std::vector<double>(c.x.size(), 0.0), c.up);
    add_cross(across, c.dt_s, c.x);
    ASSERT_TRUE(std::isnan(across.cross_over_horizontal));
    const Response expected = respond(c.specimen, shaking_of(line, c.vertical_scale()));
    const Response r = respond(c.specimen, shaking_of(across, c.vertical_scale()), {.tolerance = 1e-11});
    EXPECT_NEAR(r.peak_slip_m, expected.peak_slip_m, 1e-9 * expected.peak_slip_m + 1e-11) << i << c.text();
    EXPECT_NEAR(r.residual_cross_slip_m, expected.residual_slip_m, 1e-9 * expected.peak_slip_m + 1e-11) << i;
    EXPECT_NEAR(r.slid_path_m, expected.slid_path_m, 1e-9 * expected.slid_path_m + 1e-11) << i;
    EXPECT_NEAR(r.peak_acceleration_mps2, expected.peak_acceleration_mps2, 1e-9 * g) << i;
    EXPECT_EQ(r.residual_slip_m, 0);
    EXPECT_EQ(r.impacts, expected.impacts) << i;
    if (c.specimen.friction.mu_s > c.specimen.friction.mu_k) continue;  // there a hair decides whether it sticks
    FloorMotion hair = line;
    std::vector<double> little = c.y;
    for (double& value : little) value *= 1e-9;
    add_cross(hair, c.dt_s, little);
    const Response beside = respond(c.specimen, shaking_of(hair, c.vertical_scale()), {.tolerance = 1e-11});
    EXPECT_NEAR(beside.peak_slip_m, expected.peak_slip_m, 1e-6 * expected.peak_slip_m + 1e-9) << i << c.text();
  }
}

TEST(PlaneSlide, ATurnedMotionTurnsTheAnswer) {
  for (std::uint64_t i = 0; i < 60; ++i) {
    const PlaneCase c = plane_case(i);
    const FloorMotion motion = c.motion(), other = turned(motion, 0.1 + 0.37 * static_cast<double>(i));
    const double angle = 0.1 + 0.37 * static_cast<double>(i), cosine = std::cos(angle), sine = std::sin(angle);
    const Settings settings{.tolerance = 1e-12};
    const Response a = respond(c.specimen, shaking_of(motion, c.vertical_scale()), settings);
    const Response b = respond(c.specimen, shaking_of(other, c.vertical_scale()), settings);
    ASSERT_EQ(a.outcome, b.outcome);
    const double small = 1e-9 * a.peak_slip_m;
    EXPECT_NEAR(a.peak_slip_m, b.peak_slip_m, small) << i << c.text();
    EXPECT_NEAR(b.residual_slip_m, cosine * a.residual_slip_m - sine * a.residual_cross_slip_m, small) << i;
    EXPECT_NEAR(b.residual_cross_slip_m, sine * a.residual_slip_m + cosine * a.residual_cross_slip_m, small) << i;
    EXPECT_NEAR(a.slid_path_m, b.slid_path_m, 1e-9 * a.slid_path_m) << i;
    // Scaled by -1 it is the same, turned by 180 degrees, to the bit.
    Shaking back = shaking_of(motion, c.vertical_scale());
    back.scale = -1;
    const Response mirrored = respond(c.specimen, back, settings);
    EXPECT_EQ(mirrored.peak_slip_m, a.peak_slip_m);
    EXPECT_EQ(mirrored.residual_cross_slip_m, -a.residual_cross_slip_m);
  }
}

TEST(PlaneSlide, ConvergesWithTheTolerance) {
  const double tolerances[] = {1e-5, 1e-7, 1e-9, 1e-11};
  double worst[4] = {};
  for (std::uint64_t i = 0; i < 60; ++i) {
    const PlaneCase c = plane_case(i);
    const FloorMotion motion = c.motion();
    const Response fine = respond(c.specimen, shaking_of(motion, c.vertical_scale()), {.tolerance = 1e-13});
    for (int k = 0; k < 4; ++k) {
      const Response r = respond(c.specimen, shaking_of(motion, c.vertical_scale()), {.tolerance = tolerances[k]});
      worst[k] = std::fmax(worst[k], std::abs(r.peak_slip_m - fine.peak_slip_m));
    }
  }
  // Some hundreds of steps, each of which misses about its tolerance in speeds of a m/s over tenths of a second.
  for (int k = 0; k < 4; ++k) EXPECT_LT(worst[k], 300 * tolerances[k]) << tolerances[k];
  for (int k = 1; k < 4; ++k) EXPECT_LT(worst[k], 0.1 * worst[k - 1]) << tolerances[k];
}

// What the floor gives, friction takes: from rest to rest, -integral of a.w = mu g S.
TEST(PlaneSlide, FrictionTakesWhatTheFloorGives) {
  for (std::uint64_t i = 0; i < 20; ++i) {
    const PlaneCase c = plane_case(i);
    if (!c.up.empty()) continue;
    const FloorMotion motion = c.motion();
    History history;
    history.step_s = c.dt_s / 20;
    const Response r = respond(c.specimen, shaking_of(motion), {}, &history);
    double given = 0;
    double before = 0;
    for (const HistoryPoint& p : history.points) {
      const double power = -p.floor_acceleration_mps2 * p.slip_velocity_mps -
                           p.floor_cross_acceleration_mps2 * p.cross_slip_velocity_mps;
      given += 0.5 * (before + power) * history.step_s;
      before = power;
    }
    // The trapezoidal rule on functions with kinks, h = 0.5 ms at most: h^2/12 of the slope's change, some m^2/s^4 an event.
    const double taken = c.specimen.friction.mu_k * g * r.slid_path_m;
    EXPECT_NEAR(given, taken, 1e-5 * taken + 1e-6) << i;
  }
}

// A floor that starts with more than friction holds: the block never has its acceleration, but that of friction.
TEST(PlaneSlide, SlipsFromTheFirstInstant) {
  const double mu = 0.2;
  const FloorMotion motion = in_plane(staircase({0.1, 0.2}, {8.0, -8.0}), staircase({0.1, 0.2}, {0.0, 1.0}));
  EXPECT_NEAR(respond(sliding_block(mu, mu), shaking_of(motion), {}).peak_acceleration_mps2, mu * g, 1e-12);
  EXPECT_EQ(respond(sliding_block(0, 0), shaking_of(motion), {}).peak_acceleration_mps2, 0);
}

// Thrown up at an instant, it flies on along a straight line, and lands with friction's share of its fall.
TEST(PlaneSlide, FliesAndLands) {
  const double mu = 0.3, F = mu * g, T1 = 0.3, T2 = 0.1, up = -1.5 * g;
  FloorMotion motion = in_plane(staircase({T1, T2, 1}, {0, 0, 0}, {0, up, 0}), staircase({T1, T2, 1}, {2 * F, 0, 0}));
  const double v = F * T1, u = 0.5 * v * T1;
  // y'' = 0.5 g for T2, then -g: back at 0 after T2 + tau, vy = 0.5 g T2 - g tau.
  const double rise = 0.5 * g * T2, height = 0.5 * rise * T2,
               tau = (rise + std::sqrt(rise * rise + 2 * g * height)) / g;
  const double fall = g * tau - rise, after = std::fmax(v - mu * fall, 0.0);
  const Response r = respond(sliding_block(mu, mu), shaking_of(motion, 1), {.tolerance = 1e-12});
  EXPECT_NEAR(r.residual_cross_slip_m, -(u + v * (T2 + tau) + after * after / (2 * F)), 1e-11);
  EXPECT_EQ(r.impacts, 1);
  EXPECT_NEAR(r.slid_path_m, u + after * after / (2 * F), 1e-11);  // not in the air
}

TEST(PlaneSlide, WhatItDoesNotKnowIsRefused) {
  const PlaneCase c = plane_case(2);
  const FloorMotion motion = c.motion();
  for (const Model model : {Model::rock, Model::slide_rock, Model::bouc_wen}) {
    Specimen other = c.specimen;
    other.model = model;
    EXPECT_NE(dynamics::refusal_in_plane(other), "");
    EXPECT_EQ(respond(other, shaking_of(motion)).outcome, Outcome::not_finite);
  }
  EXPECT_EQ(dynamics::refusal_in_plane(c.specimen), "");
  EXPECT_EQ(respond_reference(c.specimen, shaking_of(motion)).outcome, Outcome::not_finite);
  Specimen negative = c.specimen;
  negative.friction.mu_k = -0.1;
  EXPECT_EQ(respond(negative, shaking_of(motion)).outcome, Outcome::not_finite);
  FloorMotion shorter = piecewise_linear("short", c.dt_s, c.x);
  EXPECT_THROW(add_cross(shorter, c.dt_s, {1, 2, 3}), Error);
}

// No grip at all, and a floor that starts from nothing: the block stays where it was while the floor moves away.
TEST(PlaneSlide, WithoutFrictionItStaysBehind) {
  const PlaneCase c = plane_case(2);
  const FloorMotion motion = c.motion();
  History history;
  history.step_s = c.dt_s;
  respond(sliding_block(0, 0), shaking_of(motion), {.free_vibration_s = 0}, &history);
  double vx = 0, vy = 0, x = 0, y = 0;
  for (std::size_t i = 0; i + 1 < c.x.size(); ++i) {
    const double h = c.dt_s;
    x += h * vx + h * h * (2 * c.x[i] + c.x[i + 1]) / 6;
    y += h * vy + h * h * (2 * c.y[i] + c.y[i + 1]) / 6;
    vx += 0.5 * h * (c.x[i] + c.x[i + 1]);
    vy += 0.5 * h * (c.y[i] + c.y[i + 1]);
    if (i + 1 >= history.points.size()) break;
    ASSERT_NEAR(history.points[i + 1].slip_m, -x, 1e-7);
    ASSERT_NEAR(history.points[i + 1].cross_slip_m, -y, 1e-7);
  }
}

}  // namespace
}  // namespace freestand::test::plane_slide_test
