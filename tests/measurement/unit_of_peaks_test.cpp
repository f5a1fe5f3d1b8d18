// Peaks that are all written in another unit than their name says: no effect is to be named for them.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>

#include "effects/effects.hpp"
#include "measurement/made_tests.hpp"
#include "measurement/verdict/diagnose.hpp"
#include "support/keyed_random.hpp"

namespace freestand::measurement {
namespace {

struct Told {
  Verdict verdict;
  std::string findings;
};

// Peak slips of a sliding block that scatter by 3 %, written so many times as large.
Told told_of(double factor, const Specimen& of = test::sliding_cabinet(0.2)) {
  Dataset data;
  test::KeyedRandom random(57, 0);
  for (int i = 0; i < 10; ++i) {
    measurement::Test& test = data.tests.emplace_back();
    test.id = std::string("s").append(std::to_string(i));
    test.motion = test::swings((i % 2 ? -1 : 1) * (3 + 0.5 * i), 0.4 + 0.1 * (i % 5));
    test.specimen = {0.8, 0.6, 100.0};
    test.peaks.peak_slip_m = factor * respond(of, test.shaking()).peak_slip_m * std::exp(0.03 * random.normal());
  }
  ModelSpec model = test::free_friction();
  model.model = Model::slide;
  const Diagnosis d = diagnose(Bench(data, 0), model,
                               {effects::find("viscous_drag"), effects::find("rate_strengthening")}, {}, run_here);
  return {d.verdict, fmt::format("{}", fmt::join(d.quality.findings, "; "))};
}

TEST(UnitOfPeaks, PeaksThatAreTenTimesTooLargeAreNoEffect) {
  const auto [verdict, findings] = told_of(10);
  EXPECT_EQ(verdict, Verdict::bad_data) << findings;
  EXPECT_NE(findings.find("if the slips are 0.1 times what is written"), std::string::npos) << findings;
}

TEST(UnitOfPeaks, PeaksInFeetTooSmallAreNoEffect) {
  const auto [verdict, findings] = told_of(1 / 3.281);
  EXPECT_EQ(verdict, Verdict::bad_data) << findings;
  EXPECT_NE(findings.find("if the slips are 3.28 times what is written"), std::string::npos) << findings;
}

TEST(UnitOfPeaks, PeaksInMetresAreInOrder) {
  const auto [verdict, findings] = told_of(1);
  EXPECT_EQ(verdict, Verdict::none) << findings;
}

TEST(UnitOfPeaks, ADragIsNoUnit) {
  Specimen dragged = test::sliding_cabinet(0.2);
  dragged.effects = {{.effect = effects::find("viscous_drag"), .parameters = {2.0}}};
  const auto [verdict, findings] = told_of(1, dragged);
  EXPECT_TRUE(verdict == Verdict::missing || verdict == Verdict::ambiguous) << name(verdict) << findings;
}

}  // namespace
}  // namespace freestand::measurement
