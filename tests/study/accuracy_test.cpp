// Error estimates of a sweep: what is compared, and what a user is told.
#include "study/accuracy.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "base/units.hpp"
#include "study/known.hpp"
#include "support/keyed_random.hpp"
#include "support/scratch.hpp"

namespace freestand::study {
namespace {

using testing::HasSubstr;

Study slender(const std::string& more) {
  return parse_study(
      "seed: 3\nsamples: 400\nblock: {width_m: 0.4, height_m: 1.8}\nfriction: {mu: 0.3}\n"
      "motions: [{pulse: [A, B, C1], period_s: {uniform: [0.3, 1.5]}, peak_acceleration_g: {uniform: [0.2, 1]}}]\n" +
          more,
      "some.yaml", registries());
}

Accuracy checked(const Study& study, std::int64_t samples) {
  return check_accuracy({}, study, Evaluator(study, load_motions(study)), samples);
}

const DemandError& of(const Accuracy& accuracy, const std::string& name) {
  return *std::find_if(accuracy.demands.begin(), accuracy.demands.end(), [&](const auto& d) { return d.name == name; });
}

// A hundredth of the tolerance is the truth by comparison, so the estimate at a loose tolerance is the error itself.
TEST(Accuracy, EstimateFollowsTheTolerance) {
  double before = 1;
  for (const char* tolerance : {"1e-3", "1e-5", "1e-7"}) {
    const Accuracy accuracy = checked(slender(std::string("tolerance: ") + tolerance), 400);
    const DemandError& rotation = of(accuracy, "peak_rotation_over_alpha");
    EXPECT_EQ(accuracy.checked, checked_samples);
    EXPECT_GT(rotation.largest, 0) << tolerance;
    EXPECT_LT(rotation.p95, 0.2 * before) << tolerance;
    EXPECT_LE(rotation.median, rotation.p95);
    EXPECT_LE(rotation.p95, rotation.largest);
    before = rotation.p95;
  }
}

// What a study does not follow has no error, and no demand of zero.
TEST(Accuracy, DemandsThatNoSampleTellsAreLeftOut) {
  const auto edps = accuracy_json(checked(slender(""), 20))["edps"];
  EXPECT_TRUE(edps.contains("peak_slip_m"));
  EXPECT_FALSE(edps.contains("peak_slip_left_m"));
  EXPECT_TRUE(accuracy_json(checked(slender("slip_by_side: true\n"), 20))["edps"].contains("peak_slip_left_m"));
}

TEST(Accuracy, FewSamplesAreAllChecked) {
  const Accuracy accuracy = checked(slender(""), 17);
  EXPECT_EQ(accuracy.checked, 17);
  EXPECT_DOUBLE_EQ(accuracy.tighter_tolerance, 1e-11);
  EXPECT_EQ(checked(slender("tolerance: 1e-12"), 5).tighter_tolerance, tightest_tolerance);
}

// With no flip in n the exact interval ends at 1 - (0.025)^(1/n).
TEST(Accuracy, FlipsComeWithTheirExactInterval) {
  const Accuracy accuracy = checked(slender(""), 200);
  ASSERT_EQ(accuracy.flips, 0);
  EXPECT_NEAR(accuracy.flip_share_upper, 1 - std::pow(0.025, 1.0 / 200), 1e-12);
}

// Slides are exact in packs and one by one, but for round-off, at any tolerance: the same numbers would mean that packs had
// been held against packs.
TEST(Accuracy, PacksAreHeldAgainstSingleSamples) {
  const test::Scratch folder("accuracy");
  std::ofstream record(folder / "noise.csv");
  record << "time_s,floor_acceleration_mps2\n";
  test::KeyedRandom random(16, 0);
  for (int i = 0; i < 1000; ++i) record << 0.01 * i << ',' << 3 * random.normal() << '\n';
  record.close();
  const Study study = parse_study(
      "seed: 3\nsamples: 200\nblock: {width_m: 0.4, height_m: 1.8}\nmodel: slide\n"
      "friction: {mu: {uniform: [0.1, 0.4]}}\nmotions: [{records: noise.csv}]\n",
      folder / "some.yaml", registries());
  const DemandError slip = of(checked(study, 200), "peak_slip_m");
  EXPECT_GT(slip.p95, 0);
  EXPECT_LT(slip.p95, 1e-11);
}

TEST(Accuracy, ALooseToleranceFlipsOutcomesAndSaysSo) {
  Study loose = slender("model: rock\n");
  loose.tolerance = 0.3;  // more than a study may ask for
  const auto json = accuracy_json(checked(loose, 400));
  EXPECT_GT(json["outcome_flips"], 0);
  EXPECT_THAT(accuracy_warnings(json), testing::Contains(HasSubstr("end differently under a tighter tolerance")));
  EXPECT_THAT(accuracy_warnings(json), testing::Contains(HasSubstr("lower `tolerance`")));
  EXPECT_TRUE(accuracy_warnings(accuracy_json(checked(slender(""), 200))).empty());
  EXPECT_TRUE(accuracy_warnings(nlohmann::ordered_json::object()).empty());
  EXPECT_THAT(accuracy_warnings({{"edps", {{"impacts", {{"unit", "1"}, {"p95_error", 2}, {"median_demand", 8}}}}},
                                 {"flip_share", 0}}),
              testing::ElementsAre(HasSubstr("changes by more than 2 under")));
}

}  // namespace
}  // namespace freestand::study
