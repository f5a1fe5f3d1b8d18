#include "measurement/made_tests.hpp"

#include <cmath>
#include <numbers>

#include "base/random.hpp"
#include "effects/effects.hpp"
#include "measurement/fit/least_squares.hpp"
#include "support/keyed_random.hpp"

namespace freestand::test {

FloorMotion swings(double peak_mps2, double period_s, double dt_s) {
  std::vector<double> a;
  for (int i = 0; i <= std::lround(4 / dt_s); ++i) {
    const double t = dt_s * i - 0.5;
    a.push_back(t > 0 && t < 2 * period_s ? peak_mps2 * std::sin(2 * std::numbers::pi * t / period_s) : 0);
  }
  return piecewise_linear("swings", dt_s, a, {});
}

measurement::Test made_test(const std::string& id, const Specimen& specimen, const FloorMotion& motion,
                            std::uint64_t seed, double dt_s, double noise) {
  measurement::Test test;
  test.id = id;
  test.motion = motion;
  test.dt_s = dt_s;
  test.specimen = {2 * specimen.block.left_m, 2 * specimen.block.height_m, 100.0};
  History history;
  history.step_s = test.dt_s;
  respond(specimen, test.shaking(), {.tolerance = 1e-9, .free_vibration_s = 0}, &history);
  for (std::size_t i = 0; i <= static_cast<std::size_t>(std::lround(4 / dt_s)); ++i) {
    const HistoryPoint& p = history.points[std::min(i, history.points.size() - 1)];
    test.slip_m.push_back(p.slip_m + noise * slip_noise_m * random::standard_normal(seed, i, 1));
    test.rotation_rad.push_back(p.rotation_rad + noise * rotation_noise_rad * random::standard_normal(seed, i, 2));
  }
  return test;
}

measurement::Dataset made_dataset(const Specimen& specimen, double noise, const std::vector<double>& friction) {
  measurement::Dataset data;
  data.name = "made";
  data.sampling_dt_s = 0.005;
  data.noise = {.slip_m = slip_noise_m, .rotation_rad = rotation_noise_rad};
  const struct { double peak, period; } motions[] = {{6, 0.5}, {4, 0.8}, {8, 0.35}, {5, 1.1}, {7, 0.6}};
  std::uint64_t seed = 0;
  for (const auto& m : motions) {
    Specimen of_test = specimen;
    if (!friction.empty()) of_test.friction.mu_k = of_test.friction.mu_s = specimen.friction.mu_k * friction.at(seed);
    ++seed;
    data.tests.push_back(made_test(std::string("t").append(std::to_string(seed)), of_test, swings(m.peak, m.period),
                                   seed, data.sampling_dt_s, noise));
  }
  data.tests.back().role = measurement::Role::holdout;
  return data;
}

measurement::Dataset with_noise(measurement::Dataset data, std::uint64_t key, double correlation_s) {
  KeyedRandom random(9, key);
  const auto add = [&](std::vector<double>& samples, double deviation, double dt_s) {
    const double kept = correlation_s > 0 ? std::exp(-dt_s / correlation_s) : 0;
    double noise = random.normal();
    for (double& sample : samples) {
      sample += deviation * noise;
      noise = kept * noise + std::sqrt(1 - kept * kept) * random.normal();
    }
  };
  for (measurement::Test& t : data.tests) {
    add(t.slip_m, data.noise.slip_m, t.dt_s);
    add(t.rotation_rad, data.noise.rotation_rad, t.dt_s);
  }
  return data;
}

Specimen cabinet(const char* effect, std::vector<double> parameters) {
  Specimen s;
  s.block = Block::rectangular(0.8, 0.6, 100);
  s.friction = {0.2, 0.2};
  if (effect) s.effects = {{.effect = effects::find(effect), .parameters = std::move(parameters)}};
  return s;
}

measurement::ModelFit fitted(const measurement::Bench& bench, measurement::ModelSpec model, std::vector<double> start) {
  measurement::ModelFit fit{.model = std::move(model), .x = std::move(start)};
  measurement::descend_by_derivatives(bench, {&fit}, run_here);
  return fit;
}

}  // namespace freestand::test
