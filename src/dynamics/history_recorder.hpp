// Writes the history of one sample: points at a constant step, read off the polynomials of each step, and the events.
#pragma once

#include <freestand/response.hpp>

#include "dynamics/law_values.hpp"
#include "dynamics/output_times.hpp"
#include "dynamics/peaks.hpp"

namespace freestand::dynamics {

class HistoryRecorder {
 public:
  HistoryRecorder(History* history, const Rig& rig) : history_(history), rig_(rig), times_(history) {
    if (history_) history_->points.clear(), history_->events.clear();
  }

  void event(double time, Mode from, const State& to, bool impact) {
    if (history_) history_->events.push_back({time, from, to.mode, to.pivot, impact});
  }

  template <int N>
  void record(const State& state, const Arc<double, N>& arc, const Floor<double, N>& floor, double start, double tau) {
    record_contact(state, arc, arc.fx, floor, start, tau);
  }
  template <int N>
  void record(const State& state, const LawArc<N>& arc, const Floor<double, N>& floor, double start, double tau) {
    record_contact(state, arc, arc.ax, floor, start, tau);
  }

  template <int N>
  void record(const State& state, const LawFlight<N>& flight, const Floor<double, N>& floor, double start, double tau) {
    record(state, flight, floor, start, tau, flight.ax, flight.lift);
  }
  template <int N>
  void record(const State& state, const Flight<double, N>& flight, const Floor<double, N>& floor, double start,
              double tau) {
    record(state, flight, floor, start, tau, Series<double, N>::zero(), Series<double, N>::zero());
  }

  // pull, lift: what laws add to the acceleration of the centre of mass.
  template <int N>
  void record(const State&, const Flight<double, N>& flight, const Floor<double, N>& floor, double start, double tau,
              const Series<double, N>& pull, const Series<double, N>& lift) {
    if (!wanted()) return;
    const auto beside = beside_the_centre(flight.theta[0], flight.omega);
    const double d = 0.5 * (rig_.right - rig_.left);
    each_point(start, tau, [&](HistoryPoint& point, double t) {
      const double theta = flight.theta.at(t), omega = flight.omega.at(t);
      point.time_s = start + t;
      point.floor_acceleration_mps2 = floor.a.at(t) - rig_.push;
      point.slip_m = midpoint_in_flight(rig_, flight.x.at(t), theta);
      point.slip_velocity_mps = flight.vx.at(t) - (rig_.h * std::cos(theta) + d * std::sin(theta)) * omega;
      point.rotation_rad = theta;
      point.rotation_rate_radps = omega;
      point.mode = Mode::flight;
      if (!beside) return;
      point.acceleration_mps2 = pull.at(t) + beside->x.at(t) - rig_.push;
      point.vertical_acceleration_mps2 = lift.at(t) + beside->y.at(t) - rig_.g;
    });
  }

  // A block at rest for the time tau to come.
  template <int N>
  void rest(const State& state, const Floor<double, N>& floor, double start, double tau) {
    each_point(start, tau, [&](HistoryPoint& point, double t) {
      rest_at(point, state, state.xi, start + t, floor.a.at(t), floor.g.at(t));
    });
  }

  // The last state, held to the end of the motion: what rests, or has fallen, stays.
  void hold(const State& state, double slip, double end, const Shaking& shaking) {
    if (!wanted()) return;
    times_.up_to(end, [&](double t) {
      const double a = horizontal_acceleration(shaking, t), v = vertical_acceleration(shaking, t);
      rest_at(history_->points.emplace_back(), state, slip, t, a + rig_.push, v + rig_.g);
    });
  }

  bool wanted() const { return times_.wanted(); }
  History* history() { return history_; }
  OutputTimes& times() { return times_; }

 private:
  // a, g: of the floor, with what a tilt adds. The floor holds the block against them and against what laws pull; of a
  // block that is pressed against a wall as far as friction can.
  void rest_at(HistoryPoint& point, const State& state, double slip, double time, double a, double g) const {
    point.time_s = time;
    point.floor_acceleration_mps2 = point.acceleration_mps2 = a - rig_.push;
    point.slip_m = slip;
    point.rotation_rad = state.theta;
    point.mode = state.mode;
    point.vertical_acceleration_mps2 = g - rig_.g;
    point.contact_x_mps2 = a;
    point.contact_y_mps2 = g;
    if (!rig_.laws || !history_->forces || state.mode == Mode::overturned) return;
    const LawValues laws = law_values(rig_, state, time, 0);
    point.contact_x_mps2 -= laws.force;
    point.contact_y_mps2 -= laws.lift;
    const Held held = helped_by_walls(rig_, state);
    const double limit = rig_.mu_s * laws.factor * point.contact_y_mps2;
    if (held.right) point.contact_x_mps2 = std::fmax(point.contact_x_mps2, -limit);
    if (held.left) point.contact_x_mps2 = std::fmin(point.contact_x_mps2, limit);
  }
  // The acceleration of the point that is followed beside that of the centre of mass, where it is asked for.
  template <int N>
  std::optional<PointAcceleration<N>> beside_the_centre(double theta, const Series<double, N>& omega) const {
    if (!history_->forces) return {};
    return PointAcceleration<N>(rig_.point.value_or(Point{}), theta, omega);
  }
  // pull: total acceleration of the centre of mass along the floor, gravity along a tilted floor included.
  template <class ContactArc, int N>
  void record_contact(const State& state, const ContactArc& arc, const Series<double, N>& pull,
                      const Floor<double, N>& floor, double start, double tau) {
    if (!wanted()) return;
    const auto u = midpoint(rig_, state, arc), up = upward(rig_, arc);
    const auto beside = beside_the_centre(arc.theta[0], arc.omega);
    each_point(start, tau, [&](HistoryPoint& point, double t) {
      const double theta = arc.theta.at(t), omega = arc.omega.at(t);
      point.time_s = start + t;
      point.floor_acceleration_mps2 = floor.a.at(t) - rig_.push;
      point.slip_m = u.at(t);
      point.slip_velocity_mps = arc.w.at(t) + state.pivot * rig_.half_base() * std::sin(theta) * omega;
      point.rotation_rad = theta;
      point.rotation_rate_radps = omega;
      point.mode = state.mode;
      if (!beside) return;
      point.acceleration_mps2 = pull.at(t) + beside->x.at(t) - rig_.push;
      point.vertical_acceleration_mps2 = up.at(t) + beside->y.at(t) - rig_.g;
      point.contact_x_mps2 = floor_force_at(rig_, state, arc, t);
      point.contact_y_mps2 = arc.fy.at(t);
    });
  }

  // fill(point, t): what is not zero.
  template <class Fill>
  void each_point(double start, double tau, Fill&& fill) {
    times_.within(start, tau, [&](double t) { fill(history_->points.emplace_back(), t); });
  }

  History* history_;
  const Rig& rig_;
  OutputTimes times_;
};

}  // namespace freestand::dynamics
