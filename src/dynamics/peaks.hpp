// Running extremes of a response, taken from the polynomials of each step, not from its end points.
#pragma once

#include <algorithm>
#include <freestand/response.hpp>
#include <iterator>

#include "dynamics/contact.hpp"
#include "dynamics/force_peaks.hpp"
#include "dynamics/law_arc.hpp"
#include "dynamics/law_flight.hpp"
#include "dynamics/point.hpp"
#include "dynamics/rig.hpp"
#include "dynamics/roots.hpp"

namespace freestand::dynamics {

// u(tau): displacement of the base's midpoint relative to the floor, u = xi + s B (1 - cos theta), B = (b_l + b_r)/2, by
// cos theta = (h r_y - c r_x)/(h^2 + c^2). half_base: s B.
template <int N, class Real>
[[gnu::always_inline]] inline Series<Real, N> midpoint(const Corner<Real>& body, const Real& half_base,
                                                       const Arc<Real, N>& arc, const Real& versine) {
  Series<Real, N> u = arc.xi;
  const Real lever = half_base / (body.h * body.h + body.c * body.c);
#pragma GCC unroll 16
  for (int k = 1; k <= N; ++k) u[k] = u[k] - lever * (body.h * arc.ry[k] - body.c * arc.rx[k]);
  u[0] = u[0] + half_base * versine;
  return u;
}
template <int N>
Series<double, N> midpoint(const Rig& rig, const State& state, const Arc<double, N>& arc) {
  if (state.pivot == 0) return arc.xi;
  return midpoint(rig.corner(state.pivot), state.pivot * rig.half_base(), arc, rotation_by(state.theta).versine);
}

// The same in flight: u = x + d cos(theta) - h sin(theta) - d, d = (b_r - b_l)/2.
inline double midpoint_in_flight(const Rig& rig, double x, double theta) {
  const double d = 0.5 * (rig.right - rig.left);
  const Rotation<double> rotation = rotation_by(theta);
  return x - rig.h * rotation.sine - d * rotation.versine;
}

// Two squares, their sum, a root and its square round off by less than this: no new peak.
inline constexpr double same_peak = 1 + 1e-15;

template <class Real, int N>
[[gnu::always_inline]] inline Series<Real, N> squared_length(const Series<Real, N>& x, const Series<Real, N>& y) {
  Series<Real, N> square;
#pragma GCC unroll 16
  for (int k = 0; k <= N; ++k) square[k] = product(x, x, k) + product(y, y, k);
  return square;
}

class Peaks {
 public:
  explicit Peaks(const Settings& settings) : forces_(settings, response_) {
    if (settings.slip_by_side) response_.peak_slip_right_m = response_.peak_slip_left_m = 0;
    if (!std::isnan(settings.acceleration_height_m))
      response_.peak_acceleration_at_height_mps2 = response_.largest_blow_mps = 0;
  }

  template <int N>
  void observe(const Rig& rig, const State& state, const Arc<double, N>& arc, double tau) {
    const Series<double, N> u = midpoint(rig, state, arc);
    if (state.mode != Mode::rest) {
      observe_slip(u, tau);
      if (state.pivot != 0) response_.peak_rotation_rad = max_abs(arc.theta, tau, response_.peak_rotation_rad);
      if (state.sigma != 0) response_.slid_path_m += std::abs(arc.xi.at(tau) - arc.xi[0]);
    }
    observe_acceleration(rig, arc.fx, arc.fy, tau);
    observe_point(rig, arc.theta[0], arc.omega, arc.fx, arc.fy, tau);
    forces_.on_floor(rig, state, arc, u, tau, response_);
  }

  template <int N>
  void observe(const Rig& rig, const State& state, const LawArc<N>& arc, double tau) {
    const Series<double, N> u = midpoint(rig, state, arc);
    observe_slip(u, tau);
    if (state.pivot != 0) response_.peak_rotation_rad = max_abs(arc.theta, tau, response_.peak_rotation_rad);
    response_.slid_path_m += arc.path.at(tau) - arc.path[0];
    observe_acceleration(rig, arc.ax, upward(rig, arc), tau);
    observe_point(rig, arc.theta[0], arc.omega, arc.ax, upward(rig, arc), tau);
    forces_.on_floor(rig, state, arc, u, tau, response_);
  }

  template <int N>
  void observe(const Rig& rig, const State&, const Flight<double, N>& flight, double tau) {
    observe_flight(rig, flight, tau);
    observe_acceleration(rig, Series<double, N>::zero(), Series<double, N>::zero(), tau);
    observe_point(rig, flight.theta[0], flight.omega, Series<double, N>::zero(), Series<double, N>::zero(), tau);
  }

  template <int N>
  void observe(const Rig& rig, const State& state, const LawFlight<N>& flight, double tau) {
    const Series<double, N> u = observe_flight(rig, flight, tau);
    forces_.in_flight(rig, state, flight, u, tau, response_);
    observe_acceleration(rig, flight.ax, flight.lift, tau);
    observe_point(rig, flight.theta[0], flight.omega, flight.ax, flight.lift, tau);
  }

  template <class SomeArc>
  void ring_down(const Rig& rig, const SomeArc& arc) {
    forces_.ring_down(rig, arc, response_);
  }
  // A pull that jumped over the strength was felt up to it.
  void broke_at(double strength) {
    if (forces_.followed()) response_.peak_chain_force_mps2 = std::fmax(response_.peak_chain_force_mps2, strength);
  }
  void tell_fatigue() { forces_.tell_fatigue(response_); }

  // What the block feels at rest is looked at step by step.
  bool follow_rest() const { return forces_.followed(); }

  // At rest the block has the acceleration of the floor.
  template <int N>
  void observe_rest(const Rig& rig, const Floor<double, N>& floor, double tau) {
    if (std::all_of(floor.g.c + 1, floor.g.c + N + 1, [](double v) { return v == 0; }) && floor.g[0] == rig.g)
      observe_along(rig, floor.a, tau);
    else
      observe_acceleration(rig, floor.a, floor.g, tau);
    observe_point(rig, 0, Series<double, N>::zero(), floor.a, floor.g, tau);
  }

  // Would a total acceleration within these bounds be a new peak?
  bool may_exceed(double a, double v) const {
    const double peak = std::fmin(response_.peak_acceleration_mps2, response_.peak_acceleration_at_height_mps2);
    return !(a * a + v * v <= peak * peak);
  }

  // Beside a wall a block comes to stand in blows of floor and wall that follow one another ever faster, in an order that
  // hangs on the last digit of its motion. What it feels between a blow and the event before or after it, when they are closer
  // together than `brief_s`, does not count: from an event on, at a time [s], it waits for the next one.
  void event_beside_wall(bool blow, double time) {
    const bool brief = waits_ && (blow || waits_since_blow_);
    for (std::size_t i = 0; i < std::size(felt); ++i)
      if (brief)
        response_.*felt[i] = before_[i];
      else
        before_[i] = response_.*felt[i];
    waits_ = true;
    waits_since_blow_ = blow;
    waits_since_ = time;
  }
  // The motion has gone on to this time: what has lasted counts.
  void came_to(double time, double brief_s) { waits_ = waits_ && time - waits_since_ < brief_s; }
  bool waits() const { return waits_; }

  Response& response() { return response_; }
  const Response& response() const { return response_; }
  bool finite() const { return finite_; }

 private:
  // Of the point that is followed; by the forces on the block but gravity, as below.
  template <int N>
  void observe_point(const Rig& rig, double theta, const Series<double, N>& omega, Series<double, N> fx,
                     Series<double, N> lift, double tau) {
    if (!rig.point) return;
    const PointAcceleration<N> beside(*rig.point, theta, omega);
    for (int k = 0; k < N; ++k) {
      fx[k] += beside.x[k];
      lift[k] += beside.y[k];
    }
    fx[0] -= rig.push;
    lift[0] -= rig.g;
    double& peak = response_.peak_acceleration_at_height_mps2;
    peak = std::sqrt(max_abs(squared_length(fx, lift), tau, peak * peak));
  }

  template <int N>
  void observe_slip(const Series<double, N>& u, double tau) {
    response_.peak_slip_m = max_abs(u, tau, response_.peak_slip_m);
    if (std::isnan(response_.peak_slip_right_m)) return;
    response_.peak_slip_right_m = max_of(u, tau, response_.peak_slip_right_m);
    response_.peak_slip_left_m = max_of(scaled(-1.0, u), tau, response_.peak_slip_left_m);
  }

  // The displacement of the middle of the base.
  template <int N>
  Series<double, N> observe_flight(const Rig& rig, const Flight<double, N>& flight, double tau) {
    response_.peak_rotation_rad = max_abs(flight.theta, tau, response_.peak_rotation_rad);
    Series<double, N> u = flight.x;
    const double d = 0.5 * (rig.right - rig.left);
    Series<double, N> sine = Series<double, N>::zero(), cosine = sine;
    const Rotation<double> rotation = rotation_by(flight.theta[0]);
    sine[0] = rotation.sine;
    cosine[0] = rotation.cosine;
    for (int k = 0; k < N; ++k) {
      sine[k + 1] = product(cosine, flight.omega, k) / (k + 1);
      cosine[k + 1] = -product(sine, flight.omega, k) / (k + 1);
      u[k + 1] += d * cosine[k + 1] - rig.h * sine[k + 1];
    }
    u[0] = midpoint_in_flight(rig, flight.x[0], flight.theta[0]);
    observe_slip(u, tau);
    return u;
  }

  // Total acceleration of the centre of mass, by the forces on it but gravity: (f_x - g sin(beta), f_y - g cos(beta)), beta
  // the tilt of the floor.
  template <int N>
  void observe_acceleration(const Rig& rig, Series<double, N> fx, Series<double, N> lift, double tau) {
    fx[0] -= rig.push;
    lift[0] -= rig.g;
    const double peak = response_.peak_acceleration_mps2, peak2 = peak * peak;
    const double bound_x = size_of_rest<0>(fx, tau), bound_y = size_of_rest<0>(lift, tau);
    const double bound2 = bound_x * bound_x + bound_y * bound_y;
    if (bound2 <= peak2 * same_peak) return;
    if (!std::isfinite(bound2)) finite_ = false;
    response_.peak_acceleration_mps2 = std::sqrt(max_abs(squared_length(fx, lift), tau, peak2));
  }

  // The same where none of it is across the floor.
  template <int N>
  void observe_along(const Rig& rig, Series<double, N> fx, double tau) {
    fx[0] -= rig.push;
    double& peak = response_.peak_acceleration_mps2;
    peak = max_abs(fx, tau, peak);
    if (!std::isfinite(peak)) finite_ = false;
  }

  Response response_;
  ForcePeaks forces_;
  bool finite_ = true;
  bool waits_ = false;  // since an event beside a wall
  bool waits_since_blow_ = false;
  double waits_since_ = 0;  // [s]
  static constexpr double Response::*felt[] = {
      &Response::peak_acceleration_mps2,       &Response::peak_acceleration_at_height_mps2,
      &Response::peak_contact_horizontal_mps2, &Response::peak_contact_vertical_mps2,
      &Response::peak_chain_force_mps2,        &Response::peak_contents_acceleration_mps2};
  double before_[std::size(felt)] = {};  // what was felt until then
};

}  // namespace freestand::dynamics
