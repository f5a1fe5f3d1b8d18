// A granite boulder on a shake table, overturned or not: every fourth of the 245 tests of its first specimen. (All of
// them, and the diagnosis: configs/granite_boulder.)
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "measurement/fit/outcome_fit.hpp"
#include "measurement/tell/compare.hpp"
#include "measurement/verdict/diagnose_outcomes.hpp"
#include "study/read_measurements.hpp"
#include "study/read_validation.hpp"
#include "support/data.hpp"

namespace freestand::test {
namespace {

using namespace measurement;

std::filesystem::path boulder_dir() { return data_dir() / "measurements" / "granite_boulder"; }

Dataset every_fourth(const std::string& file) {
  Dataset data = study::read_measurements(boulder_dir() / file);
  std::vector<Test> some;
  for (std::size_t i = 0; i < data.tests.size(); i += 4) some.push_back(data.tests[i]);
  data.tests = std::move(some);
  return data;
}

ModelSpec rocking() {
  const auto study =
      study::read_validation(std::string(FREESTAND_SOURCE_DIR) + "/configs/granite_boulder/rocking.yaml");
  ModelSpec model = study::model_spec(study, false);
  model.placement_scatter = Number{.free = static_cast<int>(model.free.size())};
  model.free.push_back({.name = "placement_scatter",
                        .unit = "1",
                        .lower = 0.001,
                        .upper = 0.5,
                        .low = 0.02,
                        .high = 0.3,
                        .logarithmic = true});
  return model;
}

// A logistic fit in ln PGA and ln(PGV/PGA) misses about 12 % of all tests, and always saying "it stands" 34 %.
TEST(GraniteBoulder, ARockingBlockMissesAboutATenth) {
  if (!std::filesystem::exists(boulder_dir()))
    GTEST_SKIP() << "the tests of the granite boulder are not there (no folder " << boulder_dir()
                 << "): set FREESTAND_DATA_DIR to run this test";
  const Dataset data = every_fourth("specimen_1.yaml");
  const Bench bench(data, 0);
  ASSERT_TRUE(outcomes_only(data));
  const ModelFit fit = fit_outcomes(bench, rocking(), {}, {}, run_here);
  const auto missed = [](const std::vector<TestError>& errors) {
    return static_cast<double>(std::count_if(errors.begin(), errors.end(), [](auto& e) { return e.score > 0.25; })) /
           static_cast<double>(errors.size());
  };
  EXPECT_LT(missed(fit.calibration), 0.15);
  EXPECT_LT(missed(fit.left_out), 0.18);
  EXPECT_GT(fit.mean_left_out(), 0.02);  // near the edge between standing and falling nobody knows
  EXPECT_LT(fit.mean_left_out(), 0.12);
  // All 245 tests together give a slenderness of 0.097 rad [0.068, 0.123], far less than the boulder's sides of 0.65 and
  // 0.79 m, atan 0.69: it stands on less than its width. A quarter of the tests must agree with that, as its interval goes.
  constexpr double of_all_tests_lower = 0.068, of_all_tests_upper = 0.123, of_its_sides = 0.69;
  EXPECT_LT(fit.intervals[0].lower, of_all_tests_upper);
  EXPECT_GT(fit.intervals[0].upper, of_all_tests_lower);
  EXPECT_LT(fit.intervals[0].upper, 0.5 * of_its_sides);
  for (std::size_t i = 0; i < fit.x.size(); ++i) {
    EXPECT_LE(fit.intervals[i].lower, fit.x[i]);
    EXPECT_GE(fit.intervals[i].upper, fit.x[i]);
  }
  EXPECT_GT(fit.intervals[0].upper / fit.intervals[0].lower, 1.05);
}

}  // namespace
}  // namespace freestand::test
