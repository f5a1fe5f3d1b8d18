#include "dynamics/taylor_integrator.hpp"

#include "dynamics/bouc_wen.hpp"

namespace freestand {

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
