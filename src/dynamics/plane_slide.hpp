// A block that slides in the plane of a floor which moves in both horizontal directions (FloorMotion::cross_mps2):
//   u'' + a = -mu_k g' u'/|u'|,  stuck while |a| <= mu_s g'  (vectors; g' = g + v under vertical shaking)
// Friction that differs between two directions: plane_ellipse.hpp. Where g' <= 0 the block flies, and lands with an impulse mu |y'| at most against its slip. Turning about the vertical
// axis (yaw) is left out: forces act through the centre of mass, and no couple of friction turns the block.
//
// Between events nothing is approximated but by series (plane_slip.hpp): onset, stop, lift-off and landing are roots. A slip that
// slows down below a tenth of what a step may miss in its speed counts as stopped.
#pragma once

#include <freestand/simulate.hpp>

#include "dynamics/laws.hpp"

namespace freestand::dynamics {

// Why such a block cannot be computed on a floor with a second horizontal channel; "" where it can: model slide, with no effects
// but those that act on friction coefficients or on the vertical channel.
std::string refusal_in_plane(const Specimen&);

// Throws nothing; a specimen that is refused is not_finite.
Response respond_in_plane(const Setup&, const Settings&, History* history);

}  // namespace freestand::dynamics
