#include "measurement/noise/sensor.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "measurement/search.hpp"

namespace freestand::measurement {
namespace {

constexpr double level = 0.95;
constexpr std::size_t least_samples = 100;  // a size is known to 7 % then

// -2 ln of the likelihood that a stretch's differences have, but for what does not depend on the sensor: the mean is
// integrated out (restricted likelihood).
double deviance_of(const Sensor& sensor, const QuietStretch& stretch) {
  std::vector<double> y = stretch.samples, one(y.size(), 1.0);
  sensor.whiten(y.data(), y.size(), stretch.dt_s);
  sensor.whiten(one.data(), one.size(), stretch.dt_s);
  double yy = 0, y1 = 0, ones = 0;
  for (std::size_t i = 0; i < y.size(); ++i) yy += y[i] * y[i], y1 += y[i] * one[i], ones += one[i] * one[i];
  // The innovations' variances: what a unit impulse at each place is scaled by.
  const double r = sensor.correlation_s > 0 ? std::exp(-stretch.dt_s / sensor.correlation_s) : 0;
  const double c2 = sensor.coloured * sensor.coloured, w2 = sensor.white * sensor.white;
  double logs = 0, variance = c2;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const double s = variance + w2;
    logs += std::log(s);
    variance = r * r * variance * w2 / s + (1 - r * r) * c2;
  }
  return yy - y1 * y1 / ones + logs + std::log(ones);
}

double deviance(const Sensor& sensor, const std::vector<QuietStretch>& stretches) {
  double sum = 0;
  for (const QuietStretch& stretch : stretches) sum += deviance_of(sensor, stretch);
  return sum;
}

Free free_number(const char* name, double low, double high) {
  return {.name = name, .lower = low, .upper = high, .low = low, .high = high, .logarithmic = true};
}

Sensor sized(const std::vector<QuietStretch>& stretches) {
  const std::vector<Free> free = {free_number("white", 0.01, 100)};
  const Fitted found = simplex(
      free, [&](std::span<const double> x) { return deviance({.white = x[0]}, stretches); }, {1.0}, 0.1, 60);
  return {.white = found.x[0]};
}

Sensor coloured(const std::vector<QuietStretch>& stretches) {
  double longest = 0, dt = stretches.front().dt_s;
  for (const QuietStretch& s : stretches) longest = std::max(longest, s.dt_s * static_cast<double>(s.samples.size()));
  const std::vector<Free> free = {free_number("white", 0.01, 100), free_number("coloured", 0.01, 100),
                                  free_number("correlation", dt, std::max(longest, 4 * dt))};
  const auto sensor = [](std::span<const double> x) {
    return Sensor{.white = x[0], .coloured = x[1], .correlation_s = x[2]};
  };
  Fitted best{{}, 1e300};
  for (const double white : {0.1, 0.8})
    for (const double share : {0.1, 0.5}) {
      const Values start = {white, 0.6, dt * std::pow(std::max(longest, 4 * dt) / dt, share)};
      const Fitted found = simplex(
          free, [&](std::span<const double> x) { return deviance(sensor(x), stretches); }, start, 0.1, 200);
      if (found.score < best.score) best = found;
    }
  return sensor(best.x);
}

// Slope of each test over its stretches, and the deviation of the true ones by their moments.
double drift_of(const Sensor& sensor, const std::vector<QuietStretch>& stretches) {
  struct Slope {
    double xy = 0, xx = 0;
  };
  std::map<std::size_t, Slope> tests;
  for (const QuietStretch& stretch : stretches) {
    std::vector<double> y = stretch.samples, one(y.size(), 1.0), t;
    for (std::size_t i = 0; i < y.size(); ++i) t.push_back(stretch.dt_s * static_cast<double>(i));
    for (std::vector<double>* series : {&y, &one, &t}) sensor.whiten(series->data(), series->size(), stretch.dt_s);
    double oo = 0, oy = 0, ot = 0;
    for (std::size_t i = 0; i < y.size(); ++i) oo += one[i] * one[i], oy += one[i] * y[i], ot += one[i] * t[i];
    for (std::size_t i = 0; i < y.size(); ++i) {
      const double x = t[i] - ot / oo * one[i];
      tests[stretch.test].xy += x * (y[i] - oy / oo * one[i]);
      tests[stretch.test].xx += x * x;
    }
  }
  double chi_square = 0, weights = 0;
  for (const auto& [test, slope] : tests) {
    chi_square += slope.xy * slope.xy / slope.xx;
    weights += slope.xx;
  }
  const auto n = static_cast<double>(tests.size());
  if (chi_square < gsl_cdf_chisq_Pinv(level, n)) return 0;
  // Of slopes of no common mean: E(chi square) = n + sd^2 sum of weights.
  return std::sqrt(std::max(chi_square - n, 0.0) / weights);
}

}  // namespace

double Sensor::size() const { return std::hypot(white, coloured); }

void Sensor::whiten(double* samples, std::size_t count, double dt_s) const {
  const double r = correlation_s > 0 ? std::exp(-dt_s / correlation_s) : 0;
  const double c2 = coloured * coloured, w2 = white * white;
  double expected = 0, variance = c2;
  for (std::size_t i = 0; i < count; ++i) {
    const double s = variance + w2, innovation = samples[i] - expected;
    samples[i] = innovation / std::sqrt(s);
    expected = r * (expected + variance / s * innovation);
    variance = r * r * variance * w2 / s + (1 - r * r) * c2;
  }
}

Sensor sensor_of(const std::vector<QuietStretch>& stretches, double rounding) {
  Sensor best;
  std::size_t samples = 0;
  double quiet_s = 0;
  for (const QuietStretch& s : stretches) {
    samples += s.samples.size() - 1;
    quiet_s += s.dt_s * static_cast<double>(s.samples.size());
  }
  if (samples >= least_samples) {
    double known = deviance(best, stretches);
    const auto take = [&](const Sensor& other, double numbers) {
      const double found = deviance(other, stretches);
      if (known - found < gsl_cdf_chisq_Pinv(level, numbers)) return;
      best = other;
      known = found;
    };
    take(sized(stretches), 1);
    take(coloured(stretches), 2);
    best.size_error = 1 / std::sqrt(2 * static_cast<double>(samples));
    best.drift_per_s = drift_of(best, stretches);
  }
  best.quiet_s = quiet_s;
  if (best.size() < rounding) best.white = rounding, best.coloured = best.correlation_s = 0;
  return best;
}

}  // namespace freestand::measurement
