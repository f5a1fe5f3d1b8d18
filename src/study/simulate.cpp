#include "study/simulate.hpp"

#include "study/realise.hpp"

namespace freestand::study {

Simulation simulate(const Case& c, bool reference) {
  const Realiser realise(c.study, load_motions(c.study));
  const Realisation sample = realise(0);
  Simulation out{sample.specimen, {}, {}};
  out.history.step_s = c.output_step_s;
  out.response = (reference ? respond_reference : respond)(sample.specimen, sample.shaking,
                                                           integration_settings(c.study), &out.history);
  return out;
}

}  // namespace freestand::study
