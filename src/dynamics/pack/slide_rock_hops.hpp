// Rows of small hops of a block that rocks itself to rest, without slip.
#pragma once

#include "dynamics/pack/slide_rock_lane.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

class SlideRockHops : public SlideRockLane {
 protected:
  using SlideRockLane::SlideRockLane;

  // The hops that follow end before the floor could make one larger, or make it slip: they are counted, and the block
  // rests. While the block falls back with accelerations alpha(t) >= slow, a hop that starts with rate omega returns with
  // omega exp(v/2) at most, v the variation of ln(alpha) within: the row of hops, each e times the one before, lasts
  // 2 omega/slow exp(V/2)/(1 - e) at most.
  bool dies_out() {
    const double omega = magnitude(omega_), square = omega * omega, span = bounds_.row * omega / h_;
    if (span > longest_row * bounds_.slow || square >= on(side_).told) return false;
    double push = 0, slow = bounds_.slow, growth = 1;  // growth: exp(V)
    if (m_ < last_ && !quiet_row(span, push, slow, growth)) return false;
    const double rotation = growth * square / (2 * slow);
    const double least = m_ < last_ ? 1e-3 : 1e-5;  // at the end of all the hops' time counts
    if (rotation > peak_rotation_ || rotation * c_.h > least * smaller(c_.left, c_.right)) return false;
    if (magnitude(xi_) + half_base_ * rotation * rotation > peak_slip_ + least_slip) return false;
    const double swing = 2 * c_.h * growth * square;
    if (!unnoticed(push, swing)) return false;
    if (m_ >= last_) {
      hop_to_end(omega);
    } else if (const double both = on(-1).kept * on(1).kept; both > 0) {  // in a steady field
      events_ += static_cast<int>(std::ceil(std::log(c_.rest_rotation / hop(side_, omega)) / std::log(both)));
    }
    return true;
  }

  // On a still floor.
  void hop_to_end(double omega) {
    for (int side = side_; omega * omega >= on(side).rests; side = -side) {
      hopping_ += 2 * omega * on(side).per_weight;
      omega *= on(side).kept;
      ++events_;
    }
  }

  // Hop by hop, while the hops are so small that, seen from the corner on which the block stands,
  //     theta'' = -beta (1 - theta^2/2) + kappa theta,  beta = (g b + a h)/J,  kappa = (g h - a b)/J,
  // to rest (true), or until something else may happen.
  bool hop_on() {
    double theta = 0, omega = magnitude(omega_);
    const double room = larger(peak_slip_ + least_slip - magnitude(xi_), 0) / half_base_;
    const double limit2 = 4 * smaller(smaller(bounds_.limit2, peak_rotation_ * peak_rotation_), room);
    const double pull = on(side_).pull(a_), square = omega * omega;
    if (!(square * square < limit2 * pull * pull) || !(bounds_.fast * c_.g * h_ * h_ < 1e-3)) return false;
    Hopping state = Hopping::on;
    for (int hops = 0; state == Hopping::on && !declined_;) state = hop_to_knot(limit2, theta, omega, hops);
    if (state == Hopping::ends) {
      stand(Mode::rest, 0);
      return true;
    }
    stand(Mode::rock, side_);
    theta_ = side_ * theta;
    omega_ = side_ * omega;
    const double sine = theta_ * (1 - theta * theta * (1.0 / 6)), lost = 0.5 * theta * theta;
    rx_ = c_.h * sine - arm(side_) * (1 - lost);
    ry_ = arm(side_) * sine + c_.h * (1 - lost);
    return false;
  }

 private:
  enum class Hopping { on, ends, leaves };

  // Is it certain that the floor does not tip the block while a row of hops lasts? span: the row's duration times slow,
  // in intervals. Sets the bounds.
  bool quiet_row(double span, double& push, double& slow, double& growth) const {
    const double unit = magnitude(c_.scale), *a = t_.acceleration.data() + m_;
    int end = static_cast<int>(span / slow) + 2;
    if (m_ + end > last_ || unit * bound_between(t_, m_, m_ + end) > bounds_.tips) return false;
    double sum = 0, variation = 0;
    push = unit * magnitude(a[0]);
    for (int j = 0; j < end;) {
      for (; j < end; ++j) {
        push = larger(push, unit * magnitude(a[j + 1]));
        sum += magnitude(a[j + 1] - a[j]);
      }
      slow = bounds_.slow - bounds_.slow1 * push;
      if (push > bounds_.tips || push > slips_at()) return false;
      variation = unit * bounds_.fast * sum / slow;
      const double need = span / slow * std::exp(0.5 * variation) + 2;
      if (!(need < longest_row) || m_ + need > last_) return false;
      end = static_cast<int>(need);
    }
    growth = std::exp(variation);
    return true;
  }

  // Small hops neither slip nor make a new peak of the acceleration while the floor's is `push` at most; more: what the
  // rotation adds to the forces.
  bool unnoticed(double push, double more) const {
    const double fx = bounds_.fx + bounds_.fx1 * push + more, lift = bounds_.lift + bounds_.lift1 * push + more;
    return fx * fx + lift * lift < force2_ && fx < c_.mu_s * (c_.g - lift);
  }

  // All hops up to the next knot.
  Hopping hop_to_knot(double limit2, double& theta, double& omega, int& hops) {
    const double a1 = next_floor(), rate = (a1 - a_) / (left_ * h_);
    const double push = larger(magnitude(a_), magnitude(a1));
    if (push > bounds_.tips || !unnoticed(push, 0.002 * c_.g)) return Hopping::leaves;
    for (double T = left_ * h_;;) {
      const Ground& ground = on(side_);
      const double pull = ground.pull(a_), low = smaller(pull, ground.pull(a1)), top = omega * omega + 2 * theta * pull;
      if (!(top * top < limit2 * low * low)) return Hopping::leaves;
      const double pull1 = ground.tip * rate, kappa = ground.kappa - ground.bend * a_, kappa1 = -ground.bend * rate;
      const HopSeries y = theta == 0 ? HopSeries(omega, pull, pull1, kappa, kappa1)
                                     : HopSeries(theta, omega, pull, pull1, kappa, kappa1);
      const double guess = y.parabola(), end = guess > 0.9 * T ? y.height(T) : 0;
      if (end > 0) {
        theta = end;
        omega = y.speed(T);
        next_knot();
        return a_ == a1 ? Hopping::on : Hopping::leaves;
      }
      const double t = y.landing(guess, T);
      if (!(t > 0 && t <= T)) return Hopping::leaves;
      event();
      const double falls = magnitude(y.speed(t));
      if (falls * falls >= ground.told) ++impacts_;
      omega = falls * ground.kept;
      theta = 0;
      side_ = -side_;
      omega_ = side_ * omega;
      a_ += rate * t;
      T -= t;
      left_ = T / h_;
      if (left_ < 1e-12) next_knot();
      if (omega * omega < on(side_).rests || (++hops % 8 == 0 && dies_out())) return Hopping::ends;
      if (left_ == 1) return Hopping::on;
    }
  }

  struct HopSeries {
    double c0, c1, c2, c3, c4, c5, c6;

    // pull: beta; pull1 and kappa1: rates.
    HopSeries(double theta, double omega, double pull, double pull1, double kappa, double kappa1)
        : c0(theta), c1(omega) {
      const double chord = 1 - 0.5 * c0 * c0;
      c2 = (1.0 / 2) * (kappa * c0 - pull * chord);
      c3 = (1.0 / 6) * (kappa * c1 + pull * c0 * c1 + kappa1 * c0 - pull1 * chord);
      const double square2 = c0 * c2 + 0.5 * c1 * c1, square3 = c0 * c3 + c1 * c2;
      c4 = (1.0 / 12) * (kappa * c2 + pull * square2 + kappa1 * c1 + pull1 * c0 * c1);
      c5 = (1.0 / 20) * (kappa * c3 + pull * square3 + kappa1 * c2 + pull1 * square2);
      const double square4 = c0 * c4 + c1 * c3 + 0.5 * c2 * c2;
      c6 = (1.0 / 30) * (kappa * c4 + pull * square4 + kappa1 * c3 + pull1 * square3);
    }
    // The same for theta = 0.
    HopSeries(double omega, double pull, double pull1, double kappa, double kappa1) : c0(0), c1(omega) {
      c2 = -0.5 * pull;
      c3 = (1.0 / 6) * (kappa * c1 - pull1);
      const double square2 = 0.5 * c1 * c1, square3 = c1 * c2, square4 = c1 * c3 + 0.5 * c2 * c2;
      c4 = (1.0 / 12) * (kappa * c2 + pull * square2 + kappa1 * c1);
      c5 = (1.0 / 20) * (kappa * c3 + pull * square3 + kappa1 * c2 + pull1 * square2);
      c6 = (1.0 / 30) * (kappa * c4 + pull * square4 + kappa1 * c3 + pull1 * square3);
    }
    double height(double t) const {
      const double t2 = t * t;
      return (c0 + t * c1) + t2 * ((c2 + t * c3) + t2 * ((c4 + t * c5) + t2 * c6));
    }
    double speed(double t) const {
      const double t2 = t * t;
      return (c1 + t * (2 * c2)) + t2 * ((3 * c3 + t * (4 * c4)) + t2 * (5 * c5 + t * (6 * c6)));
    }
    // First zero after the start, about.
    double parabola() const {
      if (c0 != 0) return (c1 + std::sqrt(c1 * c1 - 4 * c2 * c0)) / (-2 * c2);
      const double square = c2 * c2 - 4 * c3 * c1;
      return 2 * c1 / (std::sqrt(square > 0 ? square : 0.0) - c2);
    }
    // Exactly, from there on; beyond T: none.
    double landing(double t, double T) const {
      for (double step = t; magnitude(step) > 1e-6 * t && t > 0 && t < 2 * T;) {
        step = height(t) / speed(t);
        t -= step;
      }
      return t;
    }
  };
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
