// A block that only slides, under constant friction, on a pulse: between two events its speed and its place are what the floor's own
// speed and displacement leave,
//     w(t) = w0 - V - sigma mu_k g t,   u(t) = u0 + w0 t - U - sigma mu_k g t^2 / 2,
// with V and U the integrals of the floor's acceleration since then. Segments in which it beyond doubt slides on are gone through by
// their integrals alone. The answers are those of the integrator but for round-off.
#pragma once

#include "dynamics/integration.hpp"

namespace freestand::dynamics {

// Level floor that shakes along a line; no effects in the equations, nothing followed but the demands of sliding.
bool slides_on_pulse(const Setup& setup, const Settings& settings);

Response slide_on_pulse(const Setup& setup, const Settings& settings);

}  // namespace freestand::dynamics
