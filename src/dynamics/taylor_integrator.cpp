#include "dynamics/taylor_integrator.hpp"

#include "dynamics/bouc_wen.hpp"
#include "dynamics/pulse_slide.hpp"
#include "dynamics/side_by_side.hpp"
#include "dynamics/simulate.hpp"
#include "dynamics/spring_legs.hpp"

namespace freestand::dynamics {

template <int N, int FlatN>
void TaylorIntegrator<N, FlatN>::step() {
  if (trajectory_.waits())
    trajectory_.wait();
  else if (trajectory_.state.mode == Mode::flight)
    fly_on(trajectory_.cursor.template local<N>());
  else if (trajectory_.state.pivot == 0 && flat_exactly_)
    slide_exactly(trajectory_.cursor.template local<FlatN>());
  else
    move_on(trajectory_.cursor.template local<N>());
}

template <int N, int FlatN>
void TaylorIntegrator<N, FlatN>::step_along(const LawArc<N>& arc) {
  const Floor<double, N> floor = trajectory_.cursor.template local<N>();
  if (has_forces(arc))
    step_along(arc, floor, length_of_step(arc));
  else
    trajectory_.resolve(Witness::regular);
}

template class TaylorIntegrator<OnRecords::order, OnRecords::degree + 2>;
template class TaylorIntegrator<OnPulses::order, OnPulses::degree + 2>;

Response respond_on_line(const Specimen& specimen, const Shaking& shaking, const Settings& settings, History* history) {
  const Setup setup = set_up(specimen, shaking);
  if (specimen.neighbour) return respond_beside_neighbour(setup, settings, history);
  if (specimen.legs) return respond_on_spring_legs(setup, settings, history);
  if (specimen.model == Model::bouc_wen) return respond_bouc_wen(setup, settings, history);
  if (!admissible(setup, settings)) return Response{.outcome = Outcome::not_finite};
  if (!history && slides_on_pulse(setup, settings)) return slide_on_pulse(setup, settings);
  if (shaking.motion->degree <= 1) return IntegratorOf<OnRecords>(setup, settings, history).run();
  return IntegratorOf<OnPulses>(setup, settings, history).run();
}

}  // namespace freestand::dynamics
