// Two programs that share no line, one physics: the generator's histories are those of the kernel, effect by effect.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <freestand/simulate.hpp>

#include "hidden_effect/default_effects.hpp"
#include "hidden_effect/kernel_specimen.hpp"
#include "hidden_effect/make_set.hpp"

namespace freestand::test {
namespace {

constexpr double accuracy = 1e-6;  // [m], [rad]: beside six times what the generator changes when its step is halved

double distance(const TruthHistory& a, double slip, double turn, std::size_t i) {
  return std::max(std::abs(a.slip_m[i] - slip), std::abs(a.rotation_rad[i] - turn));
}

struct Agreement {
  std::size_t compared = 0, samples = 0;
  double worst = 0;  // difference over what is allowed
};

// Up to where the generator's own error passes 1e-4: rocking that is that sensitive tells nothing.
Agreement agreement(const Truth& truth, const FloorSamples& floor) {
  const FloorMotion motion = motion_of(floor);
  const Shaking shaking{&motion, 1, 1, 0};
  Settings settings;
  settings.free_vibration_s = 1;
  settings.tolerance = 1e-12;
  History kernel;
  kernel.step_s = floor.dt_s;
  respond(specimen_of(truth), shaking, settings, &kernel);
  const TruthHistory coarse = simulate(truth, floor, 5e-5), fine = simulate(truth, floor, 2.5e-5);
  Agreement result;
  result.samples = std::min(fine.slip_m.size(), kernel.points.size());
  double own = 0;
  for (std::size_t i = 0; i < result.samples; ++i, ++result.compared) {
    own = std::max(own, distance(coarse, fine.slip_m[i], fine.rotation_rad[i], i));
    if (own > 1e-4) break;
    const HistoryPoint& point = kernel.points[i];
    result.worst = std::max(result.worst, distance(fine, point.slip_m, point.rotation_rad, i) / (accuracy + 6 * own));
  }
  return result;
}

class AgainstKernel : public testing::TestWithParam<std::string> {};

TEST_P(AgainstKernel, HasTheSameHistories) {
  std::size_t compared = 0, samples = 0;
  for (const std::uint64_t seed : {1, 2}) {
    const MadeSet set = make_set({split_effects(GetParam()), seed, 3, 8, 0});
    for (const MadeTest& test : set.tests) {
      const Agreement a = agreement(set.drawn.truth, test.floor);
      EXPECT_LE(a.worst, 1) << set.name << ' ' << test.id << ", after " << a.compared << " samples";
      compared += a.compared;
      samples += a.samples;
    }
  }
  EXPECT_GE(compared, samples / 2);
  RecordProperty("compared", std::to_string(compared) + "/" + std::to_string(samples));
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '+', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(HiddenEffect, AgainstKernel, testing::ValuesIn(default_effects()), test_name);

}  // namespace
}  // namespace freestand::test
