#include "support/plane_motions.hpp"

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "support/keyed_random.hpp"

namespace freestand::test {

FloorMotion in_plane(FloorMotion along, const FloorMotion& across) {
  along.cross_mps2 = across.horizontal_mps2;
  index_runs(along);
  return along;
}

FloorMotion turned(const FloorMotion& motion, double angle_rad) {
  FloorMotion result = motion;
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  for (std::size_t i = 0; i < motion.horizontal_mps2.size(); ++i) {
    result.horizontal_mps2[i] = c * motion.horizontal_mps2[i] - s * motion.cross_mps2[i];
    result.cross_mps2[i] = s * motion.horizontal_mps2[i] + c * motion.cross_mps2[i];
  }
  index_runs(result);
  return result;
}

namespace {

std::vector<double> shaken(KeyedRandom& random, std::size_t size, double dt, double frequency_hz, double peak) {
  const double W = 2 * pi * frequency_hz, damping = 0.3;
  std::vector<double> values;
  double x = 0, v = 0, most = 0;
  for (std::size_t i = 0; i < size; ++i) {
    v += (random.normal() - W * W * x - 2 * damping * W * v) * dt;
    x += v * dt;
    const double t = static_cast<double>(i) / static_cast<double>(size);
    values.push_back((W * W * x + 2 * damping * W * v) * std::min({1.0, 5 * t, 3 * (1 - t)}));
    most = std::max(most, std::abs(values.back()));
  }
  for (double& value : values) value *= peak / most;
  return values;
}

}  // namespace

PlaneCase plane_case(std::uint64_t number) {
  KeyedRandom random(7, number);
  PlaneCase c;
  c.dt_s = number % 2 ? 0.01 : 0.005;
  const double mu = random.log_uniform(0.05, 0.6), ratio = random.chance(0.4) ? random.uniform(1, 1.5) : 1;
  const double grip = mu * ratio * standard_gravity_mps2;
  const auto size = static_cast<std::size_t>(5 / c.dt_s);
  c.x = shaken(random, size, c.dt_s, random.log_uniform(0.5, 5), grip * random.log_uniform(0.8, 5));
  c.y = shaken(random, size, c.dt_s, random.log_uniform(0.5, 5), grip * random.log_uniform(0.3, 4));
  // Up to 1.4 g: some are thrown up.
  if (random.chance(0.4))
    c.up = shaken(random, size, c.dt_s, random.log_uniform(2, 10), standard_gravity_mps2 * random.uniform(0.1, 1.4));
  c.specimen.block = Block::rectangular(0.6, 1.2, 100);
  c.specimen.friction = {mu * ratio, mu};
  c.specimen.model = Model::slide;
  return c;
}

FloorMotion PlaneCase::motion() const {
  FloorMotion motion = piecewise_linear("random in the plane", dt_s, x, up);
  add_cross(motion, dt_s, y);
  return motion;
}

std::string PlaneCase::text() const {
  return "mu_s " + std::to_string(specimen.friction.mu_s) + " mu_k " + std::to_string(specimen.friction.mu_k) +
         (up.empty() ? "" : " vertical");
}

}  // namespace freestand::test
