// Predictions of many tests and points at once are those of each alone, to the bit.
#include <gtest/gtest.h>

#include "effects/effects.hpp"
#include "measurement/made_tests.hpp"
#include "measurement/predict/bench.hpp"

namespace freestand::measurement {
namespace {

// Histories with and without an accelerometer, one longer than the others, and a test known by its peaks.
Dataset mixed_tests() {
  Specimen cabinet;
  cabinet.block = Block::rectangular(0.8, 0.6, 100);
  cabinet.friction = {0.2, 0.2};
  Dataset data = test::made_dataset(cabinet);
  data.tests[1].block_acceleration_mps2 = data.tests[1].slip_m;
  data.tests[2].slip_m.clear();
  data.tests[2].rotation_rad.clear();
  data.tests[2].peaks.peak_slip_m = 0.01;
  data.tests[3].motion = test::swings(5, 0.7, 0.002);
  return data;
}

// Models without a law, with one, and whose response is stamped late.
std::vector<ModelSpec> models() {
  std::vector<ModelSpec> all(3, test::free_friction());
  all[1] = with_effect(all[1], *effects::find("rate_weakening"), {});
  all[2] = with_effect(all[2], *effects::find("floor_tilt"), {});
  all[2].clock_behind.value = 0.0037;
  return all;
}

void expect_same(const Prediction& a, const Prediction& b, std::size_t i) {
  EXPECT_EQ(a.slip_m, b.slip_m) << i;
  EXPECT_EQ(a.rotation_rad, b.rotation_rad) << i;
  EXPECT_EQ(a.block_acceleration_mps2, b.block_acceleration_mps2) << i;
  EXPECT_EQ(a.slip_velocity_mps, b.slip_velocity_mps) << i;
  EXPECT_EQ(a.mode, b.mode) << i;
  EXPECT_EQ(a.response.peak_slip_m, b.response.peak_slip_m) << i;
  EXPECT_EQ(a.response.outcome, b.response.outcome) << i;
}

TEST(Predictions, OfManyAreThoseOfEach) {
  const Dataset data = mixed_tests();
  const Bench bench(data, 3);
  const auto specs = models();
  std::vector<Asked> asked;
  for (std::size_t i = 0; i < 90; ++i) {
    const ModelSpec& model = specs[i / 5 % 3];
    const std::size_t t = i % 5;
    Values x = {0.1 + 0.002 * static_cast<double>(i)};
    for (std::size_t k = 1; k < model.free.size(); ++k) x.push_back(0.5 * (model.free[k].low + model.free[k].high));
    const auto& replays = bench.replays(t);
    asked.push_back({model, bench.test(t), x, i % 7 == 0 && !replays.empty() ? &replays[i % replays.size()] : nullptr});
  }
  const std::vector<Prediction> together = predict(asked);
  ASSERT_EQ(together.size(), asked.size());
  std::size_t next = 0, moved = 0;
  predict(asked, [&](std::size_t i, const Prediction& one) {
    EXPECT_EQ(i, next++);
    const auto& [model, test, x, other] = asked[i];
    const Prediction alone = predict(model, test, x, other);
    expect_same(one, alone, i);
    expect_same(together[i], alone, i);
    predict({asked[(i + 1) % asked.size()], asked[(i + 2) % asked.size()]});  // who uses one may ask for others
    moved += alone.response.peak_slip_m > 0;
  });
  EXPECT_EQ(next, asked.size());
  EXPECT_GT(moved, 60U);
  EXPECT_TRUE(predict(std::vector<Asked>{}).empty());
}

}  // namespace
}  // namespace freestand::measurement
