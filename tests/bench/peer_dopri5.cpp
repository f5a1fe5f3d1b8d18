#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>

#include "odeint_sample.hpp"

namespace freestand::bench {
namespace {

namespace odeint = boost::numeric::odeint;

template <std::size_t D>
struct Dopri5 {
  using X = Values<D>;
  static constexpr bool inside_is_exact = true;
  odeint::runge_kutta_dopri5<X, double, X, double, odeint::array_algebra> stepper;

  template <class Rates>
  void step(Rates& rates, const X& x, const X& dx, double begin, X& next, X& dnext, double h) {
    stepper.do_step(rates, x, dx, begin, next, dnext, h);
  }
  X inside(double t, const X& x, const X& dx, double begin, const X& next, const X& dnext, double end) {
    X at;
    stepper.calc_state(t, at, x, dx, begin, next, dnext, end);
    return at;
  }
};

}  // namespace

PeerResponse dopri5_peer(const Specimen& specimen, const Shaking& shaking, const OdeintSteps& steps) {
  return OdeintSample<Dopri5>(specimen, shaking, steps).run();
}

}  // namespace freestand::bench
