#include "dynamics/taylor_integrator.hpp"

#include "dynamics/bouc_wen.hpp"
#include "dynamics/law_rows.hpp"
#include "dynamics/pulse_slide.hpp"
#include "dynamics/side_by_side.hpp"
#include "dynamics/simulate.hpp"
#include "dynamics/spring_legs.hpp"

namespace freestand::dynamics {

Response respond_on_line(const Specimen& specimen, const Shaking& shaking, const Settings& settings, History* history) {
  const Setup setup = set_up(specimen, shaking);
  if (specimen.neighbour) return respond_beside_neighbour(setup, settings, history);
  if (specimen.legs) return respond_on_spring_legs(setup, settings, history);
  if (specimen.model == Model::bouc_wen) return respond_bouc_wen(setup, settings, history);
  if (!admissible(setup, settings)) return Response{.outcome = Outcome::not_finite};
  if (!history && slides_on_pulse(setup, settings)) return slide_on_pulse(setup, settings);
  if (shaking.motion->degree <= 1) return TaylorIntegrator<OnRecords::order, 3>(setup, settings, history).run();
  return TaylorIntegrator<OnPulses::order, OnPulses::degree + 2>(setup, settings, history).run();
}

}  // namespace freestand::dynamics
