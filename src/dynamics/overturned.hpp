// What an overturned block slipped: the fall is none of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <freestand/response.hpp>

namespace freestand::dynamics {

// The middle of the base goes with the fall, by half_base in the end. Up to where the block could still have stood, rotation
// alpha = atan(c/h) over the corner at c, rocking displaces it by half_base (1 - cos(alpha)): that, how far
// the contact slid, and `unslid`, how far it flew and where it began, bound what counts as its slip [m], and what is left of it at most.
inline void leave_out_fall(Response& response, double half_base, double c, double h, double unslid) {
  const double rocked = half_base * (1 - h / std::sqrt(h * h + c * c)), most = response.slid_path_m + unslid + rocked;
  for (double* slip : {&response.peak_slip_m, &response.peak_slip_right_m, &response.peak_slip_left_m})
    if (*slip > most) *slip = most;
  response.residual_slip_m = std::clamp(response.residual_slip_m, -response.peak_slip_m, response.peak_slip_m);
}

}  // namespace freestand::dynamics
