// A block that slides in the plane of a floor which moves in both horizontal directions (FloorMotion::cross_mps2):
//   u'' + a = -mu_k g' u'/|u'|,  stuck while |a| <= mu_s g'  (vectors; g' = g + v under vertical shaking)
// Where g' <= 0 the block flies, and lands with an impulse mu |y'| at most against its slip. Friction may differ between two directions.
// Turning about the vertical axis (yaw) is left out: forces act through the centre of mass, and no couple of friction turns the block.
//
// Between events nothing is approximated but by series (plane_slip.hpp): onset, stop, lift-off and landing are roots. A slip that
// slows down below a tenth of what a step may miss in its speed counts as stopped.
#pragma once

#include <freestand/simulate.hpp>
#include <span>
#include <vector>

#include "dynamics/laws.hpp"

namespace freestand::dynamics {

// Why such a block cannot be computed on a floor with a second horizontal channel; "" where it can: model slide, with no effects
// but those that act on friction coefficients or on the vertical channel.
std::string refusal_in_plane(const Specimen&);

// Throws nothing; a specimen that is refused is not_finite, and so is one on a motion that is not piecewise linear.
Response respond_in_plane(const Setup&, const Settings&, History* history);

// Some of the samples of a batch, those of which[]. They go in packs: each step of a slip that is in full swing, several samples at once
// (plane_step.hpp), with the bits of single samples; rest, onset, the ends of slips and flight one by one.
void respond_in_plane(std::span<const Specimen>, std::span<const Shaking>, const Settings&,
                      const std::vector<std::size_t>& which, std::span<Response>);

}  // namespace freestand::dynamics
