#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include "odeint_sample.hpp"

namespace freestand::bench {
namespace {

namespace odeint = boost::numeric::odeint;

// Of order 8, without dense output: a cubic through both ends tells about where, a shorter step goes there.
template <std::size_t D>
struct Fehlberg78 {
  using X = Values<D>;
  static constexpr bool inside_is_exact = false;
  explicit Fehlberg78(double) {}
  odeint::runge_kutta_fehlberg78<X, double, X, double, odeint::array_algebra> stepper;

  template <class Rates>
  void step(Rates& rates, const X& x, const X& dx, double begin, X& next, X& dnext, double h) {
    stepper.do_step(rates, x, dx, begin, next, h);
    rates(next, dnext, begin + h);
  }
  X inside(double t, const X& x, const X& dx, double begin, const X& next, const X& dnext, double end) {
    const double h = end - begin, part = (t - begin) / h, rest = 1 - part;
    X at;
    for (std::size_t i = 0; i < D; ++i)
      at[i] = rest * rest * ((1 + 2 * part) * x[i] + part * h * dx[i]) +
              part * part * ((1 + 2 * rest) * next[i] - rest * h * dnext[i]);
    return at;
  }
};

}  // namespace

PeerResponse fehlberg78_peer(const Specimen& specimen, const Shaking& shaking, const OdeintSteps& steps) {
  return OdeintSample<Fehlberg78, RecordSteps>(specimen, {shaking, steps.per_knot}, steps).run();
}

}  // namespace freestand::bench
