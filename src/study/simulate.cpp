#include "study/simulate.hpp"

#include "study/accuracy.hpp"
#include "study/doubts.hpp"
#include "study/realise.hpp"

namespace freestand::study {

Simulation simulate(const Case& c, bool reference) {
  const MotionSet motions = load_motions(c.study);
  const Realiser realise(c.study, motions);
  const Realisation sample = realise(0);
  Simulation out{.specimen = sample.specimen, .response = {}, .tighter = {}, .history = {}, .doubts = doubts(c.study)};
  for (std::string& doubt : doubts(c.study, motions)) out.doubts.push_back(std::move(doubt));
  out.history.step_s = c.output_step_s;
  const auto solve = reference ? respond_reference : respond;
  Settings settings = integration_settings(c.study);
  out.response = solve(sample.specimen, sample.shaking, settings, &out.history);
  out.still_moving = out.response.outcome == Outcome::moved &&
                     out.response.end_time_s >= sample.shaking.duration_s() + settings.free_vibration_s;
  settings.tolerance = tighter(settings.tolerance);
  out.tighter = solve(sample.specimen, sample.shaking, settings, nullptr);
  return out;
}

}  // namespace freestand::study
