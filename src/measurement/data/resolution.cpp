#include "measurement/data/resolution.hpp"

#include <cmath>
#include <cstddef>
#include <set>

namespace freestand::measurement {

double resolution(const std::vector<double>& samples) {
  constexpr std::size_t longest_tread = 50, least_treads = 10, least_values = 4;
  constexpr double digits = 1e-4;  // of a step, to which a multiple is one
  double step = 0;
  std::size_t run = 0, treads = 0;  // run: equal readings since the last change; 0 before the first
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double change = std::abs(samples[i] - samples[i - 1]);
    if (change == 0) {
      run += run > 0;
      continue;
    }
    if (step == 0 || change < step) step = change;
    treads += run >= 2 && run <= longest_tread;
    run = 1;
  }
  if (treads < least_treads) return 0;
  std::set<double> values;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double multiple = (samples[i] - samples[i - 1]) / step;
    if (std::abs(multiple - std::round(multiple)) > digits * std::max(1.0, std::abs(multiple))) return 0;
    if (values.size() < least_values) values.insert(std::round(samples[i] / step));
  }
  return values.size() < least_values ? 0 : step;
}

double rounding(const std::vector<double>& samples) { return resolution(samples) / std::sqrt(12.0); }

}  // namespace freestand::measurement
