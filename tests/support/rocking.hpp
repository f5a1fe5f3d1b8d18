// Rocking of a uniform block that never slips, computed without src/dynamics: exact quadratures for free rocking, and a
// plain fourth-order integration with located impacts for pulses.
#pragma once

#include <functional>
#include <vector>

namespace freestand::test {

struct RockingBlock {
  double p_radps, alpha_rad;
  double restitution() const;  // Housner's e = 1 - 1.5 sin^2 alpha
};

// Free rocking keeps E = theta'^2/(2 p^2) + cos(alpha - |theta|) between impacts. Time [s] to fall from rest at `peak`
// to rotation `to` < peak < alpha:
//   t = int dtheta / (p sqrt(2 [cos(alpha - peak) - cos(alpha - theta)])).
// With to = 0 it is the quarter period; for slender blocks it becomes Housner's acosh(1/(1 - peak/alpha))/p.
// Gauss-Legendre after theta = peak - u^2, which takes the singularity away: exact to about 1e-14 for peak < 0.95
// alpha.
double fall_time_s(const RockingBlock& block, double peak_rad, double to_rad = 0);

// Rotation at which free rocking with |theta'| = rate at rotation |theta| = at comes to rest.
double peak_of(const RockingBlock& block, double at_rad, double rate_radps);

struct RockingState {
  double theta = 0, rate = 0;
};

// theta'' = -p^2 [ s sin(alpha - |theta|) + (a/g) cos(alpha - |theta|) ], fourth-order Runge-Kutta, no impact inside.
RockingState advance_rocking(const RockingBlock& block, RockingState state, int sign, double t_s, double step_s,
                             const std::function<double(double)>& floor_g);

struct RockingRun {
  bool overturned = false;
  double peak_rotation_rad = 0;
  std::vector<double> impact_s;
};

// One-sine pulse a = amplitude_g g sin(omega t), 0 <= t <= 2 pi/omega, from rest, Housner impacts.
// steps: of the integration in one pulse period.
RockingRun rock_under_one_sine(const RockingBlock& block, double amplitude_g, double omega_radps, int steps = 1000);

}  // namespace freestand::test
