// A block that slides in the plane of the floor, by inlined odeint dopri5: as many equal steps a knot as wanted, a slip ends where its
// velocity has turned by a right angle from what it was at the start of a step, and the floor does not drive it on.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/units.hpp"
#include "dopri5.hpp"
#include "illinois.hpp"
#include "peers.hpp"

namespace freestand::bench {
namespace {

constexpr double g = standard_gravity_mps2, watched_after_s = 60;

class PlaneSample {
  using X = std::array<double, 4>;  // u, w

 public:
  PlaneSample(const Specimen& specimen, const Shaking& shaking, const OdeintSteps& steps)
      : x_(shaking.motion->horizontal_mps2.data()),
        y_(shaking.motion->cross_mps2.data()),
        count_(static_cast<int>(shaking.motion->segments())),
        dt_(shaking.motion->knot_s[1]),
        scale_(shaking.scale),
        c_(std::cos(specimen.friction.axis_rad)),
        s_(std::sin(specimen.friction.axis_rad)),
        ratio_(specimen.friction.ratio_across),
        hold_(specimen.friction.mu_s * g),
        grip_(specimen.friction.mu_k * g),
        longest_(dt_ / steps.per_knot),
        root_s_(steps.root_s),
        last_(count_ + static_cast<int>(watched_after_s / dt_)) {}

  PeerResponse run() {
    read();
    while (knot_ < last_) {
      if (!wait()) break;
      slide();
    }
    response_.slip_m = std::sqrt(largest2_);
    return response_;
  }

 private:
  void read() {
    ax_ = ay_ = bx_ = by_ = 0;
    if (knot_ >= count_) return;
    const double *x = x_ + 2 * knot_, *y = y_ + 2 * knot_;
    ax_ = scale_ * (c_ * x[0] + s_ * y[0]), bx_ = scale_ * (c_ * x[1] + s_ * y[1]);
    ay_ = scale_ * (c_ * y[0] - s_ * x[0]), by_ = scale_ * (c_ * y[1] - s_ * x[1]);
  }
  void next_knot() {
    ++knot_;
    offset_ = 0;
    read();
  }
  double pull2(double t) const {
    const double x = ax_ + bx_ * t, y = (ay_ + by_ * t) / ratio_;
    return x * x + y * y;
  }

  // To where the floor pulls harder than friction holds. False: it never does.
  bool wait() {
    const double hold2 = hold_ * hold_;
    for (; knot_ < count_; next_knot()) {
      const double y = ay_ / ratio_, b = by_ / ratio_;
      if (pull2(offset_) > hold2) return ++response_.events, true;
      // The square of the pull bends upwards: it leaves its limit once at most, and not before the end if it is below there.
      if (pull2(dt_) <= hold2) continue;
      const double square = bx_ * bx_ + b * b, half = ax_ * bx_ + y * b, rest = ax_ * ax_ + y * y - hold2;
      offset_ = (std::sqrt(half * half - square * rest) - half) / square;
      return ++response_.events, true;
    }
    return false;
  }

  void rates(const X& x, X& dx, double t) const {
    const double qx = x[2], qy = ratio_ * x[3], size = std::sqrt(qx * qx + qy * qy);
    const double push = size > 0 ? grip_ / size : 0;
    dx = {x[2], x[3], -(ax_ + bx_ * t) - push * qx, -(ay_ + by_ * t) - push * ratio_ * qy};
  }
  // At rest friction does what it can against the floor's pull.
  void first_rates(X& dx) const {
    const double x = ax_ + bx_ * offset_, y = ay_ + by_ * offset_, pull = std::sqrt(pull2(offset_));
    const double kept = std::max(0.0, 1 - grip_ / pull);
    dx = {x_now_[2], x_now_[3], -kept * x, -kept * y};
  }

  void slide() {
    Dopri5<4> method;
    X dx, next, dnext;
    const auto rate = [this](const X& x, X& d, double t) { rates(x, d, t); };
    bool first = true;
    while (knot_ < last_) {
      const double left = dt_ - offset_, h = left < 1.001 * longest_ ? left : longest_, begin = offset_,
                   end = begin + h;
      if (first) {
        first_rates(dx);
      }
      method.step(rate, x_now_, dx, begin, next, dnext, h);
      const double turned = x_now_[2] * next[2] + x_now_[3] * next[3];
      if (!first && turned <= 0) {
        const auto along = [&](double t) {
          const X at = method.inside(t, x_now_, dx, begin, next, dnext, end);
          return x_now_[2] * at[2] + x_now_[3] * at[3];
        };
        const double speed2 = x_now_[2] * x_now_[2] + x_now_[3] * x_now_[3];
        const double when = illinois(along, begin, speed2, end, turned, root_s_);
        if (pull2(when) <= hold_ * hold_) {
          x_now_ = method.inside(when, x_now_, dx, begin, next, dnext, end);
          x_now_[2] = x_now_[3] = 0;
          offset_ = when;
          ++response_.events;
          return observe();
        }
      }
      first = false;
      x_now_ = next;
      observe();
      if (h < left) {
        offset_ = end;
        dx = dnext;
      } else {
        next_knot();
        if (knot_ <= count_) rates(x_now_, dx, 0);
      }
    }
  }
  void observe() { largest2_ = std::max(largest2_, x_now_[0] * x_now_[0] + x_now_[1] * x_now_[1]); }

  const double *x_, *y_;
  const int count_;
  const double dt_, scale_, c_, s_, ratio_, hold_, grip_, longest_, root_s_;
  const int last_;
  int knot_ = 0;
  double offset_ = 0, ax_ = 0, ay_ = 0, bx_ = 0, by_ = 0, largest2_ = 0;
  X x_now_{};
  PeerResponse response_;
};

}  // namespace

PeerResponse plane_peer(const Specimen& specimen, const Shaking& shaking, const OdeintSteps& steps) {
  return PlaneSample(specimen, shaking, steps).run();
}

}  // namespace freestand::bench
