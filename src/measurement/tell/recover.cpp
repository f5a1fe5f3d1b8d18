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
constexpr double band_95 = 1.96;
constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

// What the sensors of a test make of an acceleration that is recovered from 2 half + 1 readings of the slip.
struct Sensed {
  std::vector<double> weights;  // of these readings: curvature of the quadratic through them [1/s2]
  double slip_noise_m, floor_noise_mps2;
  std::size_t half() const { return weights.size() / 2; }
};

Sensed sensed(const Bench& bench, std::size_t test) {
  const double dt_s = bench.test(test).dt_s;
  const std::size_t half = half_window_samples(window_s, dt_s), count = 2 * half + 1;
  Sensed out{{}, bench.noise(Channel::slip), bench.floor_noise_mps2(test)};
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<double> one(count);
    one[i] = 1;
    out.weights.push_back(smooth(one, dt_s, window_s).second[half]);
  }
  return out;
}

// An instant of a slip, what friction was recovered there, and what the shown model gives.
struct SlipSample {
  Sliding at;
  double gravity_mps2, mu, force_mps2, law;
  double step_s;  // for which it stands: a test counts for as long as it slips, whatever its rate
  const SlidingLaw* shown;
  const Sensed* sensed;
  std::size_t slip, reading;  // of all slips; of those in it, the one at this instant
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
                 const SlidingLaw& shown, const Sensed& sensed, double& path, std::vector<SlipSample>& samples) {
  const std::size_t n = slip.to - slip.from, half = sensed.half();
  const std::size_t number = samples.empty() ? 0 : samples.back().slip + 1;
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
                       shown.friction(at), test.dt_s, &shown, &sensed, number, k});
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

double share_of(double part, const Mean& all) {
  const double whole = all.square - all.time * all.mean() * all.mean();
  return whole > 0 ? std::min(1.0, part / whole) : 0;
}

// What the sensors' noise makes of the mean of a bin. Windows overlap, so that a reading enters many samples, with weights of both signs: what
// is left of it in the mean is small.
class NoiseOfMean {
 public:
  void add(const SlipSample& s, double factor) {
    const Sensed& sensed = *s.sensed;
    if (time_ == 0 || s.slip != slip_) end_slip();
    slip_ = s.slip;
    slip_noise_ = sensed.slip_noise_m;
    const std::size_t first = s.reading - sensed.half();
    if (weights_.size() < first + sensed.weights.size()) weights_.resize(first + sensed.weights.size());
    double of_sample = 0;
    for (std::size_t j = 0; j < sensed.weights.size(); ++j) {
      weights_[first + j] += s.step_s * factor * sensed.weights[j];
      of_sample += std::pow(factor * sensed.weights[j] * slip_noise_, 2);
    }
    time_ += s.step_s, time_of_slip_ += s.step_s;
    of_samples_ += s.step_s * of_sample;
    noise_ += std::pow(s.step_s * factor * sensed.floor_noise_mps2, 2);
  }

  void end_slip() {
    for (const double w : weights_) noise_ += std::pow(w * slip_noise_, 2);
    weights_.clear();
    slips_ += time_of_slip_ * time_of_slip_;
    time_of_slip_ = 0;
  }
  double time() const { return time_; }
  double of_sample() const { return time_ > 0 ? of_samples_ / time_ : 0; }     // variance of a single sample
  double of_mean() const { return time_ > 0 ? noise_ / (time_ * time_) : 0; }  // of their mean
  double a_slip() const { return time_ > 0 ? slips_ / (time_ * time_) : 0; }   // one over how many slips there are

 private:
  std::vector<double> weights_;  // of the readings of this slip
  std::size_t slip_ = 0;
  double slip_noise_ = 0, time_ = 0, time_of_slip_ = 0, noise_ = 0, of_samples_ = 0;
  double slips_ = 0;  // sum of squares of their times
};

// Variances of the means of all bins: what the noise makes, and what friction makes by what else differs from slip to slip, which scatters the
// samples beyond their noise in all bins alike.
std::vector<double> variances(const std::vector<NoiseOfMean>& noise, const std::vector<double>& deviation) {
  double beyond = 0, time = 0;
  for (std::size_t b = 0; b < noise.size(); ++b) {
    if (noise[b].time() == 0) continue;
    time += noise[b].time();
    beyond += noise[b].time() * (deviation[b] * deviation[b] - noise[b].of_sample() + noise[b].of_mean());
  }
  std::vector<double> all;
  for (const NoiseOfMean& n : noise)
    all.push_back(n.of_mean() + (time > 0 ? std::max(0.0, beyond / time) : 0) * n.a_slip());
  return all;
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
  const std::size_t bins = t.edge.size() - 1;
  std::vector<NoiseOfMean> noise_of_mu(bins), noise_of_force(bins);
  std::vector<double> force_deviation;
  double between = 0, between_forces = 0;
  for (std::size_t b = 0; b < bins; ++b) {
    Mean mu, force, law, law_force, centre;
    double n = 0;
    for (const SlipSample& s : samples) {
      const double at = value(s, variable);
      if (at < t.edge[b] || at >= t.edge[b + 1]) continue;
      ++n;
      mu.add(s.mu, s.step_s), force.add(s.force_mps2, s.step_s);
      noise_of_mu[b].add(s, 1 / s.gravity_mps2), noise_of_force[b].add(s, 1);
      law.add(s.law, s.step_s), centre.add(at, s.step_s);
      law_force.add(s.force_mps2 + s.at.sigma * (s.mu - s.law) * s.gravity_mps2, s.step_s);
    }
    noise_of_mu[b].end_slip(), noise_of_force[b].end_slip();
    t.count.push_back(n);
    t.centre.push_back(n > 0 ? centre.mean() : 0.5 * (t.edge[b] + t.edge[b + 1]));
    t.mu.push_back(mu.mean());
    t.mu_deviation.push_back(mu.deviation(n));
    t.force_mps2.push_back(force.mean());
    force_deviation.push_back(force.deviation(n));
    t.law.push_back(law.mean());
    t.law_force_mps2.push_back(law_force.mean());
    if (n == 0) continue;
    between += mu.time * std::pow(mu.mean() - all.mean(), 2);
    between_forces += force.time * std::pow(force.mean() - all_forces.mean(), 2);
  }
  const std::vector<double> of_mu = variances(noise_of_mu, t.mu_deviation),
                            of_force = variances(noise_of_force, force_deviation);
  double chance = 0, chance_of_forces = 0;
  for (std::size_t b = 0; b < bins; ++b) {
    const double band = band_95 * std::sqrt(of_mu[b]), band_of_force = band_95 * std::sqrt(of_force[b]);
    t.mu_lower.push_back(t.mu[b] - band);
    t.mu_upper.push_back(t.mu[b] + band);
    t.force_lower_mps2.push_back(t.force_mps2[b] - band_of_force);
    t.force_upper_mps2.push_back(t.force_mps2[b] + band_of_force);
    chance += noise_of_mu[b].time() * of_mu[b], chance_of_forces += noise_of_force[b].time() * of_force[b];
  }
  t.share_explained = share_of(between, all);
  t.share_of_force_explained = share_of(between_forces, all_forces);
  t.share_by_chance = share_of(chance, all);
  t.share_of_force_by_chance = share_of(chance_of_forces, all_forces);
  return t;
}

}  // namespace

Recovered recover(const Bench& bench, double mu_k, const ModelSpec& shown, std::span<const double> x) {
  std::vector<SlipSample> samples;
  std::vector<SlidingLaw> laws;
  std::vector<Sensed> sensors;
  Mean noise_square;
  const std::vector<std::size_t> tests = tests_of(bench.data(), Role::calibration);
  laws.reserve(tests.size());  // the samples point to them
  sensors.reserve(tests.size());
  for (const std::size_t i : tests) {
    const Test& test = bench.test(i);
    if (test.slip_m.empty()) continue;
    const SlidingLaw& law = laws.emplace_back(specimen(shown, test, x));
    const Sensed& of_test = sensors.emplace_back(sensed(bench, i));
    const double noise = bench.noise(Channel::slip);
    const Smooth motion = smooth(test.slip_m, test.dt_s, slip_window_s);
    const double least = 4 * noise * rate_noise(test.dt_s, slip_window_s);
    const std::vector<double> floor = floor_displacement(test);
    const std::size_t before = samples.size();
    double path = 0;
    for (const Slip& slip : slips(test, motion, least, bench.noise(Channel::rotation)))
      sample_slip(test, floor, slip, mu_k, law, of_test, path, samples);
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
