// The integrator of the sweep: one Taylor step between two knots of the floor motion, or up to the next event.
#include <algorithm>
#include <cmath>

#include "dynamics/bouc_wen.hpp"
#include "dynamics/integration.hpp"
#include "dynamics/law_values.hpp"

namespace freestand {
namespace dynamics {
namespace {

// N: order of the steps on one corner. FlatN: order in which sliding is exact, degree of the motion + 2.
template <int N, int FlatN>
class TaylorIntegrator {
 public:
  TaylorIntegrator(const Setup& setup, const Settings& settings, History* history)
      : life_(setup, settings, history),
        flat_exactly_(!life_.rig.laws),
        p_(setup.specimen.block.p_radps()),
        alpha_(setup.specimen.block.alpha_rad()),
        size_(setup.specimen.block.size_m()) {}

  Response run() {
    for (life_.stop_when_done(); !life_.finished(); life_.stop_when_done()) {
      if (life_.waits())
        life_.wait();
      else if (life_.state.mode == Mode::flight)
        fly_on(life_.cursor.template local<N>());
      else if (life_.state.pivot == 0 && flat_exactly_)
        move_on(life_.cursor.template local<FlatN>());
      else
        move_on(life_.cursor.template local<N>());
    }
    return life_.result();
  }

 private:
  template <int M>
  void move_on(const Floor<double, M>& floor) {
    const bool exact = life_.state.pivot == 0 && flat_exactly_;
    with_contact_arc<M>(life_.rig, life_.state, life_.cursor.time(), floor, [&](const auto& arc) {
      if (has_forces(arc))
        step_along(arc, floor, step(exact ? 0.0 : local_error(arc)));
      else
        life_.resolve(Witness::regular);
    });
  }

  // What turns is seen over a tenth of a radian at most, for the gaps under the corners.
  void fly_on(const Floor<double, N>& floor) {
    const double turn = std::abs(life_.state.omega);
    const double quarter = turn > 0 ? 0.1 / turn : 0.1;
    with_flight_arc<N>(life_.rig, life_.state, life_.cursor.time(), floor, [&](const auto& flight) {
      step_along(flight, floor, std::min(step(local_error(flight)), quarter));
    });
  }

  // Along the series of the state's mode, over h at most, to the first event or as far as the laws follow it.
  template <class Arc, int M>
  void step_along(const Arc& arc, const Floor<double, M>& floor, double h) {
    const State before = life_.state;
    Found found = first_event(before, arc, h);
    while (found.tau > shortest_step / p_ && !(defect(before, arc, floor, found.tau) <= defect_allowed)) {
      h = 0.5 * found.tau;
      found = first_event(before, arc, h);
    }
    const double tau = found.tau;
    if (tau > 0) life_.peaks.observe(life_.rig, before, arc, tau);
    life_.recorder.record(before, arc, floor, life_.cursor.time(), tau);
    go_to(life_.state, arc, tau);
    end_step(found, h);
  }

  template <class Arc>
  Found first_event(const State& state, const Arc& arc, double h) const {
    FirstEvent first(h);
    for_each_witness(life_.rig, state, arc, first);
    return first.found();
  }

  // By how much the accelerations and the friction at tau miss those of the series, times tau, dimensionless and in tolerances. A law may
  // have series whose last terms vanish (even in time, say) while later ones do not: the last term alone is no judge.
  template <int M>
  double defect(const State& before, const LawArc<M>& arc, const Floor<double, M>& floor, double tau) const {
    State end = before;
    go_to(end, arc, tau);
    const Floor<double, 1> there{{floor.a.at(tau), 0}, {floor.g.at(tau), 0}};
    LawStep<1> there_on(life_.rig, end, life_.cursor.time() + tau, there);
    const LawArc<1>& fresh = there_on.run();
    const double slip = std::abs(fresh.w[1] - derivative(arc.w).at(tau)) / (p_ * size_);
    const double turn = std::abs(fresh.omega[1] - derivative(arc.omega).at(tau)) / (p_ * alpha_);
    const double grip = grip_missed(life_.rig, end, life_.cursor.time() + tau, there, arc, tau) / (p_ * size_);
    return std::max({slip, turn, grip}) * tau / life_.settings.tolerance;
  }
  double defect(const State& before, const LawFlight<N>& flight, const Floor<double, N>& floor, double tau) const {
    State end = before;
    go_to(end, flight, tau);
    const Floor<double, 1> there{{floor.a.at(tau), 0}, {floor.g.at(tau), 0}};
    const LawFlight<1> fresh = fly_with_laws<1>(life_.rig, end, life_.cursor.time() + tau, there);
    const double slip = std::abs(fresh.vx[1] - derivative(flight.vx).at(tau)) / (p_ * size_);
    const double turn = std::abs(fresh.omega[1] - derivative(flight.omega).at(tau)) / (p_ * alpha_);
    return std::max(slip, turn) * tau / life_.settings.tolerance;
  }
  // The plain block's series know their own error.
  template <class Arc, int M>
  double defect(const State&, const Arc&, const Floor<double, M>&, double) const {
    return 0;
  }

  // A step that reached the knot goes to the next segment; an event is resolved where it fell.
  void end_step(const Found& found, double h) {
    const bool at_knot = !found.any && h == life_.cursor.left();
    life_.cursor.advance(found.tau);
    if (found.tau > 0) life_.left_instant();
    if (at_knot) life_.cursor.next_segment();
    if (found.any) life_.resolve(found.witness);
  }

  // Last term of the series, dimensionless, at tau = 1/p: a step h neglects about this times (p h)^N in the forces, and
  // less in the state.
  template <int M>
  double local_error(const Arc<double, M>& arc) const {
    return std::max({std::abs(arc.theta[M]) / alpha_, std::abs(arc.omega[M]) / (p_ * alpha_),
                     std::abs(arc.xi[M]) / size_, std::abs(arc.w[M]) / (p_ * size_)}) /
           power<M>(p_);
  }

  double local_error(const LawArc<N>& arc) const {
    const double lengths = std::max(std::abs(arc.path[N]), std::abs(arc.deflection[N])) / size_;
    return std::max(local_error(static_cast<const Arc<double, N>&>(arc)),
                    std::max(lengths, last_of_states(arc.states)) / power<N>(p_));
  }

  double local_error(const Flight<double, N>&) const { return 0; }  // polynomials

  double local_error(const LawFlight<N>& flight) const {
    return std::max({std::abs(flight.theta[N]) / alpha_, std::abs(flight.omega[N]) / (p_ * alpha_),
                     std::abs(flight.x[N]) / size_, std::abs(flight.vx[N]) / (p_ * size_),
                     std::abs(flight.deflection[N]) / size_, last_of_states(flight.states)}) /
           power<N>(p_);
  }

  double last_of_states(const Series<double, N>* states) const {
    double most = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(life_.rig.laws->states); ++i)
      most = std::max(most, std::abs(states[i][N]) / (life_.rig.laws->relative_velocity[i] ? p_ * size_ : size_));
    return most;
  }

  template <int M>
  static double power(double x) {
    double result = x;
    for (int i = 1; i < M; ++i) result *= x;
    return result;
  }

  double step(double error_at_1p) const {
    double h = std::min(life_.left(), 1.0 / p_);
    if (error_at_1p * power<N>(p_ * h) > life_.settings.tolerance)
      h = std::pow(life_.settings.tolerance / error_at_1p, 1.0 / N) / p_;
    return h;
  }

  static constexpr double defect_allowed = 10, shortest_step = 1e-6;

  Integration life_;
  bool flat_exactly_;  // steps of order FlatN are exact on both corners
  double p_, alpha_, size_;
};

}  // namespace
}  // namespace dynamics

Response respond(const Specimen& specimen, const Shaking& shaking, const Settings& settings, History* history) {
  const dynamics::Setup setup = dynamics::set_up(specimen, shaking);
  if (specimen.model == Model::bouc_wen) return dynamics::respond_bouc_wen(setup, settings, history);
  if (!dynamics::admissible(setup, settings)) return Response{.outcome = Outcome::not_finite};
  // Records are linear between samples that lie close together; pulses have longer segments of higher degree.
  if (shaking.motion->degree <= 1) return dynamics::TaylorIntegrator<7, 3>(setup, settings, history).run();
  if (dynamics::has_laws(setup.specimen)) return dynamics::TaylorIntegrator<8, 8>(setup, settings, history).run();
  return dynamics::TaylorIntegrator<10, 10>(setup, settings, history).run();
}

}  // namespace freestand
