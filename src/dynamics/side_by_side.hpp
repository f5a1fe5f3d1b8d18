// Two blocks that slide on one floor, side by side: each is a wall to the other, which gives way.
//
//        ______       ______          u_i'' = -a - sigma_i mu_i g,  stuck while |a| <= mu_s,i g
//       |      |     |      |         blow: m_0 u_0' + m_1 u_1' stays, u_1' - u_0' is e times what u_0' - u_1' was
//       |  0   | gap |  1   |         together: u'' = -a - sigma g (m_0 mu_0 + m_1 mu_1)/(m_0 + m_1), while they press,
//       |______|_____|______|             that is while the one in front is braked as much or more;
//    ===========================          stuck while what presses and what holds find room: joint_grip()
//
// Newton's law of restitution and Coulomb's friction (Brach, Mechanical Impact Dynamics, 1991; shocks of sliding blocks against
// each other: Younis & Tadjbakhsh, J. Eng. Mech. 110, 1984). The floor is a polynomial between its knots, so that between events
// everything is one too: nothing is approximated but roots.
#pragma once

#include <freestand/simulate.hpp>
#include <string>

#include "dynamics/laws.hpp"

namespace freestand::dynamics {

// Why a block cannot be computed beside its neighbour; "" where it can: model slide, with no effects but those that act on its
// coefficients of friction, and floor_tilt.
std::string refusal_beside_neighbour(const Specimen&);

// Of the specimen beside its neighbour; wall_hits and wall_speed_mps are those of their blows. Throws nothing; a specimen that is
// refused is not_finite, as is a neighbour without mass, with a negative gap, mu_s below mu_k, or a restitution beyond [0, 1].
Response respond_beside_neighbour(const Setup&, const Settings&, History* history);

}  // namespace freestand::dynamics
