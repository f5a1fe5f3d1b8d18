// The damped oscillator u'' + 2 z w u' + w^2 u = -a(t) under polynomial input, solved in closed form.
#pragma once

#include <vector>

#include "motion/polynomial.hpp"

namespace freestand::motion {

struct OscillatorState {
  double u = 0, v = 0;  // displacement and velocity
};

class Oscillator {
 public:
  // w > 0 [rad/s], 0 <= z < 1.
  Oscillator(double w, double z) : w_(w), z_(z) {}

  // State after `length` under input a, and the highest |u| on the way, which raises `peak` where it is higher.
  OscillatorState advance(const Polynomial& a, double length, OscillatorState from, double& peak);

  // That state alone, in one step of any length.
  OscillatorState after(const Polynomial& a, double length, OscillatorState from);

  // Highest |u| of the free vibration from this state on.
  double free_peak(OscillatorState from) const;

 private:
  // Linear map of one substep: state(t) = free * state(0) + forced * (coefficients of a), t since the segment's start.
  struct Map {
    double uu, uv, vu, vv;
    std::array<OscillatorState, Polynomial::max_degree + 1> forced;
  };
  Map map_at(double t, int degree) const;
  OscillatorState power_response(int k, double t, const Map& free) const;
  OscillatorState apply(const Map& map, const Polynomial& a, OscillatorState from) const;
  double peak_between(const Polynomial& a, double offset, double step, OscillatorState from) const;

  double w_, z_;
  double length_ = -1;  // of the segment the maps are for
  int degree_ = -1;
  std::vector<Map> maps_;     // at the end of each substep
  double whole_length_ = -1;  // of the segment whole_ is for
  int whole_degree_ = -1;
  Map whole_ = {};  // at the end of a segment
};

}  // namespace freestand::motion
