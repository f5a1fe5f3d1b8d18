// Boost.odeint's runge_kutta_dopri5 as the peers step with it (odeint_sample.hpp says what a method has).
#pragma once

#include <array>
#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>

namespace freestand::bench {
namespace {

template <std::size_t D>
struct Dopri5 {
  using X = std::array<double, D>;
  static constexpr bool inside_is_exact = true;
  explicit Dopri5(double = 0) {}
  boost::numeric::odeint::runge_kutta_dopri5<X, double, X, double, boost::numeric::odeint::array_algebra> stepper;

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
}  // namespace freestand::bench
