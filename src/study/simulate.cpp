#include "study/simulate.hpp"

#include "study/accuracy.hpp"
#include "study/realise.hpp"

namespace freestand::study {

Simulation simulate(const Case& c, bool reference) {
  const Realiser realise(c.study, load_motions(c.study));
  const Realisation sample = realise(0);
  Simulation out{sample.specimen, {}, {}, {}};
  out.history.step_s = c.output_step_s;
  const auto solve = reference ? respond_reference : respond;
  Settings settings = integration_settings(c.study);
  out.response = solve(sample.specimen, sample.shaking, settings, &out.history);
  settings.tolerance = tighter(settings.tolerance);
  out.tighter = solve(sample.specimen, sample.shaking, settings, nullptr);
  return out;
}

}  // namespace freestand::study
