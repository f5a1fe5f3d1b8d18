// In which phase of its motion a block is, as compare tells its errors apart.
#include <gtest/gtest.h>

#include <array>

#include "measurement/made_tests.hpp"
#include "measurement/tell/compare.hpp"

namespace freestand::measurement {
namespace {

std::array<double, phase_count> seconds(double dt_s) {
  Specimen s;
  s.block = Block::rectangular(0.9, 0.5, 100);
  s.friction = {0.15, 0.15};
  s.model = Model::slide;
  Dataset data = test::made_dataset(s);
  data.tests = {test::made_test("t", s, test::swings(6, 0.8), 5, dt_s)};
  std::array<double, phase_count> spent{};
  for (const Phase phase : phases(Bench(data, 0), data.tests[0])) spent[static_cast<std::size_t>(phase)] += dt_s;
  return spent;
}

// A slip may be seen to begin or end by half a window, 0.03 s, earlier or later; there are five.
TEST(Phases, LastAsLongWhateverTheRateOfTheSamples) {
  const auto usual = seconds(0.005);
  EXPECT_GT(usual[static_cast<std::size_t>(Phase::slipping)], 0.5);
  for (const double dt : {0.01, 0.001}) {
    const auto other = seconds(dt);
    for (std::size_t p = 0; p < phase_count; ++p)
      EXPECT_NEAR(other[p], usual[p], 0.15) << name(static_cast<Phase>(p)) << " at steps of " << dt;
  }
}

// Rotation alone: a block that rocks is seen to rock, to strike and to come to rest.
TEST(Phases, ByRotationAlone) {
  Specimen s;
  s.block = Block::rectangular(0.3, 1.2, 100);
  s.friction = {0.9, 0.9};
  Dataset data = test::made_dataset(s);
  const std::vector<Phase> both = phases(Bench(data, 0), data.tests[0]);
  data.tests[0].slip_m.clear();
  const std::vector<Phase> alone = phases(Bench(data, 0), data.tests[0]);
  ASSERT_EQ(alone.size(), both.size());
  std::size_t rocking = 0;
  for (std::size_t k = 0; k < both.size(); ++k) {
    const bool rocks = both[k] == Phase::rocking || both[k] == Phase::after_impact;
    rocking += rocks;
    EXPECT_EQ(rocks ? alone[k] : both[k], both[k]) << k;
  }
  EXPECT_GT(rocking, 40U);
}

}  // namespace
}  // namespace freestand::measurement
