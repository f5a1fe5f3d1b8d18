// Rocking that the floor's noise turns elsewhere: what foretells it, and how often chance seems to.
#include "measurement/verdict/chance_of_foretelling.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "effects/effects.hpp"
#include "measurement/made_tests.hpp"
#include "support/keyed_random.hpp"
#include "support/repeats.hpp"

namespace freestand::measurement {
namespace {

constexpr double floor_noise_mps2 = 0.03;

// A slender block under long swings, the floor of each with a noise that the record lacks.
Specimen slender(double tilt_rad) {
  Specimen specimen;
  specimen.block = Block::rectangular(0.3, 1.4, 100);
  specimen.friction = {0.7, 0.7};
  if (tilt_rad != 0) specimen.effects = {{.effect = effects::find("floor_tilt"), .parameters = {tilt_rad}}};
  return specimen;
}

FloorMotion noisy_swings(double peak_mps2, const std::function<double()>& noise) {
  std::vector<double> a;
  for (int i = 0; i <= 800; ++i) {
    const double t = 0.005 * i;
    a.push_back((t > 0.5 ? peak_mps2 * std::sin(9 * t) * std::exp(-0.5 * t) : 0) + floor_noise_mps2 * noise());
  }
  return piecewise_linear("swings", 0.005, a, {});
}

Dataset rocking(double tilt_rad, std::uint64_t key) {
  test::KeyedRandom random(71, key);
  Dataset data;
  data.sampling_dt_s = 0.005;
  data.noise = {.slip_m = test::slip_noise_m,
                .rotation_rad = test::rotation_noise_rad,
                .floor_acceleration_mps2 = floor_noise_mps2};
  for (int i = 0; i < 5; ++i) {
    const double peak = 4.4 + 0.2 * i;
    data.tests.push_back(test::made_test(std::string("r").append(std::to_string(i)), slender(tilt_rad),
                                         noisy_swings(peak, [&] { return random.normal(); }),
                                         100 * key + static_cast<std::uint64_t>(i)));
    data.tests.back().motion = noisy_swings(peak, [] { return 0.0; });
  }
  return data;
}

ModelFit with_numbers(const Bench& bench, ModelSpec model, const Values& x) {
  ModelFit fit{.model = std::move(model), .x = x};
  fit.fold_x.assign(bench.size(), x);
  for (std::size_t i = 0; i < bench.size(); ++i) fit.left_out.push_back(test_error(bench, i, fit.model, x));
  return fit;
}

Chance foretelling(double true_tilt_rad, double tilt_rad, std::uint64_t key) {
  const Dataset data = rocking(true_tilt_rad, key);
  const Bench bench(data, 32);
  const ModelSpec base = test::free_friction();
  return chance_of_foretelling(
      bench, with_numbers(bench, base, {0.7}),
      with_numbers(bench, with_effect(base, *effects::find("floor_tilt"), bench.reach()), {0.7, tilt_rad}), 1,
      run_here);
}

// Of true bases one in twenty is said to be foretold better by an effect.
TEST(ChanceOfForetelling, HasItsSize) {
  const int sets = test::repeats_asked(60);
  int rejected = 0;
  for (std::uint64_t key = 0; key < static_cast<std::uint64_t>(sets); ++key)
    rejected += !foretelling(0, 0.003, key).chance();
  EXPECT_LE(rejected, test::likely_counts(sets, 0.05).most);
}

TEST(ChanceOfForetelling, SeesWhatComesNear) {
  const Chance chance = foretelling(0.015, 0.015, 1);
  EXPECT_LT(chance.p, 0.01);
  EXPECT_GT(chance.observed, chance.usual);
  EXPECT_GT(foretelling(0.015, 0, 1).p, 0.05);  // the base itself
}

}  // namespace
}  // namespace freestand::measurement
