// How the strength of a synthetic motion grows and fades: the gamma modulating function.
//
//   q(t) = a1 t^(a2-1) exp(-a3 t)   [m/s2]
//
// is the standard deviation of the acceleration at time t. The Arias intensity that is expected up to t is then pi/(2g) times the
// integral of q^2, which grows as the distribution function of a gamma variable of shape k = 2 a2 - 1 and rate r = 2 a3. So the
// duration from 5 to 95 % of it and the instant of 45 % give k and r, and the whole of it gives a1.
//
// S. Rezaeian and A. Der Kiureghian, "A stochastic ground motion model with separable temporal and spectral nonstationarity",
// Earthquake Engineering and Structural Dynamics 37 (2008), and "Simulation of synthetic ground motions for specified earthquake
// and site characteristics", ibid. 39 (2010).
#pragma once

namespace freestand::motion {

class GammaEnvelope {
 public:
  // Expected Arias intensity [m/s], duration from 5 to 95 % of it [s], time of 45 % of it [s]; all above zero. Throws Error
  // (Exit::usage) where no k >= 1 has such times: duration over middle is at most 4.93, that of k = 1, at which the motion begins
  // with its full strength.
  GammaEnvelope(double arias_mps, double duration_s, double middle_s);

  double operator()(double t_s) const;  // q(t), t >= 0

  double time_of_share(double share) const;  // when that share of the Arias intensity is expected [s]; 0 <= share < 1

 private:
  double shape_, rate_, log_squared_;  // k, r, ln a1^2
};

}  // namespace freestand::motion
