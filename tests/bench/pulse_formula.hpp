// The pulses of the benchmark as one writes them by hand, from their papers: a sine A sin(w t + phase) for A, B and the Cn, and the
// Ricker wavelet. Nothing is shared with the program's tables.
#pragma once

#include <algorithm>
#include <cmath>
#include <freestand/floor_motion.hpp>
#include <limits>

#include "base/units.hpp"

namespace freestand::bench {

// cos(phi) + (phi - (n + 1/2) pi) sin(phi) = 0  [KM05 5.5]: the floor ends where it began.
inline double phase_of_c(int n) {
  double phi = 0.07 * pi / n;
  for (int i = 0; i < 50; ++i) {
    const double from_end = phi - (n + 0.5) * pi;
    phi -= (std::cos(phi) + from_end * std::sin(phi)) / (from_end * std::cos(phi));
  }
  return phi;
}

class PulseFormula {
 public:
  // By the motion's name, which is one of A, B, C1 to C9, ricker.
  explicit PulseFormula(const Shaking& shaking)
      : amplitude_(shaking.scale), period_(shaking.stretch), w_(2 * pi / shaking.stretch) {
    const std::string& name = shaking.motion->name;
    ricker_ = name == "ricker";
    if (name[0] == 'B') phase_ = pi / 2;
    if (name[0] == 'C') {
      static const double phases[] = {phase_of_c(1), phase_of_c(2), phase_of_c(3), phase_of_c(4), phase_of_c(5),
                                      phase_of_c(6), phase_of_c(7), phase_of_c(8), phase_of_c(9)};
      const int n = name[1] - '0';
      phase_ = pi / 2 + phases[n - 1];
      periods_ = n + 0.5 - phases[n - 1] / pi;
    }
    if (ricker_) periods_ = 4;
  }

  double duration_s() const { return periods_ * period_; }

  double at(double t) const {
    if (!ricker_) return amplitude_ * std::sin(w_ * t + phase_);
    const double x = pi * (t / period_ - 2), z = x * x;
    return amplitude_ * (1 - 2 * z) * std::exp(-z);
  }

  // When |a| reaches `level`, from t on; infinite: never.
  double reaches(double level, double t) const {
    if (std::abs(at(t)) > level) return t;
    const double part = level / std::abs(amplitude_);
    if (!(part < 1)) return std::numeric_limits<double>::infinity();
    if (!ricker_) {
      const double angle = std::asin(part), half = std::floor((w_ * t + phase_) / pi) * pi;
      const double when = (half + angle - phase_) / w_;
      return when >= t ? when : when + pi / w_;
    }
    const double step = period_ / 32;
    for (; t < duration_s(); t += step)
      if (std::abs(at(t + step)) > level) return bisect(level, t, t + step);
    return std::numeric_limits<double>::infinity();
  }

  double largest_from(double t) const { return t > 0 ? std::abs(at(t)) : std::abs(amplitude_); }

 private:
  double bisect(double level, double quiet, double loud) const {
    for (double middle; (middle = 0.5 * (quiet + loud)) > quiet && middle < loud;)
      (std::abs(at(middle)) > level ? loud : quiet) = middle;
    return loud;
  }

  double amplitude_, period_, w_, phase_ = 0, periods_ = 1;
  bool ricker_ = false;
};

}  // namespace freestand::bench
