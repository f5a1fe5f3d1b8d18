#include "measurement/made_tests.hpp"

#include <cmath>
#include <numbers>

#include "base/random.hpp"

namespace freestand::test {
namespace {

double normal(std::uint64_t seed, std::uint64_t i, std::uint64_t stream) {
  const auto [a, b] = random::bits(seed, i, stream);
  return std::sqrt(-2 * std::log(random::unit_interval(a))) * std::cos(2 * std::numbers::pi * random::unit_interval(b));
}

}  // namespace

FloorMotion swings(double peak_mps2, double period_s, double dt_s) {
  std::vector<double> a;
  for (int i = 0; i <= std::lround(4 / dt_s); ++i) {
    const double t = dt_s * i - 0.5;
    a.push_back(t > 0 && t < 2 * period_s ? peak_mps2 * std::sin(2 * std::numbers::pi * t / period_s) : 0);
  }
  return piecewise_linear("swings", dt_s, a, {});
}

measurement::Test made_test(const std::string& id, const Specimen& specimen, const FloorMotion& motion,
                            std::uint64_t seed, double dt_s) {
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
    test.slip_m.push_back(p.slip_m + slip_noise_m * normal(seed, i, 1));
    test.rotation_rad.push_back(p.rotation_rad + rotation_noise_rad * normal(seed, i, 2));
  }
  return test;
}

measurement::Dataset made_dataset(const Specimen& specimen) {
  measurement::Dataset data;
  data.name = "made";
  data.sampling_dt_s = 0.005;
  data.noise = {.slip_m = slip_noise_m, .rotation_rad = rotation_noise_rad};
  const struct { double peak, period; } motions[] = {{6, 0.5}, {4, 0.8}, {8, 0.35}, {5, 1.1}, {7, 0.6}};
  std::uint64_t seed = 0;
  for (const auto& m : motions) {
    ++seed;
    data.tests.push_back(
        made_test(std::string("t").append(std::to_string(seed)), specimen, swings(m.peak, m.period), seed));
  }
  data.tests.back().role = measurement::Role::holdout;
  return data;
}

measurement::ModelSpec free_friction() {
  measurement::ModelSpec model;
  model.mu_k.free = 0;
  model.free = {
      {.name = "friction.mu", .unit = "1", .lower = 0.03, .upper = 1.2, .low = 0.03, .high = 1.2, .logarithmic = true}};
  return model;
}

}  // namespace freestand::test
