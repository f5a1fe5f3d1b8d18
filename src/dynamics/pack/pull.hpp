// A spring and a drag along the floor over a step, as the series ask for them: P = stiffness u + drag v, by which they slow the centre of
// mass, of the slip u of the middle of the base and v = u'. The block moves as if the floor were shaken by a + P.
#pragma once

#include "dynamics/pack/polynomials.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

struct NoPull {
  static constexpr bool pulls = false;
  // x + P at the end of the step, and within.
  template <class Real>
  static const Real& with_last(const Real& x) {
    return x;
  }
  template <class Real>
  static const Real& with(const Real& x, const Real&) {
    return x;
  }
};

// P in the units of the floor's acceleration a: coefficients 0 ... N.
template <int N, class Real>
class Pull : public Polynomials<Real> {
 public:
  static constexpr bool pulls = true;

  // drag: of v in the units of the series, v = w + lever_x r_y omega + lever_y r_x omega; u: at the start.
  Pull(const Real& stiffness, const Real& drag, const Real& lever_x, const Real& lever_y, const Real& u)
      : stiffness_(stiffness), drag_(drag), lever_x_(lever_x), lever_y_(lever_y), u_(u) {}

  // Coefficient k, once those before it have been asked for. Of a corner that sticks, from x of r_y omega and y of r_x omega; of one that
  // slips with w; of a block that slides flat.
  [[gnu::always_inline]] const Real& advance(int k, const Real& x, const Real& y) {
    return advance_flat(k, lever_x_ * x + lever_y_ * y);
  }
  [[gnu::always_inline]] const Real& advance_slipping(int k, const Real& w, const Real& x, const Real& y) {
    return advance_flat(k, w + lever_x_ * x + lever_y_ * y);
  }
  [[gnu::always_inline]] const Real& advance_flat(int k, const Real& v) {
    p_[k] = stiffness_ * u_ + drag_ * v;
    u_ = v * Real(1.0 / (k + 1));
    return p_[k];
  }

  const Real (&terms() const)[N + 1] { return p_; }
  Real with_last(const Real& x) const { return x + this->sum(p_); }
  Real with(const Real& x, const Real& at) const { return x + this->at(p_, at); }

 private:
  const Real stiffness_, drag_, lever_x_, lever_y_;
  Real u_;  // the next coefficient of u
  Real p_[N + 1];
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
