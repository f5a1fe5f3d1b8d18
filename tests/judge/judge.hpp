// One case by the contact time-stepper and by the kernel's two integrators.
//
// The stepper's error is measured by its step: run again with half of it, its history changes by `own`. The kernel may be
// off by a micrometre and six times the largest `own` so far (its error falls at least with the step, so that half a
// step leaves at most what it changed; six for what a change can hide). The largest acceleration is held to that of the stepper at the
// tolerance of a sweep too, whatever hops it goes through. Where `own` has passed 0.1 mm the history is
// chaotic, and nothing after it is compared. A disagreement is one only if steppers 4 and 64 times as fine still see it, whose
// error is told by three runs (steps that are no halves of each other do not err alike by chance): what lasts shorter than a
// step, a foot under legs that stops and goes on, halved steps may miss alike. And it is none if the stepper's own history on a floor
// that is stronger or weaker by 1e-7, or beside a wall a nanometre off where it touched the block, is as far off: that is an
// edge, on which any error decides.
//
// On a Bouc-Wen contact, which has no jumps, the stepper goes by Runge-Kutta, its step's tolerance falls with the square of
// `step`, and the kernel may be off by a nanometre; of the whole sample the peaks, the path and the residual slip are compared.
#pragma once

#include <freestand/response.hpp>
#include <string>

#include "judge/judged_case.hpp"

namespace freestand::test {

// Of the stepper where a disagreement is looked at most closely [s].
inline constexpr double finest_step_s = 1e-4 / 64;

enum class Finding { agrees, on_an_edge, disagrees };

struct Judgement {
  Finding finding = Finding::agrees;
  std::string what;  // of a disagreement: who, when, by how much
  std::size_t compared = 0, samples = 0;
  unsigned deeds = 0;       // of the compared time: TruthDeed
  double parted_s = 1e300;  // of a disagreement between the histories
};

Judgement judge(const JudgedCase&);

// The kernel's and the stepper's histories side by side, ten lines a sample, for whoever looks for a cause.
std::string side_by_side(const JudgedCase&, double from_s, double to_s);

}  // namespace freestand::test
