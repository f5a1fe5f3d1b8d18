// Fourier and response spectra of a floor motion's horizontal channel.
#pragma once

#include <freestand/floor_motion.hpp>
#include <functional>
#include <vector>

namespace freestand::motion {

// |integral a(t) exp(-2 pi i f t) dt| [m/s] at f = 0, df, 2 df ... up to the Nyquist frequency of step_s; the integral
// as the sum over samples (FFTW), padded with zeros to at least `padding` times the duration.
struct FourierSpectrum {
  double step_hz = 0;
  std::vector<double> amplitude_mps;
};
FourierSpectrum fourier_spectrum(const FloorMotion& motion, double step_s, double padding = 1);

inline constexpr double usual_damping = 0.05;  // of critical

// Largest |u| [m] of u'' + 2 z w u' + w^2 u = -a(t), w = 2 pi / period, from rest, the free vibration afterwards
// included. Exact to rounding: each segment of the motion is solved in closed form, peaks between the knots too. Needs
// period_s > 0 and 0 <= damping < 1, else throws Error.
double spectral_displacement_m(const FloorMotion& motion, double period_s, double damping = usual_damping);

// Pseudo-acceleration w^2 |u| [m/s2] and pseudo-velocity w |u| [m/s].
double spectral_acceleration_mps2(const FloorMotion& motion, double period_s, double damping = usual_damping);
double spectral_velocity_mps(const FloorMotion& motion, double period_s, double damping = usual_damping);

// Housner's intensity [m]: integral of the pseudo-velocity over periods 0.1 to 2.5 s, 5 % damping (Housner 1952);
// trapezoids of 0.02 s. Of a motion, or of any spectrum Sa [m/s2] over periods [s].
double housner_intensity_m(const FloorMotion& motion);
double housner_intensity_m(const std::function<double(double)>& sa_mps2);

// A response spectrum as a table, 5 % damping.
class ResponseSpectrum {
 public:
  ResponseSpectrum() = default;
  ResponseSpectrum(std::vector<double> period_s, std::vector<double> sa_mps2);  // increasing; one a period

  const std::vector<double>& period_s() const { return period_s_; }
  const std::vector<double>& sa_mps2() const { return sa_mps2_; }

  // The ordinate of a period of the table, to the bit; between two of them interpolated: a cubic through the four
  // neighbours in ln Sa over ln T. Throws Error outside the table.
  double at(double period) const;
  bool holds(double period) const;  // is it one of the table?

 private:
  std::vector<double> period_s_, sa_mps2_, ln_period_, ln_sa_;
};
ResponseSpectrum response_spectrum(const FloorMotion& motion, std::vector<double> period_s);

// The periods that are kept of every record, 0.02 to 10 s: every hundredth of a second from 0.02 to 1 s and more between
// them below 0.3 s, every fiftieth up to 2 s, every twentieth up to 5 s, every tenth up to 10 s.
std::vector<double> kept_periods_s();

}  // namespace freestand::motion
