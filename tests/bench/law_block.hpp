// The block of peer_block.hpp under one law of peer_laws.hpp: its forces in every mode, and which mode follows an event. It
// is uniform and its impacts are Housner's.
//
//   f_x = M (w' + r_y theta'' - r_x omega^2 + a) - X,   f_y = g' - r_x theta'' - r_y omega^2,   k^2 theta'' = r_x f_y - r_y f_x
//   slipping: f_x = -sigma mu F f_y
//
// A mode change is decided from the values at the instant alone.
#pragma once

#include <algorithm>

#include "peer_laws.hpp"

namespace freestand::bench {

struct LawForces {
  double alpha = 0, fx = 0, fy = 0;
  double acceleration = 0;       // of the centre of mass, the floor's included
  double slip_acceleration = 0;  // w'
  double rate0 = 0, rate1 = 0;   // of the law's own unknowns
};

template <class Law>
struct LawBlock {
  LawBlock(const Specimen& specimen, const std::vector<double>& parameters, double tolerance)
      : law(parameters),
        b(specimen.block.right_m),
        h(specimen.block.height_m),
        k2(specimen.block.gyration2_m2),
        inertia(k2 + b * b + law.mass * h * h),
        over_inertia(1 / inertia),
        mu_s(specimen.friction.mu_s),
        mu_k(specimen.friction.mu_k),
        kept(specimen.impact.factor * std::fmax(0.0, (k2 + law.mass * h * h - b * b) / inertia)),
        can_slip(specimen.model != Model::rock),
        can_rock(specimen.model != Model::slide),
        last_rate2(tolerance * 2 * law.gravity * b / inertia) {}

  Law law;
  double b, h, k2, inertia, over_inertia, mu_s, mu_k, kept;
  bool can_slip, can_rock;
  double last_rate2;  // a hop whose omega^2 is less than this ends the rocking

  double factor(double sigma, double path, double fy) const {
    if constexpr (Law::factor_follows_force) return law.share(fy / standard_gravity_mps2);
    return law.factor(sigma, path);
  }
  double limit(double sigma, const LawState& y, double fy) const { return mu_s * factor(sigma, y.path, fy) * fy; }
  // Above zero while the contact is stuck.
  double grip(const LawState& y, const LawForces& f) const {
    return std::fmin(limit(-1, y, f.fy) - f.fx, limit(1, y, f.fy) + f.fx);
  }
  double displacement(const LawState& y) const { return y.xi + y.s * b * (1 - std::cos(y.theta)); }
  double velocity(const LawState& y) const { return y.w + y.s * b * std::sin(y.theta) * y.omega; }

  // a, g: acceleration of the floor and gravity across it at the instant.
  template <bool turns, bool slips>
  LawForces forces(const LawState& y, double a, double g) const {
    LawForces f;
    const double M = law.mass;
    double u = y.xi, v = y.w, rx = 0, ry = h, omega2 = 0;
    if constexpr (turns) {
      const double sine = std::sin(y.theta), cosine = std::cos(y.theta), c = y.s * b;
      rx = h * sine - c * cosine;
      ry = c * sine + h * cosine;
      u += c * (1 - cosine);
      v += c * sine * y.omega;
      omega2 = y.omega * y.omega;
    }
    const double X = law.force(u, v, y), n = g - ry * omega2;
    if constexpr (slips) {
      const double sm = y.sigma * mu_k;
      f.fy = turns ? pressed(sm, y, rx, ry, n) : g;
      f.fx = -sm * factor(y.sigma, y.path, f.fy) * f.fy;
      if constexpr (turns) f.alpha = (rx * f.fy - ry * f.fx) / k2;
    } else if constexpr (turns) {
      if constexpr (Law::own == 0)
        f.alpha = (rx * g - ry * (a - X)) * over_inertia;
      else
        f.alpha = (rx * n - ry * (M * (a - rx * omega2) - X)) / (k2 + rx * rx + M * ry * ry);
      f.fx = M * (ry * f.alpha - rx * omega2 + a) - X;
      f.fy = n - rx * f.alpha;
    } else {
      f.fx = M * a - X;
      f.fy = g;
    }
    f.acceleration = (f.fx + X) / M;
    if (slips) f.slip_acceleration = f.acceleration - a - ry * f.alpha + rx * omega2;
    if constexpr (Law::own == 2) {
      f.rate0 = y.e1;
      f.rate1 = law.rate_of_speed(y, f.acceleration);
    }
    return f;
  }

  // Normal force of a corner that slips: f_y (k^2 + r_x (r_x + sigma mu F r_y)) = n k^2.
  double pressed(double sm, const LawState& y, double rx, double ry, double n) const {
    const double own = k2 + rx * rx, rubs = sm * rx * ry;
    if constexpr (!Law::factor_follows_force) {
      return n * k2 / (own + rubs * law.factor(y.sigma, y.path));
    } else {  // Newton's iteration
      double fy = std::fmax(n, 0.0) * k2 / (own + rubs);
      for (int i = 0; i < 20; ++i) {
        const double share = factor(0, 0, fy);
        const double change = (fy * (own + rubs * share) - n * k2) / (own + rubs * share * (1 + law.exponent));
        fy = std::fmax(fy - change, 1e-3 * fy);
        if (std::abs(change) < 1e-15 * fy) break;
      }
      return fy;
    }
  }

  // Flat and not turning.
  void choose_flat(LawState& y, double a, double g) const {
    y.s = 0;
    if (slides_on(y, g)) return;
    const double sigma = y.sigma;
    y.sigma = 0;
    y.mode = PeerMode::rest;
    const LawForces f = forces<false, false>(y, a, g);
    const double over = f.fx > 0 ? -1 : 1;
    const bool slips = can_slip && grip(y, f) < 0, tips = can_rock && h * std::abs(f.fx) > b * g;
    if (!slips && !tips) return;
    if (tips) {
      y.mode = PeerMode::rock;
      y.s = over;
      if (!can_slip || grip(y, forces<true, false>(y, a, g)) >= 0) return;
    }
    y.s = 0;
    y.sigma = slips ? over : sigma != 0 ? sigma : over;
    slide_or_tip(y, g);
  }
  bool slides_on(LawState& y, double g) const {
    if (y.w == 0) return false;
    y.sigma = y.w > 0 ? 1 : -1;
    slide_or_tip(y, g);
    return true;
  }
  void slide_or_tip(LawState& y, double g) const {
    y.mode = PeerMode::slide;
    if (!can_rock || mu_k * factor(y.sigma, y.path, g) * h <= b) return;
    y.mode = PeerMode::slide_rock;
    y.s = y.sigma;
  }
  void choose_on_corner(LawState& y, double a, double g) const {
    y.mode = PeerMode::slide_rock;
    if (y.w != 0) {
      y.sigma = y.w > 0 ? 1 : -1;
      return;
    }
    y.sigma = 0;
    y.mode = PeerMode::rock;
    if (!can_slip) return;
    const LawForces f = forces<true, false>(y, a, g);
    if (grip(y, f) < 0) slip_on_corner(y, f.fx);
  }
  void slip_on_corner(LawState& y, double fx) const {
    y.mode = PeerMode::slide_rock;
    y.sigma = fx > 0 ? -1 : 1;
  }
  void choose(LawState& y, double a, double g) const {
    if (y.s == 0 || (y.theta == 0 && y.omega == 0))
      choose_flat(y, a, g);
    else
      choose_on_corner(y, a, g);
  }

  void strike(LawState& y, double a, double g) const {
    const double speed = y.w + h * y.omega;
    y.theta = 0;
    y.omega *= kept;
    if (y.omega * y.omega < last_rate2) {
      if (y.w != 0) last_hops(y);
      y.omega = 0;
      y.s = 0;
    } else {
      y.s = -y.s;
    }
    if constexpr (Law::own == 2) y.e1 -= y.w + h * y.omega - speed;  // the contents keep their velocity
    turn_side(y);
    choose(y, a, g);
  }
  // The rest of the hops at once: two geometric series.
  void last_hops(LawState& y) const {
    const double before = y.w > 0 ? 1 : -1;
    const double mu = mu_k * factor(before, y.path, law.gravity);
    y.w += (2 * h * y.omega * (1 - kept) + 2 * before * mu * b * (1 + kept) * std::abs(y.omega)) / (1 - kept * kept);
    if (y.w * before < 0) y.w = 0;
  }
  void turn_side(LawState& y) const {
    if constexpr (Law::has_kinks) y.side = law.side_at(displacement(y), velocity(y));
  }

  // False: the sample ends.
  bool resolve(PeerEvent event, LawState& y, double a, double g, PeerResponse& response) const {
    ++response.events;
    switch (event) {
      case PeerEvent::impact:
        strike(y, a, g);
        return true;
      case PeerEvent::overturned:
        response.overturned = true;
        return false;
      case PeerEvent::grip:
        if (y.mode == PeerMode::rock)
          slip_on_corner(y, forces<true, false>(y, a, g).fx);
        else
          leave_rest(y, a, g, event);
        return true;
      case PeerEvent::tip:
        if (y.mode == PeerMode::rest)
          leave_rest(y, a, g, event);
        else
          y.mode = PeerMode::slide_rock, y.s = y.sigma;
        return true;
      case PeerEvent::kink:
        if constexpr (Law::has_kinks) y.side = law.side_beyond(displacement(y), velocity(y), y.side);
        choose(y, a, g);
        return true;
      case PeerEvent::stop:
        y.w = 0;
        y.sigma = 0;
        turn_side(y);
        choose(y, a, g);
        return true;
      default:
        response.failed = true;
        return false;
    }
  }
  // At the very instant at which the block slips, or tips.
  void leave_rest(LawState& y, double a, double g, PeerEvent event) const {
    const double over = forces<false, false>(y, a, g).fx > 0 ? -1 : 1;
    if (event == PeerEvent::tip) {
      y.mode = PeerMode::rock;
      y.s = over;
    } else {
      y.mode = PeerMode::slide;
      y.sigma = over;
    }
  }
};

}  // namespace freestand::bench
