#include "measurement/recover.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/units.hpp"
#include "measurement/ground.hpp"
#include "measurement/score.hpp"
#include "measurement/slips.hpp"

namespace freestand::measurement {
namespace {

constexpr double window_s = 0.06;  // half window of the smoothing
constexpr std::size_t bins = 12;

struct Sample {
  double mu, force;
  std::array<double, 6> at;  // speed, path, direction, position, normal, time
};

constexpr std::array<const char*, 6> names = {"speed_mps", "path_m", "direction", "position_m", "normal_g", "time_s"};
constexpr std::array<const char*, 6> units = {"m/s", "m", "1", "m", "g", "s"};

void sample_slip(const Test& test, const std::vector<double>& floor, const Slip& slip, std::size_t half, double mu_k,
                 bool vertical, double& path, std::vector<Sample>& samples) {
  const std::size_t n = slip.to - slip.from;
  const std::vector<double> part(test.slip_m.begin() + static_cast<long>(slip.from),
                                 test.slip_m.begin() + static_cast<long>(slip.to));
  const double before = path;
  path += std::abs(part.back() - part.front());
  if (n < 2 * half + 3) return;
  const Smooth motion = smooth(part, test.dt_s, half);
  std::vector<double> absolute = part;
  for (std::size_t k = 0; k < n; ++k) absolute[k] += floor[slip.from + k];
  const std::vector<double> accelerations = smooth(absolute, test.dt_s, half).second;
  for (std::size_t k = half + 1; k + half + 1 < n; ++k) {
    const std::size_t i = slip.from + k;
    const double t = static_cast<double>(i) * test.dt_s;
    const double v = vertical && test.has_vertical() ? vertical_acceleration({&test.motion, 1, 1, 1}, t) : 0;
    const double gravity = standard_gravity_mps2 + v;
    if (gravity < 0.2 * standard_gravity_mps2) continue;
    const double total = accelerations[k];
    samples.push_back({-slip.sigma * total / gravity,
                       total + slip.sigma * mu_k * gravity,
                       {std::abs(motion.rate[k]), before + std::abs(motion.value[k] - part.front()), slip.sigma,
                        motion.value[k], gravity / standard_gravity_mps2, t}});
  }
}

std::vector<double> edges(const std::vector<Sample>& samples, std::size_t variable) {
  if (variable == 2) return {-2, 0, 2};
  std::vector<double> values;
  for (const Sample& s : samples) values.push_back(s.at[variable]);
  std::sort(values.begin(), values.end());
  std::vector<double> edge;
  for (std::size_t k = 0; k <= bins; ++k) {
    const double value = values[k * (values.size() - 1) / bins];
    if (edge.empty() || value > edge.back() + 1e-12) edge.push_back(value);
  }
  edge.back() += 1e-9;
  return edge;
}

RecoveredTable table(const std::vector<Sample>& samples, std::size_t variable, std::size_t half) {
  RecoveredTable t;
  t.variable = names[variable];
  t.unit = units[variable];
  t.edge = edges(samples, variable);
  double grand = 0, between = 0, whole = 0;
  for (const Sample& s : samples) grand += s.mu / static_cast<double>(samples.size());
  for (const Sample& s : samples) whole += (s.mu - grand) * (s.mu - grand);
  for (std::size_t b = 0; b + 1 < t.edge.size(); ++b) {
    double n = 0, mu = 0, force = 0, centre = 0, mu2 = 0, force2 = 0;
    for (const Sample& s : samples) {
      if (s.at[variable] < t.edge[b] || s.at[variable] >= t.edge[b + 1]) continue;
      ++n;
      mu += s.mu, mu2 += s.mu * s.mu;
      force += s.force, force2 += s.force * s.force;
      centre += s.at[variable];
    }
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double m = n > 0 ? mu / n : nan, f = n > 0 ? force / n : nan;
    const double sd = std::sqrt(std::max(0.0, n > 1 ? (mu2 - n * m * m) / (n - 1) : 0));
    const double sf = std::sqrt(std::max(0.0, n > 1 ? (force2 - n * f * f) / (n - 1) : 0));
    const double independent = std::max(1.0, n / (2 * static_cast<double>(half) + 1));
    const double band = 1.96 / std::sqrt(independent);
    t.count.push_back(n);
    t.centre.push_back(n > 0 ? centre / n : 0.5 * (t.edge[b] + t.edge[b + 1]));
    t.mu.push_back(m);
    t.mu_deviation.push_back(sd);
    t.mu_lower.push_back(m - band * sd);
    t.mu_upper.push_back(m + band * sd);
    t.force_mps2.push_back(f);
    t.force_lower_mps2.push_back(f - band * sf);
    t.force_upper_mps2.push_back(f + band * sf);
    if (n > 0) between += n * (m - grand) * (m - grand);
  }
  t.share_explained = whole > 0 ? between / whole : 0;
  return t;
}

}  // namespace

Recovered recover(const Bench& bench, double mu_k, bool vertical) {
  std::vector<Sample> samples;
  Recovered out;
  std::size_t half = 0;
  for (const std::size_t i : tests_of(bench.data(), Role::calibration)) {
    const Test& test = bench.test(i);
    if (test.slip_m.empty()) continue;
    half = std::max<std::size_t>(2, static_cast<std::size_t>(window_s / test.dt_s));
    const double noise = bench.noise(Channel::slip);
    const Smooth motion = smooth(test.slip_m, test.dt_s, std::max<std::size_t>(2, half / 3));
    const double least = 4 * noise * rate_noise(test.dt_s, std::max<std::size_t>(2, half / 3));
    const std::vector<double> floor = floor_displacement(test);
    double path = 0;
    for (const Slip& slip : slips(test, motion, least, bench.noise(Channel::rotation)))
      sample_slip(test, floor, slip, half, mu_k, vertical, path, samples);
    out.sample_noise_mu = noise * second_noise(test.dt_s, half) / standard_gravity_mps2;
  }
  out.samples = samples.size();
  if (samples.size() < 4 * bins) return out;
  for (const Sample& s : samples) out.mean_mu += s.mu / static_cast<double>(samples.size());
  for (std::size_t variable = 0; variable < names.size(); ++variable)
    out.tables.push_back(table(samples, variable, half));
  return out;
}

}  // namespace freestand::measurement
