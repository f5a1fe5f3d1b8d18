#include "study/simulate.hpp"

#include <fmt/format.h>

#include <freestand/error.hpp>

#include "dynamics/simulate.hpp"
#include "motion/floor_displacement.hpp"
#include "study/accuracy.hpp"
#include "study/doubts.hpp"
#include "study/realise.hpp"

namespace freestand::study {

namespace {

constexpr double most_rows = 2e6;  // 0.5 GB in memory and as text

void check_rows(const Case& c, double shaking_s) {
  const double most_s = shaking_s + c.study.free_vibration_s;
  if (most_s <= most_rows * c.output_step_s) return;
  throw Error(
      fmt::format("output_step_s is {}, and the history can be {:.4g} s long (more than {:.0f} rows, which are half "
                  "a gigabyte): raise output_step_s to {:.2g} or more, or lower free_vibration_s",
                  c.output_step_s, most_s, most_rows, most_s / most_rows));
}

}  // namespace

Simulation simulate(const Case& c, bool reference) {
  const MotionSet motions = load_motions(c.study);
  const Realiser realise(c.study, motions);
  const Realisation sample = realise(0);
  check_rows(c, sample.shaking.duration_s());
  if (reference && (dynamics::moves_in_plane(*sample.shaking.motion) || sample.specimen.friction.ratio_across != 1))
    throw Error("--reference integrates along one line (this floor moves in both horizontal directions): leave it out");
  if (reference && sample.specimen.neighbour)
    throw Error("--reference integrates one block (this one has a neighbour): leave it out");
  if (reference && sample.specimen.legs)
    throw Error("--reference integrates a block on rigid edges (this one stands on legs that give way): leave it out");
  Simulation out{
      .specimen = sample.specimen, .response = {}, .tighter = {}, .history = {}, .doubts = doubts(c, motions)};
  out.history.step_s = c.output_step_s;
  out.history.forces = true;
  const auto solve = reference ? respond_reference : respond;
  Settings settings = integration_settings(c.study);
  out.response = solve(sample.specimen, sample.shaking, settings, &out.history);
  const motion::FloorDisplacement floor(*sample.shaking.motion);
  for (const HistoryPoint& point : out.history.points)
    out.floor_displacement_m.push_back(floor(sample.shaking, point.time_s));
  out.still_moving = out.response.outcome == Outcome::moved &&
                     out.response.end_time_s >= sample.shaking.duration_s() + settings.free_vibration_s;
  settings.tolerance = tighter(settings.tolerance);
  out.tighter = solve(sample.specimen, sample.shaking, settings, nullptr);
  return out;
}

}  // namespace freestand::study
