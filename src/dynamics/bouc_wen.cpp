// One sample of model bouc_wen, scalar: any floor motion, vertical shaking, histories.
#include "dynamics/bouc_wen.hpp"

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "dynamics/bouc_wen_trajectory.hpp"
#include "dynamics/integration.hpp"
#include "dynamics/roots.hpp"

namespace freestand::dynamics {
namespace {

constexpr int N = max_root_order;

class BoucWenIntegrator {
 public:
  BoucWenIntegrator(const Setup& setup, const Settings& settings, History* history)
      : trajectory_(setup, settings, history),
        contact_(trajectory_.contact),
        least_progress_s_(
            std::min(0.1 / setup.specimen.block.p_radps(),
                     100 * std::sqrt(contact_.yield / std::max(contact_.strength * trajectory_.gravity, 1e-6)))) {}

  Response run() {
    while (!trajectory_.finished()) {
      step();
      if (trajectory_.watch.stalls(trajectory_.cursor.time(), least_progress_s_)) trajectory_.give_up();
    }
    return trajectory_.result();
  }

 private:
  using Series = dynamics::Series<double, N>;

  void step() {
    const auto floor = trajectory_.cursor.local<N>();
    double h = trajectory_.time_left();
    const Series force = holding_force(floor, h);
    if (trajectory_.direction == 0 && !set_out(floor, force, h)) return;
    switch (trajectory_.phase) {
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
    if (!trajectory_.vertical) {
      Series force = Series::zero();
      force[0] = contact_.strength * floor.g[0];
      return force;
    }
    const ZeroTolerance zero{0, 1e-11 * trajectory_.gravity};
    const bool presses = sign_after(floor.g, zero) > 0;
    double tau = 0;
    if (first_root(scaled(presses ? 1.0 : -1.0, floor.g), std::min(h, 1e3), zero, tau) && tau > 0) h = std::min(h, tau);
    return presses ? scaled(contact_.strength, floor.g) : Series::zero();
  }

  // The arc of the present motion, by the law of the contact or with those of effects besides; calls use(arc, hold), hold
  // null without effects.
  template <ContactPhase phase, class Use>
  void with_arc(const Floor<double, N>& floor, const Series& force, Use&& use) const {
    const double s = trajectory_.direction;
    BoucWenArc<N> arc;
    arc.v[0] = s * trajectory_.v;
    arc.zeta[0] = s * trajectory_.zeta;
    arc.q[0] = trajectory_.q;
    arc.slip[0] = 0;
    const Series push = scaled(s, floor.a);
    if (trajectory_.laws) {
      const BoucWenStart start{trajectory_.cursor.time(), trajectory_.slip, trajectory_.path(), trajectory_.direction,
                               phase == ContactPhase::returning};
      BoucWenLawHold<N> hold(*trajectory_.laws, trajectory_.law_state, start, contact_, arc, force, floor.g);
      fill<phase>(arc, push, contact_, hold);
      use(arc, &hold);
    } else {
      const bool constant = !trajectory_.vertical;
      fill<phase>(arc, push, contact_,
                  [&](int k) { return constant ? force[0] * arc.zeta[k] : product(force, arc.zeta, k); });
      use(arc, static_cast<const BoucWenLawHold<N>*>(nullptr));
    }
  }

  // From a standstill. False: nothing moves, up to the next knot or kink of a law.
  bool set_out(const Floor<double, N>& floor, const Series& force, double h) {
    trajectory_.direction = 1;
    trajectory_.law_state.side = (trajectory_.zeta > 0) - (trajectory_.zeta < 0);
    int towards = 0, kink = -1;
    with_arc<ContactPhase::elastic>(floor, force, [&](const auto& arc, const auto* hold) {
      towards = sign_after(arc.v, {1, trajectory_.force_zero()});
      if (towards == 0 && hold) kink = first_kink(*hold, h);
    });
    trajectory_.direction = 0;
    if (towards != 0) {
      trajectory_.set_out(towards);
      return true;
    }
    trajectory_.stand(h);
    if (kink >= 0) trajectory_.law_state.turn_kink(kink);
    return false;
  }

  // The first kink of a law within tau, which becomes its time; -1: none.
  int first_kink(const BoucWenLawHold<N>& hold, double& tau) const {
    int first = -1;
    for (int j = 0; j < trajectory_.laws->tape.kink_count(); ++j) {
      double at = tau;
      if (trajectory_.law_state.watches(j) &&
          first_root(past_instant(hold.kink(j), trajectory_.instant_s), tau, {0, 0.0}, at) && (first < 0 || at < tau))
        first = j, tau = at;
    }
    return first;
  }

  template <ContactPhase phase>
  void move_on(const Floor<double, N>& floor, const Series& force, double h) {
    with_arc<phase>(floor, force,
                    [&](const auto& arc, const auto* hold) { advance<phase>(floor, force, h, arc, hold); });
  }

  enum class What { none, turns, passes, crosses_zero, kink };

  template <ContactPhase phase>
  void advance(const Floor<double, N>& floor, const Series& force, double h, const BoucWenArc<N>& arc,
               const BoucWenLawHold<N>* hold) {
    const bool exact = phase == ContactPhase::sliding && !hold;
    h = std::min(h, exact ? stopping_time(arc) : accurate_step(arc, force[0], hold));
    if (phase == ContactPhase::yielding || phase == ContactPhase::returning) h = converging_step(arc, h);
    double tau = h;
    What what = What::none;
    const auto watch = [&](What event, const Series& series, ZeroTolerance zero) {
      double at = tau;
      if (first_root(series, tau, zero, at) && (what == What::none || at < tau)) what = event, tau = at;
    };
    watch(What::turns, arc.v, {1, trajectory_.force_zero()});
    if constexpr (phase == ContactPhase::elastic || phase == ContactPhase::returning) {
      const ZeroTolerance zero{2, trajectory_.force_zero() / contact_.yield};
      Series below = scaled(-1.0, arc.zeta);
      if (hold && below[0] > 0) watch(What::crosses_zero, below, zero);
      below[0] += phase == ContactPhase::elastic ? contact_.linear : -contact_.linear;
      watch(What::passes, below, zero);
    }
    const int kink = hold ? first_kink(*hold, tau) : -1;
    if (kink >= 0) what = What::kink;
    const bool at_knot = what == What::none && h == trajectory_.cursor.left();
    if (hold)
      for (int i = 0; i < trajectory_.laws->states; ++i)
        trajectory_.law_state.states[static_cast<std::size_t>(i)] = hold->state_at(i, tau);
    trajectory_.arrive(arc, floor, tau);
    resolve<phase>(what, kink);
    if (at_knot) trajectory_.next_segment();
  }

  template <ContactPhase phase>
  void resolve(What what, int kink) {
    if (what == What::passes) return trajectory_.pass();
    if (what == What::turns) return trajectory_.turn();
    if (what == What::crosses_zero) {
      trajectory_.zeta = 0;
      trajectory_.law_state.side = trajectory_.direction;
    }
    if (what == What::kink) trajectory_.law_state.turn_kink(kink);
    if (phase == ContactPhase::yielding && 1 - trajectory_.q <= contact_.saturated) trajectory_.saturate();
  }

  // Largest step at which the last terms of the series are within the tolerance. Speeds are measured by that of the ringing, of a
  // floor that lets go by a thousandth of what it is where friction is the weight: nothing rings there, and steps need not shrink.
  double accurate_step(const BoucWenArc<N>& arc, double force, const BoucWenLawHold<N>* hold) const {
    const double rate = std::sqrt(std::max(force, 1e-6 * trajectory_.gravity) / contact_.yield);
    double last = std::max(std::abs(arc.zeta[N]), std::abs(arc.v[N]) / (rate * contact_.yield));
    if (hold) last = std::max(last, hold->last_state(contact_.yield * std::max(1.0, rate)));
    return last > 0 ? std::pow(trajectory_.settings.tolerance / last, 1.0 / N) : 1 / rate;
  }

  // The series of q are, at worst, those of exp(n ln zeta), of which order N sees no more than this.
  double converging_step(const BoucWenArc<N>& arc, double h) const {
    const double fastest = arc.v[0] + 0.5 * std::abs(arc.v[1]) * h;
    return std::min(h, 6 * contact_.yield * std::abs(arc.zeta[0]) / (contact_.n * fastest));
  }

  // Sliding is exact over any time; twice the time to the stop is enough, where the floor is still.
  double stopping_time(const BoucWenArc<N>& arc) const {
    return trajectory_.cursor.motion_over() && arc.v[1] < 0 ? -2 * arc.v[0] / arc.v[1]
                                                            : std::numeric_limits<double>::infinity();
  }

  BoucWenTrajectory trajectory_;
  const BoucWenContact& contact_;
  // A law that is far stiffer than the contact takes steps that come no further, as in Integration::stop_when_done(): the contact itself, at
  // a hundred steps a ring, goes through a hundred rings in ten thousand.
  const double least_progress_s_;
};

}  // namespace

bool admissible_bouc_wen(const Specimen& specimen, const Shaking& shaking, const FloorInput& floor,
                         const Settings& settings) {
  const BoucWen& law = specimen.bouc_wen;
  for (const double size : {law.yield_displacement_m, law.gamma, law.gamma + law.beta, shaking.stretch,
                            settings.tolerance, floor.gravity_factor})
    if (!(size > 0) || !std::isfinite(size)) return false;
  const double mu_s = specimen.friction.mu_s, mu_k = specimen.friction.mu_k;
  return can_start(specimen) && specimen.friction.ratio_across == 1 && !specimen.legs && law.exponent >= 1 &&
         mu_k >= 0 && mu_s >= mu_k && std::isfinite(mu_s) && specimen.impact.factor >= 0 &&
         specimen.impact.factor <= 1 && std::isfinite(law.exponent) && std::abs(law.beta) <= law.gamma &&
         settings.free_vibration_s >= 0 && std::isfinite(settings.free_vibration_s) && std::isfinite(floor.push_mps2) &&
         std::isfinite(shaking.scale) && std::isfinite(shaking.vertical_scale) && shaking.motion &&
         shaking.motion->degree >= 0 && shaking.motion->degree <= max_floor_degree;
}

Response respond_bouc_wen(const Setup& setup, const Settings& settings, History* history) {
  if (!admissible_bouc_wen(setup, settings)) return Response{.outcome = Outcome::not_finite};
  return BoucWenIntegrator(setup, settings, history).run();
}

}  // namespace freestand::dynamics
