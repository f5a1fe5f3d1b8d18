#include "motion/filtered_noise.hpp"

#include <cmath>
#include <complex>

#include "base/units.hpp"

namespace freestand::motion {

std::vector<double> filtered_noise(const std::vector<double>& frequency_hz, double bandwidth, double step_s,
                                   const std::vector<double>& white) {
  const std::size_t count = frequency_hz.size();
  const double root = std::sqrt(1 - bandwidth * bandwidth), decayed = -std::log(1e-16);
  std::vector<double> sum(count, 0.0), variance(count, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const double w = 2 * pi * frequency_hz[i], size = w / root;
    // exp(-z w s) (cos + i sin)(w root s), from step to step.
    const std::complex<double> turn = std::polar(std::exp(-bandwidth * w * step_s), w * root * step_s);
    const double steps = decayed / (bandwidth * w * step_s);
    std::complex<double> phase = size;
    for (std::size_t j = i + 1; j < count && static_cast<double>(j - i) < steps; ++j) {
      phase = {phase.real() * turn.real() - phase.imag() * turn.imag(),
               phase.real() * turn.imag() + phase.imag() * turn.real()};
      const double h = phase.imag();
      sum[j] += h * white[i];
      variance[j] += h * h;
    }
  }
  for (std::size_t j = 0; j < count; ++j) sum[j] = variance[j] > 0 ? sum[j] / std::sqrt(variance[j]) : 0;
  return sum;
}

}  // namespace freestand::motion
