#include "support/random_cases.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "base/units.hpp"
#include "support/keyed_random.hpp"

namespace freestand::test {
namespace {

// x'' + 2 z w x' + w^2 x = noise, by the semi-implicit rule; the output is 2 z w x' + w^2 x (Kanai and Tajimi).
std::vector<double> filtered_noise(KeyedRandom& random, std::size_t count, double dt) {
  const double w = 2 * pi * random.log_uniform(0.7, 6), z = random.uniform(0.2, 0.7);
  const double last = static_cast<double>(count - 1);
  std::vector<double> out(count);
  double x = 0, v = 0;
  for (std::size_t i = 0; i < count; ++i) {
    v = (v + dt * (random.normal() - w * w * x)) / (1 + 2 * z * w * dt);
    x += dt * v;
    const double part = static_cast<double>(i) / last;
    out[i] = (2 * z * w * v + w * w * x) * std::min({1.0, 8 * part, 4 * (1 - part)});
  }
  return out;
}

void scale_to(std::vector<double>& values, double peak) {
  double most = 0;
  for (const double x : values) most = std::max(most, std::abs(x));
  for (double& x : values) x *= peak / most;
}

void add_pulse(KeyedRandom& random, std::vector<double>& values, double dt) {
  const double period = random.log_uniform(0.3, 2), start = random.uniform(0.3, 2.5), height = random.uniform(0.5, 2);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double t = static_cast<double>(i) * dt - start;
    if (t > 0 && t < period) values[i] += height * std::sin(2 * pi * t / period);
  }
}

Block random_block(KeyedRandom& random, const CaseFamily& family) {
  const double alpha = random.uniform(family.alpha_low, family.alpha_high);
  const double size = random.log_uniform(family.size_low_m, family.size_high_m);
  Block block = Block::rectangular(2 * size * std::sin(alpha), 2 * size * std::cos(alpha), 100);
  const double shift = random.uniform(-0.5, 0.5), inertia = random.uniform(0.7, 1.3);
  if (random.chance(family.asymmetric)) {
    block.left_m *= 1 + shift;
    block.right_m *= 1 - shift;
    block.gyration2_m2 *= inertia;
  }
  return block;
}

Specimen random_specimen(KeyedRandom& random, const CaseFamily& family) {
  Specimen specimen;
  specimen.block = random_block(random, family);
  const double mu = random.uniform(family.mu_low, family.mu_high), ratio = random.uniform(0.5, 1);
  specimen.friction = {mu, random.chance(family.two_coefficients) ? mu * ratio : mu};
  const double factor = random.chance(0.5) ? 1 : random.uniform(0.7, 1);
  specimen.impact = {ImpactLaw::housner, factor};
  if (random.chance(family.coulomb)) specimen.impact = {ImpactLaw::coulomb, 1};
  const bool one_model = random.chance(family.one_model), slides = random.chance(0.5);
  if (one_model) specimen.model = slides ? Model::slide : Model::rock;
  return specimen;
}

}  // namespace

RandomCase random_case(const CaseFamily& family, std::uint64_t number) {
  KeyedRandom random(family.seed, number);
  RandomCase result;
  result.specimen = random_specimen(random, family);
  const double dt = random.chance(0.5) ? 0.005 : (random.chance(0.5) ? 0.01 : 0.02);
  const double duration = random.uniform(family.duration_low_s, family.duration_high_s);
  const auto count = static_cast<std::size_t>(duration / dt) + 1;
  std::vector<double> horizontal = filtered_noise(random, count, dt), vertical;
  scale_to(horizontal, 1);
  if (random.chance(family.pulse)) add_pulse(random, horizontal, dt);
  const double threshold = std::min(result.specimen.friction.mu_s, std::tan(result.specimen.block.alpha_rad()));
  scale_to(horizontal, standard_gravity_mps2 * threshold * random.log_uniform(family.excess_low, family.excess_high));
  const bool shakes = random.chance(family.vertical);
  if (shakes) {
    vertical = filtered_noise(random, count, dt);
    scale_to(vertical, standard_gravity_mps2 * family.vertical_peak_g * random.uniform(0.1, 1));
  }
  result.motion = std::make_shared<FloorMotion>(piecewise_linear("random", dt, horizontal, vertical));
  result.shaking = {result.motion.get(), random.chance(0.5) ? 1.0 : -1.0, 1.0, shakes ? 1.0 : 0.0};
  return result;
}

std::string RandomCase::text() const {
  constexpr const char* models[] = {"slide", "rock", "slide_rock", "bouc_wen"};
  const Block& b = specimen.block;
  char line[200];
  std::snprintf(line, sizeof line, "b_l %.3f b_r %.3f h %.3f k2 %.3f mu_s %.3f mu_k %.3f %s%s%s dt %.3f end %.1f s",
                b.left_m, b.right_m, b.height_m, b.gyration2_m2, specimen.friction.mu_s, specimen.friction.mu_k,
                models[static_cast<int>(specimen.model)],
                specimen.impact.law == ImpactLaw::coulomb ? " coulomb" : " housner",
                shaking.vertical_scale != 0 ? " vertical" : "", motion->knot_s[1], motion->duration_s());
  return line;
}

}  // namespace freestand::test
