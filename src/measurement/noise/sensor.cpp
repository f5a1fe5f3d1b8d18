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

// Kalman's filter for equally spaced samples: from where nothing is known of the coloured noise but its size.
struct Filter {
  double kept;                         // from one sample to the next, of the coloured noise
  std::vector<double> variance, gain;  // of innovations; what the coloured noise has of an innovation
  Filter(const Sensor& sensor, double dt_s, std::size_t count)
      : kept(sensor.correlation_s > 0 ? std::exp(-dt_s / sensor.correlation_s) : 0), variance(count), gain(count) {
    const double c2 = sensor.coloured * sensor.coloured, w2 = sensor.white * sensor.white;
    double unknown = c2;
    for (std::size_t i = 0; i < count; ++i) {
      variance[i] = unknown + w2;
      gain[i] = unknown / variance[i];
      unknown = kept * kept * unknown * w2 / variance[i] + (1 - kept * kept) * c2;
    }
  }
  void whiten(double* samples, std::size_t count) const {
    double expected = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double innovation = samples[i] - expected;
      samples[i] = innovation / std::sqrt(variance[i]);
      expected = kept * (expected + gain[i] * innovation);
    }
  }
};

// -2 ln of the likelihood that the stretches' differences have, but for what does not depend on the sensor: the mean of each is
// integrated out (restricted likelihood).
class Deviance {
 public:
  explicit Deviance(const std::vector<QuietStretch>& stretches) : stretches_(stretches) {
    for (const QuietStretch& s : stretches) {
      std::size_t& longest = longest_[s.dt_s];
      longest = std::max(longest, s.samples.size());
    }
  }
  double operator()(const Sensor& sensor) const {
    double sum = 0;
    for (const auto& [dt_s, longest] : longest_) {
      const Filter filter(sensor, dt_s, longest);
      std::vector<double> one(longest, 1.0), ones(1, 0.0), logs(1, 0.0), y;
      filter.whiten(one.data(), longest);
      for (std::size_t i = 0; i < longest; ++i) {
        ones.push_back(ones.back() + one[i] * one[i]);
        logs.push_back(logs.back() + std::log(filter.variance[i]));
      }
      for (const QuietStretch& stretch : stretches_) {
        if (stretch.dt_s != dt_s) continue;
        y = stretch.samples;
        filter.whiten(y.data(), y.size());
        double yy = 0, y1 = 0;
        for (std::size_t i = 0; i < y.size(); ++i) yy += y[i] * y[i], y1 += y[i] * one[i];
        sum += yy - y1 * y1 / ones[y.size()] + logs[y.size()] + std::log(ones[y.size()]);
      }
    }
    return sum;
  }

 private:
  const std::vector<QuietStretch>& stretches_;
  std::map<double, std::size_t> longest_;  // stretch, of each step
};

Free free_number(const char* name, double low, double high) {
  return {.name = name, .lower = low, .upper = high, .low = low, .high = high, .logarithmic = true};
}

Sensor sized(const Deviance& deviance) {
  const std::vector<Free> free = {free_number("white", 0.01, 100)};
  const Fitted found = simplex(
      free, [&](std::span<const double> x) { return deviance({.white = x[0]}); }, {1.0}, 0.1, 60);
  return {.white = found.x[0]};
}

// Of correlations that stretches can tell.
std::pair<double, double> correlations_s(const std::vector<QuietStretch>& stretches) {
  double longest = 0;
  const double dt = stretches.front().dt_s;
  for (const QuietStretch& s : stretches) longest = std::max(longest, s.dt_s * static_cast<double>(s.samples.size()));
  return {dt, std::max(longest, 4 * dt)};
}

Sensor coloured(const Deviance& deviance, double shortest, double longest) {
  const std::vector<Free> free = {free_number("white", 0.01, 100), free_number("coloured", 0.01, 100),
                                  free_number("correlation", shortest, longest)};
  const auto sensor = [](std::span<const double> x) {
    return Sensor{.white = x[0], .coloured = x[1], .correlation_s = x[2]};
  };
  Fitted best{{}, 1e300};
  for (const double white : {0.1, 0.8})
    for (const double share : {0.1, 0.5}) {
      const Values start = {white, 0.6, shortest * std::pow(longest / shortest, share)};
      const Fitted found = simplex(
          free, [&](std::span<const double> x) { return deviance(sensor(x)); }, start, 0.1, 200);
      if (found.score < best.score) best = found;
    }
  return sensor(best.x);
}

// Sensor::slow_powers. Each correlation is as likely as the best white and coloured noise beside it makes it; ten times longer or shorter than
// the best none is likely at all.
std::vector<double> slow_powers(const Sensor& best, const Deviance& deviance, double shortest, double longest) {
  constexpr int steps = 40;
  constexpr int values = 50;
  const double from = std::max(shortest, best.correlation_s / 10), to = std::min(longest, best.correlation_s * 10);
  const std::vector<Free> free = {free_number("white", 0.01, 100), free_number("coloured", 0.01, 100)};
  const double least = deviance(best);
  std::vector<double> log_power, below = {0};
  for (int i = 0; i <= steps; ++i) {
    const double correlation_s = from * std::pow(to / from, static_cast<double>(i) / steps);
    const double times = correlation_s / best.correlation_s;
    const Fitted found = simplex(
        free,
        [&](std::span<const double> x) {
          return deviance({.white = x[0], .coloured = x[1], .correlation_s = correlation_s});
        },
        {best.white, best.coloured * std::sqrt(times)}, 0.03, 40);
    log_power.push_back(std::log(times) + 2 * std::log(found.x[1] / best.coloured));
    below.push_back(below.back() + std::exp(-0.5 * (found.score - least)));
  }
  // A share belongs to what lies nearer to its correlation than to the next.
  const auto edge = [&](std::size_t i) {
    return i == 0 || i > steps ? log_power[std::min<std::size_t>(i, steps)] : 0.5 * (log_power[i - 1] + log_power[i]);
  };
  std::vector<double> equally_likely;
  for (int k = 0; k < values; ++k) {
    const double share = (k + 0.5) / values * below.back();
    const auto i = static_cast<std::size_t>(std::upper_bound(below.begin(), below.end(), share) - below.begin()) - 1;
    const double within = (share - below[i]) / (below[i + 1] - below[i]);
    equally_likely.push_back(std::exp(edge(i) + within * (edge(i + 1) - edge(i))));
  }
  std::sort(equally_likely.begin(), equally_likely.end());
  return equally_likely;
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
  if (coloured == 0)
    for (std::size_t i = 0; i < count; ++i) samples[i] /= white;
  else
    Filter(*this, dt_s, count).whiten(samples, count);
}

// Backwards, since what enters a sample enters the expectation of those behind it.
void Sensor::whiten_transposed(double* weights, std::size_t count, double dt_s, std::size_t series) const {
  const Filter filter(*this, dt_s, count);
  for (; series > 0; --series, weights += count) {
    double of_expected = 0;
    for (std::size_t i = count; i-- > 0;) {
      const double of_innovation = weights[i] / std::sqrt(filter.variance[i]);
      weights[i] = of_innovation + filter.kept * filter.gain[i] * of_expected;
      of_expected = filter.kept * (1 - filter.gain[i]) * of_expected - of_innovation;
    }
  }
}

void Sensor::colour_transposed(double* weights, std::size_t count, double dt_s) const {
  const double r = std::exp(-dt_s / correlation_s), fresh = std::sqrt(1 - r * r) * coloured;
  double behind = 0;
  for (std::size_t i = count; i-- > 0;) {
    behind = weights[i] + r * behind;
    weights[i] = (i > 0 ? fresh : coloured) * behind;
  }
}

Sensor Sensor::with_slow_power(double times) const {
  Sensor other = *this;
  other.coloured *= std::pow(times, 0.25);
  other.correlation_s *= std::sqrt(times);
  return other;
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
    const Deviance deviance(stretches);
    const auto [shortest, longest] = correlations_s(stretches);
    double known = deviance(best);
    const auto take = [&](const Sensor& other, double numbers) {
      const double found = deviance(other);
      if (known - found < gsl_cdf_chisq_Pinv(level, numbers)) return;
      best = other;
      known = found;
    };
    take(sized(deviance), 1);
    take(coloured(deviance, shortest, longest), 2);
    best.size_error = 1 / std::sqrt(2 * static_cast<double>(samples));
    best.drift_per_s = drift_of(best, stretches);
    if (best.coloured > 0) best.slow_powers = slow_powers(best, deviance, shortest, longest);
  }
  best.quiet_s = quiet_s;
  if (best.size() < rounding) best.white = rounding, best.coloured = best.correlation_s = 0, best.slow_powers.clear();
  return best;
}

}  // namespace freestand::measurement
