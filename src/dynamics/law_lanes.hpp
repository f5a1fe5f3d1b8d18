// Samples under laws, many at once: each with its own motion, time and mode, in the group of those that do the same. Groups go on
// in packs (pack/law_march.hpp); a sample to which something happens takes that step by itself, with the text for single
// samples (taylor_integrator.hpp), and goes back into a group. The answers are those of respond(), to the bit.
#pragma once

#include <freestand/response.hpp>
#include <freestand/simulate.hpp>
#include <span>
#include <vector>

#include "dynamics/batch.hpp"

namespace freestand::dynamics {

// Whether packs take the sample: it has laws, or its motion is a pulse.
bool goes_in_law_lanes(const Setup& setup, const Settings& settings);

// Computes samples[i] = respond(specimens[i], shakings[i]) for the i of `which`. histories: one of each sample, or none.
void respond_in_law_lanes(const BatchKernels& kernels, std::span<const Specimen> specimens,
                          std::span<const Shaking> shakings, const Settings& settings,
                          const std::vector<std::size_t>& which, std::span<Response> responses,
                          std::span<History> histories);

}  // namespace freestand::dynamics
