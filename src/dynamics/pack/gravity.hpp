// Effective gravity g' = g + v over a step, as the series ask for it: a plain number where it stays, straight in time where
// the floor shakes vertically. Time x = 0 ... 1 from the start of the step to its end.
#pragma once

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

template <class Real>
struct Straight {
  Real start, rate;
  Straight operator*(const Real& factor) const { return {start * factor, rate * factor}; }
};

// Coefficient k of g'.
template <class Real>
Real coefficient(const Real& g, int k) {
  return k == 0 ? g : Real(0.0);
}
template <class Real>
Real coefficient(const Straight<Real>& g, int k) {
  return k == 0 ? g.start : k == 1 ? g.rate : Real(0.0);
}
// Coefficient k of y g'.
template <class Real>
Real times(const Real* y, int k, const Real& g) {
  return y[k] * g;
}
template <class Real>
Real times(const Real* y, int k, const Straight<Real>& g) {
  return k == 0 ? y[0] * g.start : y[k] * g.start + y[k - 1] * g.rate;
}
template <class Real>
Real value_at(const Real& g, const Real&) {
  return g;
}
template <class Real>
Real value_at(const Straight<Real>& g, const Real& x) {
  return g.start + g.rate * x;
}
template <class Real>
Real at_start(const Real& g) {
  return g;
}
template <class Real>
Real at_start(const Straight<Real>& g) {
  return g.start;
}
template <class Real>
Real at_end(const Real& g) {
  return g;
}
template <class Real>
Real at_end(const Straight<Real>& g) {
  return g.start + g.rate;
}

// Vertical acceleration of a floor that has none.
struct Level {
  template <class Real>
  Level operator*(const Real&) const {
    return {};
  }
};

// y - v, and y' less the rate of v; y + that rate.
template <class Real>
Real less_at(const Real& y, const Level&, const Real&) {
  return y;
}
template <class Real>
Real less_at(const Real& y, const Straight<Real>& v, const Real& x) {
  return y - (v.start + v.rate * x);
}
template <class Real>
Real less_rate(const Real& y, const Level&) {
  return y;
}
template <class Real>
Real less_rate(const Real& y, const Straight<Real>& v) {
  return y - v.rate;
}
template <class Real>
Real plus_rate(const Real& y, const Level&) {
  return y;
}
template <class Real>
Real plus_rate(const Real& y, const Straight<Real>& v) {
  return y + v.rate;
}

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
