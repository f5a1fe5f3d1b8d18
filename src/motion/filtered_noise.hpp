// White noise through a filter whose frequency changes with time: the shape of a synthetic motion without its strength.
//
//   x(t_j) = sum_(i<j) h_i(t_j - t_i) u_i / sqrt(sum_(i<j) h_i(t_j - t_i)^2),
//   h_i(s) = w_i / sqrt(1 - z^2) exp(-z w_i s) sin(w_i sqrt(1 - z^2) s),
//
// the acceleration of a damped oscillator under impulses u_i, each with the frequency w_i at which the filter stands when it
// arrives. So x has a standard deviation of 1 at every instant, and only its spectrum moves.
// [Rezaeian & Der Kiureghian 2008, eqs. 4, 10 and 14]
#pragma once

#include <vector>

namespace freestand::motion {

// frequency_hz: of the filter at each instant; bandwidth: its damping ratio z, 0 < z < 1; white: u_i, as many. x(t_0) is 0, since
// nothing has arrived before. Impulses count until they have decayed by 1e-16.
std::vector<double> filtered_noise(const std::vector<double>& frequency_hz, double bandwidth, double step_s,
                                   const std::vector<double>& white);

}  // namespace freestand::motion
