#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>

#include "dopri5.hpp"
#include "odeint_sample.hpp"

namespace freestand::bench {
namespace {

namespace odeint = boost::numeric::odeint;

template <std::size_t D>
struct ControlledDopri5 {
  using X = Values<D>;
  using Stepper = odeint::runge_kutta_dopri5<X, double, X, double, odeint::array_algebra>;
  static constexpr bool inside_is_exact = true;
  using Control = odeint::controlled_runge_kutta<Stepper>;
  Control control;

  explicit ControlledDopri5(double tolerance) : control(typename Control::error_checker_type(tolerance, tolerance)) {}

  template <class Rates>
  bool try_step(Rates& rates, const X& x, const X& dx, double& t, X& next, X& dnext, double& h) {
    return control.try_step(std::ref(rates), x, dx, t, next, dnext, h) == odeint::success;
  }
  X inside(double t, const X& x, const X& dx, double begin, const X& next, const X& dnext, double end) {
    X at;
    control.stepper().calc_state(t, at, x, dx, begin, next, dnext, end);
    return at;
  }
};

}  // namespace

PeerResponse pulse_peer(const Specimen& specimen, const Shaking& shaking, const OdeintSteps& steps) {
  return OdeintSample<ControlledDopri5, PulseSteps>(specimen, PulseSteps(shaking), steps).run();
}

}  // namespace freestand::bench
