#include "measurement/tell/recover.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/units.hpp"
#include "measurement/data/ground.hpp"
#include "measurement/data/slips.hpp"
#include "measurement/predict/score.hpp"
#include "measurement/predict/sliding_law.hpp"

namespace freestand::measurement {
namespace {

constexpr double window_s = 0.06;               // half window of the smoothing
constexpr double slip_window_s = window_s / 3;  // of that which finds the slips
constexpr double least_time_s = 4 * window_s;   // two windows that share no sample
constexpr std::size_t recovered_bins = 12;
constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

// An instant of a slip, what friction was recovered there, and what the shown model gives.
struct SlipSample {
  Sliding at;
  double gravity_mps2, mu, force_mps2, law;
  double step_s;  // for which it stands: a test counts for as long as it slips, whatever its rate
  const SlidingLaw* shown;
};

// What friction may depend on.
struct SlipVariable {
  const char *name, *unit;
  double Sliding::*of_slip;
};
constexpr std::array<SlipVariable, 6> slip_variables = {{{"speed_mps", "m/s", &Sliding::speed_mps},
                                                         {"path_m", "m", &Sliding::path_m},
                                                         {"direction", "1", &Sliding::sigma},
                                                         {"position_m", "m", &Sliding::position_m},
                                                         {"normal_g", "g", &Sliding::vertical_mps2},
                                                         {"time_s", "s", &Sliding::time_s}}};

double value(const SlipSample& sample, const SlipVariable& variable) {
  const bool normal = variable.of_slip == &Sliding::vertical_mps2;
  return normal ? sample.gravity_mps2 / standard_gravity_mps2 : sample.at.*variable.of_slip;
}

void sample_slip(const Test& test, const std::vector<double>& floor, const Slip& slip, double mu_k,
                 const SlidingLaw& shown, double& path, std::vector<SlipSample>& samples) {
  const std::size_t n = slip.to - slip.from, half = half_window_samples(window_s, test.dt_s);
  const std::vector<double> part(test.slip_m.begin() + static_cast<long>(slip.from),
                                 test.slip_m.begin() + static_cast<long>(slip.to));
  const double before = path;
  path += std::abs(part.back() - part.front());
  if (n < 2 * half + 3) return;
  const Smooth motion = smooth(part, test.dt_s, window_s);
  std::vector<double> absolute = part;
  for (std::size_t k = 0; k < n; ++k) absolute[k] += floor[slip.from + k];
  const std::vector<double> accelerations = smooth(absolute, test.dt_s, window_s).second;
  for (std::size_t k = half + 1; k + half + 1 < n; ++k) {
    const double t = static_cast<double>(slip.from + k) * test.dt_s;
    const double v = test.has_vertical() ? vertical_acceleration({&test.motion, 1, 1, 1}, t) : 0;
    const double gravity = shown.gravity_mps2(v), total = accelerations[k];
    if (gravity < 0.2 * standard_gravity_mps2) continue;
    const Sliding at = {
        std::abs(motion.rate[k]), before + std::abs(motion.value[k] - part.front()), slip.sigma, motion.value[k], v, t};
    samples.push_back({at, gravity, -slip.sigma * total / gravity, total + slip.sigma * mu_k * gravity,
                       shown.friction(at), test.dt_s, &shown});
  }
}

// So that about as much time falls into each bin.
std::vector<double> edges(const std::vector<SlipSample>& samples, const SlipVariable& variable) {
  if (variable.of_slip == &Sliding::sigma) return {-2, 0, 2};
  std::vector<std::pair<double, double>> values;  // and the time that each stands for
  double whole = 0, passed = 0;
  for (const SlipSample& s : samples) {
    values.push_back({value(s, variable), s.step_s});
    whole += s.step_s;
  }
  std::sort(values.begin(), values.end());
  std::vector<double> edge = {values.front().first};
  for (const auto& [here, time] : values) {
    passed += time;
    const auto wanted = static_cast<double>(edge.size()) / recovered_bins;
    if (edge.size() < recovered_bins && passed >= wanted * whole && here > edge.back() + 1e-12) edge.push_back(here);
  }
  const double last = values.back().first;
  if (last > edge.back() + 1e-12) edge.push_back(last);
  edge.back() += 1e-9;
  return edge;
}

// Mean and standard deviation of one quantity of the samples in a bin.
struct Mean {
  double time = 0, sum = 0, square = 0;
  void add(double x, double t) { time += t, sum += t * x, square += t * x * x; }
  double mean() const { return time > 0 ? sum / time : undefined; }
  // n: how many samples it is of.
  double deviation(double n) const {
    if (n < 2) return time > 0 ? 0 : undefined;
    return std::sqrt(std::max(0.0, square / time - mean() * mean()) * n / (n - 1));
  }
};

double share_between(double between, const Mean& all) {
  const double whole = all.square - all.time * all.mean() * all.mean();
  return whole > 0 ? between / whole : 0;
}

// Does the shown law change with this variable alone? Tried at some samples with the values of some others.
bool follows(const std::vector<SlipSample>& samples, const SlipVariable& variable) {
  const std::size_t step = std::max<std::size_t>(1, samples.size() / 16);
  for (std::size_t i = 0; i < samples.size(); i += step) {
    Sliding at = samples[i].at;
    double least = samples[i].law, most = least;
    for (std::size_t k = 0; k < samples.size(); k += step) {
      at.*variable.of_slip = samples[k].at.*variable.of_slip;
      const double mu = samples[i].shown->friction(at);
      least = std::min(least, mu), most = std::max(most, mu);
    }
    if (most - least > 1e-6 * std::abs(most)) return true;
  }
  return false;
}

RecoveredTable table(const std::vector<SlipSample>& samples, const SlipVariable& variable) {
  RecoveredTable t;
  t.variable = variable.name;
  t.unit = variable.unit;
  t.edge = edges(samples, variable);
  t.law_follows = follows(samples, variable);
  Mean all, all_forces;
  for (const SlipSample& s : samples) all.add(s.mu, s.step_s), all_forces.add(s.force_mps2, s.step_s);
  double between = 0, between_forces = 0;
  for (std::size_t b = 0; b + 1 < t.edge.size(); ++b) {
    Mean mu, force, law, law_force, centre;
    double n = 0;
    for (const SlipSample& s : samples) {
      const double at = value(s, variable);
      if (at < t.edge[b] || at >= t.edge[b + 1]) continue;
      ++n;
      mu.add(s.mu, s.step_s), force.add(s.force_mps2, s.step_s);
      law.add(s.law, s.step_s), centre.add(at, s.step_s);
      law_force.add(s.force_mps2 + s.at.sigma * (s.mu - s.law) * s.gravity_mps2, s.step_s);
    }
    const double sd = mu.deviation(n), sf = force.deviation(n);
    const double band = 1.96 / std::sqrt(std::max(1.0, mu.time / (2 * window_s)));
    t.count.push_back(n);
    t.centre.push_back(n > 0 ? centre.mean() : 0.5 * (t.edge[b] + t.edge[b + 1]));
    t.mu.push_back(mu.mean());
    t.mu_deviation.push_back(sd);
    t.mu_lower.push_back(mu.mean() - band * sd);
    t.mu_upper.push_back(mu.mean() + band * sd);
    t.force_mps2.push_back(force.mean());
    t.force_lower_mps2.push_back(force.mean() - band * sf);
    t.force_upper_mps2.push_back(force.mean() + band * sf);
    t.law.push_back(law.mean());
    t.law_force_mps2.push_back(law_force.mean());
    if (n == 0) continue;
    between += mu.time * std::pow(mu.mean() - all.mean(), 2);
    between_forces += force.time * std::pow(force.mean() - all_forces.mean(), 2);
  }
  t.share_explained = share_between(between, all);
  t.share_of_force_explained = share_between(between_forces, all_forces);
  return t;
}

}  // namespace

Recovered recover(const Bench& bench, double mu_k, const ModelSpec& shown, std::span<const double> x) {
  std::vector<SlipSample> samples;
  std::vector<SlidingLaw> laws;
  Mean noise_square;
  const std::vector<std::size_t> tests = tests_of(bench.data(), Role::calibration);
  laws.reserve(tests.size());  // the samples point to them
  for (const std::size_t i : tests) {
    const Test& test = bench.test(i);
    if (test.slip_m.empty()) continue;
    const SlidingLaw& law = laws.emplace_back(specimen(shown, test, x));
    const double noise = bench.noise(Channel::slip);
    const Smooth motion = smooth(test.slip_m, test.dt_s, slip_window_s);
    const double least = 4 * noise * rate_noise(test.dt_s, slip_window_s);
    const std::vector<double> floor = floor_displacement(test);
    const std::size_t before = samples.size();
    double path = 0;
    for (const Slip& slip : slips(test, motion, least, bench.noise(Channel::rotation)))
      sample_slip(test, floor, slip, mu_k, law, path, samples);
    const double of_sample = noise * second_noise(test.dt_s, window_s) / standard_gravity_mps2;
    noise_square.add(of_sample * of_sample, test.dt_s * static_cast<double>(samples.size() - before));
  }
  Recovered out;
  out.samples = samples.size();
  Mean mu;
  for (const SlipSample& s : samples) mu.add(s.mu, s.step_s);
  if (mu.time < least_time_s) return out;
  out.mean_mu = mu.mean();
  out.sample_noise_mu = std::sqrt(noise_square.mean());
  for (const SlipVariable& variable : slip_variables) out.tables.push_back(table(samples, variable));
  return out;
}

}  // namespace freestand::measurement
