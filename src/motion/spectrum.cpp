#include "motion/spectrum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>

#include "base/units.hpp"
#include "motion/channel.hpp"
#include "motion/fourier.hpp"
#include "motion/oscillator.hpp"
#include "motion/peaks.hpp"

namespace freestand::motion {

FourierSpectrum fourier_spectrum(const FloorMotion& motion, double step_s, double padding) {
  const std::vector<double> a = floor_history(motion, step_s).acceleration_mps2;
  const double wanted = std::max(1.0, padding) * static_cast<double>(a.size());
  const std::size_t n = transform_size(static_cast<std::size_t>(std::ceil(wanted)));
  FourierSpectrum spectrum;
  spectrum.step_hz = 1 / (static_cast<double>(n) * step_s);
  for (const auto& bin : RealTransform(n).forward(a)) spectrum.amplitude_mps.push_back(std::abs(bin) * step_s);
  return spectrum;
}

double spectral_displacement_m(const FloorMotion& motion, double period_s, double damping) {
  if (!(period_s > 0) || !std::isfinite(period_s))
    throw Error(fmt::format("no spectrum at period {} s (not a positive number): give a period above 0", period_s));
  if (!(damping >= 0 && damping < 1))
    throw Error(fmt::format("no spectrum with damping ratio {} (outside [0, 1)): 0.05 is usual", damping));
  Oscillator oscillator(2 * pi / period_s, damping);
  OscillatorState state;
  double peak = 0;
  for (std::size_t i = 0; i < motion.segments(); ++i)
    state = oscillator.advance(segment(motion, motion.horizontal_mps2, i), length(motion, i), state, peak);
  return std::max(peak, oscillator.free_peak(state));
}

double spectral_velocity_mps(const FloorMotion& motion, double period_s, double damping) {
  return 2 * pi / period_s * spectral_displacement_m(motion, period_s, damping);
}

double spectral_acceleration_mps2(const FloorMotion& motion, double period_s, double damping) {
  return 2 * pi / period_s * spectral_velocity_mps(motion, period_s, damping);
}

double housner_intensity_m(const std::function<double(double)>& sa_mps2) {
  constexpr int steps = 120;
  constexpr double first = 0.1, last = 2.5, step = (last - first) / steps;
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double period = first + step * i;
    const double velocity = sa_mps2(period) * period / (2 * pi);
    sum += i == 0 || i == steps ? velocity / 2 : velocity;
  }
  return sum * step;
}

double housner_intensity_m(const FloorMotion& motion) {
  return housner_intensity_m([&](double period) { return spectral_acceleration_mps2(motion, period); });
}

std::vector<double> kept_periods_s() {
  struct Stretch {
    int per_second, first, end;  // periods first/per_second up to, without, end/per_second
  };
  std::vector<double> periods;
  for (const auto& [per_second, first, end] :
       {Stretch{400, 8, 40}, {200, 20, 60}, {100, 30, 100}, {50, 50, 100}, {20, 40, 100}, {10, 50, 101}})
    for (int i = first; i < end; ++i) periods.push_back(static_cast<double>(i) / per_second);
  return periods;
}

ResponseSpectrum response_spectrum(const FloorMotion& motion, std::vector<double> period_s) {
  std::vector<double> sa_mps2;
  for (const double period : period_s) sa_mps2.push_back(spectral_acceleration_mps2(motion, period));
  return {std::move(period_s), std::move(sa_mps2)};
}

ResponseSpectrum::ResponseSpectrum(std::vector<double> period_s, std::vector<double> sa_mps2)
    : period_s_(std::move(period_s)), sa_mps2_(std::move(sa_mps2)) {
  for (const double period : period_s_) ln_period_.push_back(std::log(period));
  for (const double sa : sa_mps2_) ln_sa_.push_back(std::log(sa));
}

bool ResponseSpectrum::holds(double period) const {
  return std::binary_search(period_s_.begin(), period_s_.end(), period);
}

double ResponseSpectrum::at(double period) const {
  const auto above = std::lower_bound(period_s_.begin(), period_s_.end(), period);
  const auto i = static_cast<std::size_t>(above - period_s_.begin());
  if (above != period_s_.end() && *above == period) return sa_mps2_[i];
  if (i == 0 || above == period_s_.end())
    throw Error(
        fmt::format("no spectral acceleration at {} s (the table {}): choose a period within it", period,
                    period_s_.empty() ? std::string("is empty")
                                      : fmt::format("reaches from {} to {} s", period_s_.front(), period_s_.back())),
        Exit::data);
  const std::size_t first = std::min(i < 2 ? 0 : i - 2, period_s_.size() - std::min<std::size_t>(4, period_s_.size()));
  const std::size_t end = std::min(first + 4, period_s_.size());
  const double x = std::log(period);
  const double* knot = &ln_period_[first];
  double sum = 0;
  for (std::size_t j = 0; j < end - first; ++j) {
    double weight = 1;
    for (std::size_t k = 0; k < end - first; ++k)
      if (k != j) weight *= (x - knot[k]) / (knot[j] - knot[k]);
    sum += weight * ln_sa_[first + j];
  }
  return std::exp(sum);
}

}  // namespace freestand::motion
