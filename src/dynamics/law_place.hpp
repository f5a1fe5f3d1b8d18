// Where the block is in the course of a step, as laws and walls see it, and what the laws make of it: the part of the equations that
// no contact force enters.
#pragma once

#include "dynamics/law_arc.hpp"
#include "dynamics/standing.hpp"

namespace freestand::dynamics {

template <int N, class Real, class Numbers, class Kind>
class LawPlace {
 public:
  LawPlace(const Laws& laws, const Standing<Real>& at, const Numbers& numbers, const Kind& kind,
           const Floor<Real, N>& floor)
      : laws_(laws),
        at_(at),
        numbers_(numbers),
        floor_(floor),
        legs_(laws.legs.frequency_radps > 0),
        kind_(kind),
        sees_place_(laws.reads(Input::u) || laws.reads(Input::v) || laws.sees_rise() || laws.walls.any()) {
    if (laws.lift < 0) y_.lift = Series<Real, N>::zero();
    if (!legs_) y_.deflection = Series<Real, N>::zero();
  }

 protected:
  bool turns() const { return kind_.turns(); }
  bool slips() const { return kind_.slips(); }

  void begin() {
    const Corner<Real>& body = at_.body;
    const Rotation<Real> rotation = rotation_by(at_.theta);
    y_.versine = rotation.versine;
    y_.theta[0] = at_.theta;
    y_.omega[0] = at_.omega;
    y_.xi[0] = at_.xi;
    y_.w[0] = at_.w;
    y_.rx[0] = body.h * rotation.sine - body.c * rotation.cosine;
    y_.ry[0] = body.c * rotation.sine + body.h * rotation.cosine;
    y_.path[0] = at_.path;
    if (legs_) y_.deflection[0] = at_.deflection;
    if (sees_place_) {
      sine_[0] = rotation.sine;
      cosine_[0] = rotation.cosine;
    }
    for (int i = 0; i < laws_.states; ++i) value(Input::state, i)[0] = at_.states[i];
    if (laws_.reads(Input::t)) start(Input::t, at_.time, 1.0);
    if (laws_.reads(Input::rest) && !slips()) start(Input::rest, at_.time - at_.still_since, 1.0);
    if (laws_.reads(Input::rest) && slips()) start(Input::rest, Real(0.0), 0.0);
    if (laws_.reads(Input::side)) start(Input::side, at_.pivot, 0.0);
    if (laws_.reads(Input::sigma)) start(Input::sigma, at_.sigma, 0.0);
  }

  Series<Real, N>& value(Input input, int offset = 0) { return values_[static_cast<int>(input) + offset]; }
  void start(Input input, const Real& first, double second) {
    value(input) = Series<Real, N>::zero();
    value(input)[0] = first;
    value(input)[1] = Real(second);
  }

  [[gnu::always_inline]] void kinematics(int k) {
    press(k);
    inputs(k);
  }

  // What presses a corner down when theta'' = 0.
  [[gnu::always_inline]] void press(int k) {
    if (turns()) {
      omega2_[k] = product(y_.omega, y_.omega, k);
      rx_omega2_[k] = product(y_.rx, omega2_, k);
    }
    y_.n[k] = without_lift(k);
    y_.d[k] = Real(0.0);
  }
  [[gnu::always_inline]] Real without_lift(int k) const {
    return turns() ? floor_.g[k] - product(y_.ry, omega2_, k) : floor_.g[k];
  }

  [[gnu::always_inline]] void inputs(int k) {
    if (sees_place_) place(k);
    if (laws_.reads(Input::theta)) value(Input::theta)[k] = y_.theta[k];
    if (laws_.reads(Input::omega)) value(Input::omega)[k] = y_.omega[k];
    if (laws_.reads(Input::path)) value(Input::path)[k] = y_.path[k];
    // Stages of a step that reaches over the end of a slip may ask for a speed below zero, where laws mean nothing. Under legs
    // it is the foot that slips: act() finds its speed.
    if (!legs_ && laws_.reads(Input::speed)) {
      const Real speed = at_.sigma * y_.w[k];
      value(Input::speed)[k] = numbers_.choose(at_.sigma * at_.w < Real(0.0), Real(0.0), speed);
    }
    for (int i = 0; i < laws_.states; ++i) y_.states[i][k] = value(Input::state, i)[k];
  }

  // Where the middle of the base is, and how fast.
  void place(int k) {
    Series<Real, N>&u = value(Input::u), &v = value(Input::v);
    u[k] = y_.xi[k];
    v[k] = y_.w[k];
    if (laws_.sees_rise()) value(Input::rise)[k] = value(Input::climb)[k] = Real(0.0);
    if (!turns()) return;
    if (k > 0) {
      const Real &c = at_.body.c, &h = at_.body.h, to_angle = Real(1.0) / (h * h + c * c);
      sine_[k] = (h * y_.rx[k] + c * y_.ry[k]) * to_angle;
      cosine_[k] = (h * y_.ry[k] - c * y_.rx[k]) * to_angle;
    }
    u[k] = u[k] + at_.half_base * (k == 0 ? y_.versine : -cosine_[k]);
    v[k] = v[k] + at_.half_base * product(sine_, y_.omega, k);
    if (!laws_.sees_rise()) return;
    value(Input::rise)[k] = at_.half_base * sine_[k];
    value(Input::climb)[k] = at_.half_base * product(cosine_, y_.omega, k);
  }

  // Stages of a step that reaches over a lift-off may ask for a floor that pulls, where laws mean nothing: they see no force
  // then, and a corner whose friction follows its force has none.
  void see_normal(int k, const Real& normal) {
    Series<Real, N>& seen = value(Input::normal);
    if (k == 0)
      seen[0] = numbers_.choose(normal < Real(least_normal), Real(least_normal), normal);
    else
      seen[k] = numbers_.choose(seen[0] == Real(least_normal), Real(0.0), normal);
  }

  // What laws give, of order k.
  [[gnu::always_inline]] void forces_of_laws(int k) {
    if (laws_.forces_end > input_count) laws_.tape.advance(input_count, laws_.forces_end, k, numbers_, values_);
    force_[k] = laws_.force < 0 ? Real(0.0) : values_[laws_.force][k];
    if (laws_.moment >= 0) y_.moment[k] = values_[laws_.moment][k];
    if (laws_.lift < 0) return;
    y_.lift[k] = values_[laws_.lift][k];
    y_.n[k] = without_lift(k) - y_.lift[k];
  }
  const Real& factor_from_tape(int k) {
    laws_.tape.advance(laws_.forces_end, laws_.friction_end, k, numbers_, values_);
    return values_[laws_.friction][k];
  }

  void gaps() {
    if (!turns()) {
      sine_ = cosine_ = Series<Real, N>::zero();
      cosine_[0] = Real(1.0);
    } else {
      const Real &c = at_.body.c, &h = at_.body.h, to_angle = Real(1.0) / (h * h + c * c);
      sine_[N] = (h * y_.rx[N] + c * y_.ry[N]) * to_angle;
      cosine_[N] = (h * y_.ry[N] - c * y_.rx[N]) * to_angle;
    }
    y_.right_gap = clearance(at_.right_wall, 1.0, y_.xi, sine_, cosine_, y_.versine);
    y_.left_gap = clearance(at_.left_wall, -1.0, y_.xi, sine_, cosine_, y_.versine);
    y_.wall_push[N] = Real(0.0);
  }

  // [m g]; less than the round-off of a sum of forces, and more than what makes a power of it overflow.
  static constexpr double least_normal = 1e-18;

  const Laws& laws_;
  const Standing<Real>& at_;
  Numbers numbers_;
  const Floor<Real, N>& floor_;
  const bool legs_;
  LawArc<N, Real> y_;
  Series<Real, N> values_[max_nodes];
  Series<Real, N> force_;  // X [m/s2]
  Series<Real, N> omega2_, rx_omega2_, sine_, cosine_;

 private:
  const Kind kind_;
  const bool sees_place_;  // laws or walls look at where the block is
};

}  // namespace freestand::dynamics
