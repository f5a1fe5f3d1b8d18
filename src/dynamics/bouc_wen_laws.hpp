// Effects on a Bouc-Wen contact: the friction factor F, the added force X, the share M of the mass that moves with the
// block, and states of the effects' own.
//
//   M (u'' + a) = X - F G zeta
//
// For the laws sigma is the direction against which friction acts, sgn(zeta); the slip speed is |u'|, as in the law of
// sliding bearings that [KM05 6.27] comes from; the path is that of u_p.
#pragma once

#include <array>

#include "base/units.hpp"
#include "dynamics/bouc_wen_contact.hpp"
#include "dynamics/kinks.hpp"
#include "dynamics/laws.hpp"

namespace freestand::dynamics {

// What the laws bring along.
struct BoucWenLawState : Kinks {
  std::array<double, max_states> states{};
  int side = 0;  // sgn(zeta), or where zeta is about to go
};

// Where a step starts.
struct BoucWenStart {
  double time = 0;
  double slip = 0, path = 0;  // u_p and its path [m]
  int direction = 0;
  bool returning = false;  // u_p goes against the motion
};

// The hold of fill(), with laws; also the series of the states and of the kinks' arguments.
template <int N>
class BoucWenLawHold {
 public:
  // force: G [m/s2]; g: g' [m/s2].
  BoucWenLawHold(const Laws& laws, const BoucWenLawState& state, const BoucWenStart& start,
                 const BoucWenContact& contact, const BoucWenArc<N>& arc, const Series<double, N>& force,
                 const Series<double, N>& g)
      : laws_(laws), state_(state), start_(start), contact_(contact), arc_(arc), force_(force) {
    for (int input = 0; input < input_count; ++input) values_[input] = Series<double, N>::zero();
    for (int i = 0; i < laws.states; ++i) value(Input::state, i)[0] = state.states[static_cast<std::size_t>(i)];
    value(Input::t)[0] = start.time;
    value(Input::t)[1] = 1;
    value(Input::sigma)[0] = state.side;
    const bool presses = force[0] > 0 || force[1] > 0;
    if (presses) value(Input::normal) = scaled(1 / standard_gravity_mps2, g);
    factor_ = Series<double, N>::zero();
    factor_[0] = 1;
  }

  double operator()(int k) {
    const double s = start_.direction;
    const double slip = arc_.slip[k];
    value(Input::u)[k] = s * (slip + contact_.yield * arc_.zeta[k]) + (k == 0 ? start_.slip : 0.0);
    value(Input::v)[k] = s * arc_.v[k];
    value(Input::path)[k] = (start_.returning ? -slip : slip) + (k == 0 ? start_.path : 0.0);
    value(Input::speed)[k] = arc_.v[0] < 0 ? 0.0 : arc_.v[k];
    laws_.tape.advance(input_count, laws_.friction_end, k, state_.sides, values_);
    const double added = laws_.force < 0 ? 0.0 : s * values_[laws_.force][k];
    if (laws_.friction >= 0) factor_[k] = values_[laws_.friction][k];
    grip_[k] = product(factor_, force_, k);
    const double hold = (product(grip_, arc_.zeta, k) - added) / laws_.carried_mass;
    value(Input::acceleration)[k] = -s * hold;
    laws_.tape.advance(laws_.friction_end, laws_.tape.size(), k, state_.sides, values_);
    if (k < N)
      for (int i = 0; i < laws_.states; ++i) value(Input::state, i)[k + 1] = values_[laws_.rate[i]][k] / (k + 1);
    return hold;
  }

  // Argument of a kink, positive on its present side; call it after fill().
  Series<double, N> kink(int j) const { return kink_argument(laws_.tape, state_, j, values_); }

  // The same at the start, to order 0, whether it was met there or not.
  double kink_now(int j) const {
    return (state_.sides >> j & 1U ? -1.0 : 1.0) * values_[laws_.tape.kink_argument(j)][0];
  }

  double state_rate(int i) const { return values_[static_cast<int>(Input::state) + i][1]; }
  double state_at(int i, double tau) const { return values_[static_cast<int>(Input::state) + i].at(tau); }
  // Last term of the states' series, over the lengths and speeds given.
  double last_state(double length) const {
    double most = 0;
    for (int i = 0; i < laws_.states; ++i)
      most = std::fmax(most, std::fabs(values_[static_cast<int>(Input::state) + i].c[N]) / length);
    return most;
  }

 private:
  Series<double, N>& value(Input input, int offset = 0) { return values_[static_cast<int>(input) + offset]; }

  const Laws& laws_;
  const BoucWenLawState& state_;
  const BoucWenStart start_;
  const BoucWenContact& contact_;
  const BoucWenArc<N>& arc_;
  const Series<double, N>& force_;
  Series<double, N> values_[max_nodes];
  Series<double, N> factor_, grip_;
};

}  // namespace freestand::dynamics
