// Sliding in the plane under friction that differs between two directions: closed forms, turns, and the circle as its limit.
#include <gtest/gtest.h>

#include <cmath>
#include <freestand/simulate.hpp>

#include "base/units.hpp"
#include "dynamics/plane_slip.hpp"
#include "support/floor_motions.hpp"
#include "support/plane_motions.hpp"

namespace freestand::test::plane_ellipse_test {
namespace {

constexpr double g = standard_gravity_mps2;

Specimen block_on(double mu, double ratio, double axis_rad) {
  Specimen specimen;
  specimen.block = Block::rectangular(0.6, 1.2, 100);
  specimen.friction = {mu, mu, ratio, axis_rad};
  specimen.model = Model::slide;
  return specimen;
}

// Constant acceleration (x, y) for a time.
FloorMotion push(double x, double y, double duration_s) {
  return in_plane(rectangular_pulse(x, duration_s), rectangular_pulse(y, duration_s));
}

Response answer(const Specimen& specimen, const FloorMotion& motion, double vertical_scale = 0) {
  return respond(specimen, {&motion, 1, 1, vertical_scale}, {.tolerance = 1e-12});
}

TEST(PlaneEllipse, SlipBeginsWhereThePullLeavesTheEllipse) {
  const double mu = 0.2, ratio = 0.6;
  for (const double angle : {0.0, 0.4, 1.2, pi / 2})
    for (const double axis : {0.0, 0.7})
      for (const double part : {0.999, 1.001}) {
        const double along = std::cos(angle - axis), across = std::sin(angle - axis) / ratio;
        const double a = part * mu * g / std::hypot(along, across);
        const Response r = answer(block_on(mu, ratio, axis), push(a * std::cos(angle), a * std::sin(angle), 0.3));
        EXPECT_EQ(r.outcome, part > 1 ? Outcome::moved : Outcome::at_rest) << angle << ' ' << axis;
      }
}

// From rest under a constant push the slip grows along one direction, e_i = -A_i/(rate + F m_i) of length 1; then the floor stands still and
// q_x, q_y fall as exp(-F s), exp(-m F s), so that the slip turns towards where friction is less, and covers the integral of w |q| ds.
TEST(PlaneEllipse, APushAndTheEndOfItsSlip) {
  const double mu = 0.25, T = 0.3, F = mu * g;
  for (const double ratio : {0.5, 0.8, 1.7})
    for (const double angle : {0.3, 1.1}) {
      const double a = 2.5 * F, m = ratio * ratio, Ax = a * std::cos(angle), Ay = ratio * a * std::sin(angle);
      double low = -F * std::min(1.0, m), high = std::hypot(Ax, Ay);
      for (int half = 0; half < 200; ++half) {
        const double rate = 0.5 * (low + high);
        (std::hypot(Ax / (rate + F), Ay / (rate + m * F)) > 1 ? low : high) = rate;
      }
      const double rate = high, ex = -Ax / (rate + F), ey = -Ay / (rate + m * F), qx = rate * T * ex,
                   qy = rate * T * ey;
      double x = 0.5 * qx * T, y = 0.5 * qy / ratio * T;
      const double h = 1e-3 / F, longest = 40 / (F * std::min(1.0, m));
      for (double s = 0; s < longest; s += h) {  // Simpson's rule
        const auto speed = [&](double at, double& wx, double& wy) {
          wx = qx * std::exp(-F * at), wy = qy * std::exp(-m * F * at);
          const double v = std::hypot(wx, wy);
          wx *= v, wy *= v / ratio;
        };
        double x0, y0, x1, y1, x2, y2;
        speed(s, x0, y0), speed(s + 0.5 * h, x1, y1), speed(s + h, x2, y2);
        x += h / 6 * (x0 + 4 * x1 + x2), y += h / 6 * (y0 + 4 * y1 + y2);
      }
      const Response r = answer(block_on(mu, ratio, 0), push(a * std::cos(angle), a * std::sin(angle), T));
      EXPECT_NEAR(r.residual_slip_m, x, 1e-10) << ratio << ' ' << angle;
      EXPECT_NEAR(r.residual_cross_slip_m, y, 1e-10) << ratio << ' ' << angle;
      // It feels the most friction at its start or at its end, (e_x, r e_y) mu g.
      const double starts = mu * g * std::hypot(ex, ratio * ey), ends = mu * g * std::min(1.0, ratio);
      EXPECT_NEAR(r.peak_acceleration_mps2, std::max(starts, ends), 1e-6 * F);
    }
}

// Along an axis of the ellipse it is the motion along a line, with that axis' friction.
TEST(PlaneEllipse, AlongAnAxisItIsTheLine) {
  for (const std::uint64_t number : {1, 2, 5, 8})
    for (const auto& [axis, mu] : {std::pair{0.0, 0.1}, std::pair{pi / 2, 0.1 * 0.6}}) {
      PlaneCase c = plane_case(number);
      for (double& y : c.y) y = 0;
      c.up.clear();
      const FloorMotion line = c.motion(), single = piecewise_linear("along", c.dt_s, c.x, {});
      const Response along = answer(block_on(mu, 1, 0), single), r = answer(block_on(0.1, 0.6, axis), line);
      EXPECT_EQ(along.outcome, Outcome::moved);
      EXPECT_NEAR(r.residual_slip_m, along.residual_slip_m, 1e-9);
      EXPECT_NEAR(r.peak_slip_m, along.peak_slip_m, 1e-9);
      EXPECT_NEAR(r.slid_path_m, along.slid_path_m, 1e-9);
      EXPECT_NEAR(r.peak_acceleration_mps2, along.peak_acceleration_mps2, 1e-9);
      EXPECT_NEAR(r.residual_cross_slip_m, 0, 1e-9);
    }
}

TEST(PlaneEllipse, TurnedItsAnswerTurns) {
  for (std::uint64_t i = 0; i < 20; ++i) {
    PlaneCase c = plane_case(i);
    c.specimen.friction.ratio_across = 0.5 + 0.07 * static_cast<double>(i);
    c.specimen.friction.axis_rad = 0.3;
    const FloorMotion motion = c.motion();
    const Response r = answer(c.specimen, motion, c.vertical_scale());
    // A step may miss 1e-12 of the block's speed, 2 m/s; some hundreds of them, over five seconds.
    const double allowed = 3e-9;
    for (const double angle : {pi / 2, 1.1}) {
      Specimen turned_block = c.specimen;
      turned_block.friction.axis_rad += angle;
      const Response t = answer(turned_block, turned(motion, angle), c.vertical_scale());
      const double C = std::cos(angle), S = std::sin(angle);
      EXPECT_EQ(t.outcome, r.outcome);
      EXPECT_NEAR(t.peak_slip_m, r.peak_slip_m, allowed) << i;
      EXPECT_NEAR(t.slid_path_m, r.slid_path_m, allowed) << i;
      EXPECT_NEAR(t.residual_slip_m, C * r.residual_slip_m - S * r.residual_cross_slip_m, allowed) << i;
      EXPECT_NEAR(t.residual_cross_slip_m, S * r.residual_slip_m + C * r.residual_cross_slip_m, allowed) << i;
      EXPECT_NEAR(t.peak_acceleration_mps2, r.peak_acceleration_mps2, 1e-6) << i;
    }
    // The same ellipse, described from its other axis.
    Specimen other = c.specimen;
    Friction& f = other.friction;
    f = {f.mu_s * f.ratio_across, f.mu_k * f.ratio_across, 1 / f.ratio_across, f.axis_rad + pi / 2};
    const Response o = answer(other, motion, c.vertical_scale());
    EXPECT_NEAR(o.peak_slip_m, r.peak_slip_m, allowed) << i;
  }
}

// Equal axes have the bits of isotropic friction however they are turned; axes that differ by 1e-10 its answer, by other equations.
TEST(PlaneEllipse, ItsLimitIsTheCircle) {
  int moved = 0;
  for (std::uint64_t i = 0; i < 40; ++i) {
    PlaneCase c = plane_case(i);
    const FloorMotion motion = c.motion();
    const Response circle = answer(c.specimen, motion, c.vertical_scale());
    c.specimen.friction.axis_rad = 0.8;
    const Response same = answer(c.specimen, motion, c.vertical_scale());
    EXPECT_EQ(same.peak_slip_m, circle.peak_slip_m);
    EXPECT_EQ(same.residual_cross_slip_m, circle.residual_cross_slip_m);
    c.specimen.friction.ratio_across = 1 + 1e-10;
    const Response nearly = answer(c.specimen, motion, c.vertical_scale());
    const double allowed = 1e-7 * std::max(circle.slid_path_m, 0.01);
    EXPECT_EQ(nearly.outcome, circle.outcome);
    EXPECT_NEAR(nearly.peak_slip_m, circle.peak_slip_m, allowed) << i;
    EXPECT_NEAR(nearly.residual_slip_m, circle.residual_slip_m, allowed) << i;
    EXPECT_NEAR(nearly.residual_cross_slip_m, circle.residual_cross_slip_m, allowed) << i;
    EXPECT_NEAR(nearly.slid_path_m, circle.slid_path_m, allowed) << i;
    EXPECT_NEAR(nearly.peak_acceleration_mps2, circle.peak_acceleration_mps2, 1e-6) << i;
    moved += circle.outcome == Outcome::moved;
  }
  EXPECT_GT(moved, 20);
}

// A blow of the floor takes what friction can, and no more energy than the slip has.
TEST(PlaneEllipse, AnImpulseIsOfTheEllipse) {
  const dynamics::EllipticGrip grip{0.3, 0.6};
  const dynamics::PlaneVector w{0.5, -0.8};
  const double push = 1.2;
  const dynamics::PlaneVector left = dynamics::slip_after_push(grip, w, push);
  const double px = (w.x - left.x) / (0.3 * push), py = (w.y - left.y) / (0.3 * 0.6 * push);
  EXPECT_NEAR(px * px + py * py, 1, 1e-12);
  // Along the normal of the ellipse there.
  EXPECT_NEAR(px / 0.3 * left.y - py / (0.3 * 0.6) * left.x, 0, 1e-12);
  EXPECT_EQ(size(dynamics::slip_after_push(grip, w, 20)), 0);
}

TEST(PlaneEllipse, OnALineThereIsNone) {
  const FloorMotion sine = one_sine();
  EXPECT_EQ(respond(block_on(0.3, 0.6, 0), {&sine, 6, 0.8}).outcome, Outcome::not_finite);
  EXPECT_EQ(respond(block_on(0.3, 1, 0), {&sine, 6, 0.8}).outcome, Outcome::moved);
}

}  // namespace
}  // namespace freestand::test::plane_ellipse_test
