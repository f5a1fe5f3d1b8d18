// One sample of model bouc_wen, scalar: any floor motion, vertical shaking, histories.
#include "dynamics/bouc_wen.hpp"

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "dynamics/bouc_wen_life.hpp"
#include "dynamics/roots.hpp"

namespace freestand::dynamics {
namespace {

constexpr int N = max_root_order;

class BoucWenIntegrator {
 public:
  BoucWenIntegrator(const Setup& setup, const Settings& settings, History* history)
      : life_(setup, settings, history), contact_(life_.contact) {}

  Response run() {
    while (!life_.finished()) step();
    return life_.result();
  }

 private:
  using Series = dynamics::Series<double, N>;

  void step() {
    const auto floor = life_.cursor.local<N>();
    double h = life_.time_left();
    const Series force = holding_force(floor, h);
    if (life_.direction == 0) {
      const int towards = direction(floor, force);
      if (towards == 0) return life_.stand();
      life_.set_out(towards);
    }
    switch (life_.phase) {
      case ContactPhase::elastic:
        return move_on<ContactPhase::elastic>(floor, force, h);
      case ContactPhase::yielding:
        return move_on<ContactPhase::yielding>(floor, force, h);
      case ContactPhase::returning:
        return move_on<ContactPhase::returning>(floor, force, h);
      case ContactPhase::sliding:
        return move_on<ContactPhase::sliding>(floor, force, h);
    }
  }

  // G about the present instant; zero while g' is negative. Ends the step where g' changes its sign.
  Series holding_force(const Floor<double, N>& floor, double& h) const {
    if (!life_.vertical) {
      Series force = Series::zero();
      force[0] = contact_.strength * floor.g[0];
      return force;
    }
    const ZeroTolerance zero{0, 1e-11 * life_.gravity};
    const bool presses = sign_after(floor.g, zero) > 0;
    double tau = 0;
    if (first_root(scaled(presses ? 1.0 : -1.0, floor.g), std::min(h, 1e3), zero, tau) && tau > 0) h = std::min(h, tau);
    return presses ? scaled(contact_.strength, floor.g) : Series::zero();
  }

  // Where the block is about to move that does not move now; 0: nowhere.
  int direction(const Floor<double, N>& floor, const Series& force) const {
    BoucWenArc<N> arc;
    arc.v[0] = 0;
    arc.zeta[0] = life_.zeta;
    fill<ContactPhase::elastic>(arc, floor.a, force, !life_.vertical, contact_);
    return sign_after(arc.v, {1, life_.force_zero()});
  }

  template <ContactPhase phase>
  void move_on(const Floor<double, N>& floor, const Series& force, double h) {
    const double s = life_.direction;
    BoucWenArc<N> arc;
    arc.v[0] = s * life_.v;
    arc.zeta[0] = s * life_.zeta;
    arc.q[0] = life_.q;
    fill<phase>(arc, scaled(s, floor.a), force, !life_.vertical, contact_);

    h = std::min(h, phase == ContactPhase::sliding ? stopping_time(arc) : accurate_step(arc, force[0]));
    if (phase == ContactPhase::yielding || phase == ContactPhase::returning) h = converging_step(arc, h);
    double tau = h;
    const bool turns = first_root(arc.v, h, {1, life_.force_zero()}, tau);
    bool passes = false;
    if constexpr (phase == ContactPhase::elastic || phase == ContactPhase::returning) {
      Series below = scaled(-1.0, arc.zeta);
      below[0] += phase == ContactPhase::elastic ? contact_.linear : -contact_.linear;
      double at = tau;
      passes = first_root(below, tau, {2, life_.force_zero() / contact_.yield}, at) && at < tau;
      if (passes) tau = at;
    }
    const bool at_knot = !passes && !turns && h == life_.cursor.left();
    life_.arrive(arc, floor, tau);
    if (passes) {
      life_.pass();
    } else if (turns) {
      life_.turn();
    } else if (phase == ContactPhase::yielding && 1 - life_.q <= contact_.saturated) {
      life_.saturate();
    }
    if (at_knot) life_.next_segment();
  }

  // Largest step at which the last terms of the series are within the tolerance.
  double accurate_step(const BoucWenArc<N>& arc, double force) const {
    const double rate = std::sqrt(std::max(force, 1e-6 * life_.gravity) / contact_.yield);
    const double last = std::max(std::abs(arc.zeta[N]), std::abs(arc.v[N]) / (rate * contact_.yield));
    return last > 0 ? std::pow(life_.settings.tolerance / last, 1.0 / N) : 1 / rate;
  }

  // The series of q are, at worst, those of exp(n ln zeta), of which order N sees no more than this.
  double converging_step(const BoucWenArc<N>& arc, double h) const {
    const double fastest = arc.v[0] + 0.5 * std::abs(arc.v[1]) * h;
    return std::min(h, 6 * contact_.yield * std::abs(arc.zeta[0]) / (contact_.n * fastest));
  }

  // Sliding is exact over any time; twice the time to the stop is enough, where the floor is still.
  double stopping_time(const BoucWenArc<N>& arc) const {
    return life_.cursor.motion_over() && arc.v[1] < 0 ? -2 * arc.v[0] / arc.v[1]
                                                      : std::numeric_limits<double>::infinity();
  }

  BoucWenLife life_;
  const BoucWenContact& contact_;
};

}  // namespace

bool admissible_bouc_wen(const Setup& setup, const Settings& settings) {
  const auto& [specimen, shaking, floor] = setup;
  const BoucWen& law = specimen.bouc_wen;
  for (const double size : {law.yield_displacement_m, law.gamma, law.gamma + law.beta, shaking.stretch,
                            settings.tolerance, floor.gravity_factor})
    if (!(size > 0) || !std::isfinite(size)) return false;
  return law.exponent >= 1 && specimen.friction.mu_k >= 0 && std::isfinite(specimen.friction.mu_k) &&
         std::isfinite(law.exponent) && std::abs(law.beta) <= law.gamma && settings.free_vibration_s >= 0 &&
         std::isfinite(settings.free_vibration_s) && std::isfinite(floor.push_mps2) && std::isfinite(shaking.scale) &&
         std::isfinite(shaking.vertical_scale) && shaking.motion && shaking.motion->degree >= 0 &&
         shaking.motion->degree <= max_floor_degree;
}

Response respond_bouc_wen(const Setup& setup, const Settings& settings, History* history) {
  if (!admissible_bouc_wen(setup, settings)) return Response{.outcome = Outcome::not_finite};
  return BoucWenIntegrator(setup, settings, history).run();
}

}  // namespace freestand::dynamics
