// A block on two legs that give way up and down alone, one under either edge of its base: springs with dashpots, which push and do
// not pull.  [Psycharis & Jennings, Rocking of slender rigid bodies allowed to uplift, Earthq. Eng. Struct. Dyn. 11 (1983)]
//
//          ________        y: of the centre of mass over where it is when the block stands still;  r_i, c_i as in contact.hpp,
//         |   x    |       i = right, left;  e_i = y + h (1 - cos(theta)) - c_i sin(theta): how far edge i has risen
//         |________|
//          |      |        N_i = N_i0 - k e_i - c e_i'  >= 0, over the mass, where the leg reaches the floor: k e_i <= N_i0, its share of
//        __Z______Z__            the weight as it stands;   k = W^2/2, c = z W, W = 2 pi f: the block goes up and down on both at W
//
//   x'' + a = f_x,   y'' + g' = sum N_i,   k^2 theta'' = sum N_i r_i,x - r_y f_x
//
// A foot holds where it stands: |f_x| <= mu_s sum N_i, or slips: f_x = -sigma mu_k sum N_i. It is the foot of the leg that carries, and
// of two the one under the lower edge, which turn and turn about have the same place and speed. What stays rigid besides is the block:
// as W grows the motion up to a blow becomes that on rigid edges; blows become short pushes of the legs, of no law of impact.
#pragma once

#include <freestand/simulate.hpp>
#include <string>

#include "dynamics/laws.hpp"

namespace freestand::dynamics {

// Why a block cannot be computed on its legs; "" where it can: model slide_rock, with no effects but those on its coefficients of friction,
// its shape, and vertical_shaking.
std::string refusal_on_spring_legs(const Specimen&);

// Throws nothing; a specimen that is refused is not_finite, as are legs without a frequency or with a negative damping. Mode `rest` is that
// of a block that stands on both feet and sways; impacts are those of legs that come down.
Response respond_on_spring_legs(const Setup&, const Settings&, History* history);

}  // namespace freestand::dynamics
