// The block as the peers compute it: the same modes, inequalities and impacts as the program (uniform block, no vertical
// shaking, Housner's impacts), written anew as straight-line scalar code, the way one writes it for a fast loop by hand.
//
// Of the effects it knows those of job P5: static_friction and impact_loss change its numbers, rate_weakening makes both
// coefficients of friction mu(w) = mu (1 - d (1 - exp(-|w|/c))).
//
// A mode change is decided from the values at the instant alone: who was violated says what cannot follow.
#pragma once

#include <cmath>
#include <freestand/response.hpp>
#include <freestand/simulate.hpp>
#include <freestand/specimen.hpp>

#include "base/units.hpp"
#include "dynamics/effect.hpp"

namespace freestand::bench {

enum class PeerMode { rest, slide, rock, slide_rock };
enum class PeerEvent { none, impact, overturned, grip, stop, lift, tip, kink };

struct PeerState {
  PeerMode mode = PeerMode::rest;
  double s = 0, sigma = 0;  // corner and direction of slip
  double theta = 0, omega = 0, xi = 0, w = 0;
};

struct PeerResponse {
  double slip_m = 0, rotation_rad = 0, acceleration_mps2 = 0;  // peaks
  int events = 0;
  bool overturned = false, failed = false;
};

struct PeerForces {
  double alpha, slip_acceleration, fx, fy;
};

struct PeerBlock {
  PeerBlock(const Specimen& specimen, double tolerance)
      : b(specimen.block.right_m),
        h(specimen.block.height_m),
        k2(specimen.block.gyration2_m2),
        inertia(k2 + b * b + h * h),
        mu_s(specimen.friction.mu_s),
        mu_k(specimen.friction.mu_k),
        kept(specimen.impact.factor * std::fmax(0.0, (k2 + h * h - b * b) / inertia)),
        can_slip(specimen.model != Model::rock),
        can_rock(specimen.model != Model::slide),
        last_rate2(tolerance * 2 * g * b / inertia) {
    for (const EffectUse& use : specimen.effects) {
      if (use.effect->name == "static_friction") mu_s = use.parameters[0] * mu_k;
      if (use.effect->name == "impact_loss") kept *= use.parameters[0];
      if (use.effect->name == "rate_weakening") drop = use.parameters[0], over_speed = 1 / use.parameters[1];
    }
    quiet = std::fmin(can_slip ? mu_s * g : 1e300, can_rock ? b / h * g : 1e300);
  }

  double b, h, k2, inertia, mu_s, mu_k, kept;
  bool can_slip, can_rock;
  double quiet = 0, last_rate2;  // |a| that moves nothing; a hop whose omega^2 is less than this ends the rocking
  double drop = 0, over_speed = 0;
  static constexpr double g = standard_gravity_mps2;

  double mu_at(double w) const {
    return drop == 0 ? mu_k : mu_k * (1 - drop * (1 - std::exp(-std::abs(w) * over_speed)));
  }
  double rock_alpha(double s, double theta, double a) const {
    const double sine = std::sin(theta), cosine = std::cos(theta), c = s * b;
    return ((h * sine - c * cosine) * g - (c * sine + h * cosine) * a) / inertia;
  }
  PeerForces rock_forces(double s, double theta, double omega, double a) const {
    const double sine = std::sin(theta), cosine = std::cos(theta), c = s * b;
    const double rx = h * sine - c * cosine, ry = c * sine + h * cosine;
    const double alpha = (rx * g - ry * a) / inertia;
    return {alpha, 0, ry * alpha - rx * omega * omega + a, g - rx * alpha - ry * omega * omega};
  }
  PeerForces slide_rock_forces(double s, double sigma, double theta, double omega, double w, double a) const {
    const double sine = std::sin(theta), cosine = std::cos(theta), c = s * b, sm = sigma * mu_at(w);
    const double rx = h * sine - c * cosine, ry = c * sine + h * cosine;
    const double q = rx + sm * ry, n = g - ry * omega * omega, d = k2 + rx * q;
    const double alpha = n * q / d, fy = n * k2 / d;
    return {alpha, -sm * fy - a - ry * alpha + rx * omega * omega, -sm * fy, fy};
  }
  double slip(const PeerState& y) const { return y.xi + y.s * b * (1 - std::cos(y.theta)); }
  double slip_rate(const PeerState& y) const { return y.w + y.s * b * std::sin(y.theta) * y.omega; }

  // Flat and not turning.
  void choose_flat(PeerState& y, double a) const {
    const double over = a > 0 ? -1 : 1;
    y.s = 0;
    if (y.w != 0) {
      y.sigma = y.w > 0 ? 1 : -1;
      y.mode = PeerMode::slide;
      if (can_rock && mu_at(y.w) * h > b) y = {PeerMode::slide_rock, y.sigma, y.sigma, 0, 0, y.xi, y.w};
      return;
    }
    const bool slips = can_slip && std::abs(a) > mu_s * g, tips = can_rock && h * std::abs(a) > b * g;
    y.sigma = 0;
    y.mode = PeerMode::rest;
    if (!slips && !tips) return;
    if (tips) {
      const PeerForces f = rock_forces(over, 0, 0, a);
      if (!can_slip || std::abs(f.fx) <= mu_s * f.fy) {
        y.mode = PeerMode::rock;
        y.s = over;
        return;
      }
    }
    y.sigma = over;
    y.mode = PeerMode::slide;
    if (can_rock && mu_k * h > b) {
      y.mode = PeerMode::slide_rock;
      y.s = over;
    }
  }
  // From rest, at the instant at which |a| reaches `quiet`.
  void leave_rest(PeerState& y, double a) const {
    const double over = a > 0 ? -1 : 1;
    if (can_rock && (!can_slip || b / h <= mu_s)) {
      y.mode = PeerMode::rock;
      y.s = over;
    } else {
      y.mode = PeerMode::slide;
      y.sigma = over;
    }
  }
  void slip_on_corner(PeerState& y, double fx) const {
    y.mode = PeerMode::slide_rock;
    y.sigma = fx > 0 ? -1 : 1;
  }
  void choose_on_corner(PeerState& y, double a) const {
    if (y.w != 0) {
      y.mode = PeerMode::slide_rock;
      y.sigma = y.w > 0 ? 1 : -1;
      return;
    }
    y.sigma = 0;
    y.mode = PeerMode::rock;
    if (!can_slip) return;
    const PeerForces f = rock_forces(y.s, y.theta, y.omega, a);
    if (std::abs(f.fx) > mu_s * f.fy) slip_on_corner(y, f.fx);
  }
  void strike(PeerState& y, double a) const {
    y.theta = 0;
    y.omega *= kept;
    if (y.omega * y.omega < last_rate2) {
      if (y.w != 0) {  // the rest of the hops at once: two geometric series
        const double before = y.w > 0 ? 1 : -1;
        y.w += (2 * h * y.omega * (1 - kept) + 2 * before * mu_at(y.w) * b * (1 + kept) * std::abs(y.omega)) /
               (1 - kept * kept);
        if (y.w * before < 0) y.w = 0;
      }
      y.omega = 0;
      choose_flat(y, a);
    } else {
      y.s = -y.s;
      choose_on_corner(y, a);
    }
  }
  // False: the sample ends.
  bool resolve(PeerEvent event, PeerState& y, double a, PeerResponse& response) const {
    ++response.events;
    switch (event) {
      case PeerEvent::impact:
        strike(y, a);
        return true;
      case PeerEvent::overturned:
        response.overturned = true;
        return false;
      case PeerEvent::grip:
        slip_on_corner(y, rock_forces(y.s, y.theta, y.omega, a).fx);
        return true;
      case PeerEvent::tip:
        y = {PeerMode::slide_rock, y.sigma, y.sigma, 0, 0, y.xi, y.w};
        return true;
      case PeerEvent::stop:
        y.w = 0;
        if (y.mode == PeerMode::slide)
          choose_flat(y, a);
        else
          choose_on_corner(y, a);
        return true;
      default:
        response.failed = true;
        return false;
    }
  }
};

// The record of one sample: knots at i * dt, values scaled as they are read.
struct PeerRecord {
  explicit PeerRecord(const Shaking& shaking)
      : values(shaking.motion->horizontal_mps2.data()),
        scale(shaking.scale),
        dt(shaking.motion->knot_s[1]),
        count(static_cast<int>(shaking.motion->segments())) {}
  const double* values;  // a, slope; a, slope; ...
  double scale, dt;
  int count;

  double at(int i) const { return i < count ? scale * values[2 * i] : 0.0; }
  double slope(int i) const { return i < count ? scale * values[2 * i + 1] : 0.0; }
};

}  // namespace freestand::bench
