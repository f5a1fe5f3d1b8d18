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
    const double omega = magnitude(omega_), shorter = smaller(c_.left, c_.right), h2 = c_.h * c_.h;
    const double rim = larger(c_.left, c_.right);
    const double small = c_.k2 + h2 + shorter * shorter, large = c_.k2 + h2 + rim * rim;
    const double ratio = kept(side_, -side_), span = 2 * omega / (h_ * (1 - larger(ratio, kept(-side_, side_))));
    if (span * large > longest_row * shorter * c_.g || hop(side_, omega) >= c_.told_rotation) return false;
    double push = 0, slow = shorter * c_.g / large, variation = 0, growth = 1;  // growth: exp(V)
    if (m_ < last_) {
      const double unit = magnitude(c_.scale), *a = t_.acceleration.data() + m_;
      double sum = 0;
      push = unit * magnitude(a[0]);
      for (int j = 0, end = static_cast<int>(span / slow) + 2; j < end;) {
        for (; j < end; ++j) {
          push = larger(push, unit * magnitude(a[j + 1]));
          sum += magnitude(a[j + 1] - a[j]);
        }
        slow = (shorter * c_.g - c_.h * push) / large;
        if (!(slow > 0.02 * shorter * c_.g / large) || push > slips_at()) return false;
        variation = unit * c_.h * sum / (small * slow);
        const double need = span / slow * std::exp(0.5 * variation) + 2;
        if (!(need < longest_row) || m_ + need > last_) return false;
        end = static_cast<int>(need);
      }
      growth = std::exp(variation);
    }
    const double rotation = growth * omega * omega / (2 * slow);
    const double least = m_ < last_ ? 1e-3 : 1e-5;  // at the end of all the hops' time counts
    if (rotation > peak_rotation_ || rotation > least * shorter / c_.h) return false;
    if (magnitude(xi_) + half_base_ * rotation * rotation > peak_slip_ + least_slip) return false;
    const double fast = (rim * c_.g + c_.h * push) / small, swing = 2 * c_.h * growth * omega * omega;
    const double fx = push * magnitude(1 - h2 / large) + c_.h * rim * c_.g / small + swing, fy = rim * fast + swing;
    if (fx * fx + fy * fy > force2_ || fx > c_.mu_s * (c_.g - fy)) return false;
    if (m_ >= last_) {
      hop_to_end(omega);
    } else if (const double both = ratio * kept(-side_, side_); both > 0) {  // in a steady field
      events_ += static_cast<int>(std::ceil(std::log(c_.rest_rotation / hop(side_, omega)) / std::log(both)));
    }
    return true;
  }

  // On a still floor.
  void hop_to_end(double omega) {
    const double keeps[] = {kept(-1, 1), kept(1, -1)}, per_pull[] = {1 / ground(-1).weight, 1 / ground(1).weight};
    for (int side = side_ > 0; omega * omega * per_pull[side] >= 2 * c_.rest_rotation; side = 1 - side) {
      hopping_ += 2 * omega * per_pull[side];
      omega *= keeps[side];
      ++events_;
    }
  }

  // Hop by hop, while the hops are so small that, seen from the corner on which the block stands,
  //     theta'' = -beta (1 - theta^2/2) + kappa theta,  beta = (g b + a h)/J,  kappa = (g h - a b)/J,
  // to rest (true), or until something else may happen.
  bool hop_on() {
    const Ground grounds[] = {ground(-1), ground(1)};
    Ground on = grounds[side_ > 0];
    double theta = 0, omega = magnitude(omega_);
    if (!(omega * omega < 2 * on.limit * on.pull(a_)) || !(on.kappa * h_ * h_ < 1e-3)) return false;
    for (int hops = 0; !declined_;) {
      const double a1 = next_floor(), rate = (a1 - a_) / (left_ * h_);
      if (!hops_unnoticed(a_, a1)) break;
      const HopSeries y(theta, omega, on.pull(a_), on.tip * rate, on.kappa - on.bend * a_, -on.bend * rate);
      const double top = omega * omega + 2 * theta * y.pull, T = left_ * h_, end = y.height(T);
      if (!(top < 2 * on.limit * smaller(y.pull, on.pull(a1)))) break;
      if (end > 0) {
        theta = end;
        omega = y.speed(T);
        next_knot();
        if (a_ != a1) break;
        continue;
      }
      const double t = y.landing(T);
      if (!(t > 0 && t <= T)) break;
      event();
      omega = magnitude(y.speed(t));
      if (omega * omega >= on.told) ++impacts_;
      omega *= on.kept;
      theta = 0;
      side_ = -side_;
      on = grounds[side_ > 0];
      omega_ = side_ * omega;
      a_ += rate * t;
      left_ -= t / h_;
      if (left_ < 1e-12) next_knot();
      if (omega * omega < on.rests || (++hops % 4 == 0 && dies_out())) {
        stand(Mode::rest, 0);
        return true;
      }
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
  // What hops on a corner need.
  struct Ground {
    double weight, tip, kappa, bend;  // beta = weight + tip a, kappa less bend a
    double limit;                     // of the rotation, for the equation to hold and no peak to be new
    double kept, told, rests;         // squared rates: of an impact that counts, and of rest

    double pull(double a) const { return weight + tip * a; }
  };
  Ground ground(int side) const {
    const double b = magnitude(arm(side)), per_inertia = 1 / (c_.k2 + c_.h * c_.h + b * b),
                 weight = c_.g * b * per_inertia;
    const double room = larger(peak_slip_ + least_slip - magnitude(xi_), 0);
    const double limit = smaller(smaller(small_rotation * b / c_.h, peak_rotation_), std::sqrt(room / half_base_));
    return {weight, side * c_.h * per_inertia, c_.g * c_.h * per_inertia,     side * b * per_inertia,
            limit,  kept(side, -side),         2 * weight * c_.told_rotation, 2 * weight * c_.rest_rotation};
  }

  // Neither does the floor tip the block, nor slips it, nor is there a new peak of the acceleration, while the floor's goes
  // from a to b and the hops are small.
  bool hops_unnoticed(double a, double b) const {
    const double rim = larger(c_.left, c_.right), shorter = smaller(c_.left, c_.right), h2 = c_.h * c_.h;
    const double most = larger(magnitude(a), magnitude(b)), more = 0.002 * c_.g;
    if (!(most * c_.h < 0.98 * shorter * c_.g)) return false;
    const double per_inertia = 1 / (c_.k2 + h2 + shorter * shorter);
    const double fx = most * magnitude(1 - h2 * per_inertia) + c_.g * c_.h * rim * per_inertia + more;
    const double lift = rim * (c_.g * rim + most * c_.h) * per_inertia + more;
    return fx * fx + lift * lift < force2_ && fx < c_.mu_s * (c_.g - lift);
  }

  struct HopSeries {
    double c0, c1, c2, c3, c4, c5, c6, pull;

    // pull: beta; pull1 and kappa1: rates.
    HopSeries(double theta, double omega, double beta, double pull1, double kappa, double kappa1)
        : c0(theta), c1(omega), pull(beta) {
      const double chord = 1 - 0.5 * c0 * c0;
      c2 = (1.0 / 2) * (kappa * c0 - pull * chord);
      c3 = (1.0 / 6) * (kappa * c1 + pull * c0 * c1 + kappa1 * c0 - pull1 * chord);
      const double square2 = c0 * c2 + 0.5 * c1 * c1, square3 = c0 * c3 + c1 * c2;
      c4 = (1.0 / 12) * (kappa * c2 + pull * square2 + kappa1 * c1 + pull1 * c0 * c1);
      c5 = (1.0 / 20) * (kappa * c3 + pull * square3 + kappa1 * c2 + pull1 * square2);
      const double square4 = c0 * c4 + c1 * c3 + 0.5 * c2 * c2;
      c6 = (1.0 / 30) * (kappa * c4 + pull * square4 + kappa1 * c3 + pull1 * square3);
    }
    double height(double t) const { return c0 + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * (c5 + t * c6))))); }
    double speed(double t) const {
      return c1 + t * (2 * c2 + t * (3 * c3 + t * (4 * c4 + t * (5 * c5 + t * (6 * c6)))));
    }
    // First zero after the start; the hop is over before T.
    double landing(double T) const {
      double t;
      if (c0 == 0) {
        const double square = c2 * c2 - 4 * c3 * c1;
        t = 2 * c1 / (std::sqrt(square > 0 ? square : 0.0) - c2);
      } else {
        t = (c1 + std::sqrt(c1 * c1 - 4 * c2 * c0)) / (-2 * c2);
      }
      for (double step = T; magnitude(step) > 1e-7 * T && t > 0 && t < 2 * T;) {
        step = height(t) / speed(t);
        t -= step;
      }
      return t;
    }
  };
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
