// One number that is another's among several: by hand, as often as chance says, and as a peak that was read in another unit.
#include "measurement/fit/odd_one.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "measurement/examined.hpp"
#include "measurement/tell/compare.hpp"

namespace freestand::measurement {
namespace {

TEST(OddOne, ByHand) {
  const auto odd = odd_one({0, 0.01, 0.4, -0.01, 0});
  ASSERT_TRUE(odd);
  EXPECT_EQ(odd->which, 2U);
  EXPECT_NEAR(odd->off, 0.4, 1e-12);
  EXPECT_NEAR(odd->scatter_of_others, std::sqrt(0.0002 / 3), 1e-12);
  EXPECT_NEAR(odd->p, 1.31e-4, 1e-6);  // 10 times the tail of t(3) beyond 43.8 = sqrt(5 * 3 * 3.195/0.025)
  EXPECT_FALSE(odd_one({0, 1}));
  EXPECT_FALSE(odd_one({1, 1, 1, 1}));
}

TEST(OddOne, IsToldOnceInTwentySets) {
  constexpr int sets = 4000;
  for (const std::size_t n : {4U, 12U}) {
    int told = 0;
    for (std::uint64_t set = 0; set < sets; ++set) {
      std::vector<double> numbers;
      for (std::uint64_t k = 0; k < n; ++k) numbers.push_back(random::standard_normal(n, set, k));
      told += odd_one(numbers).has_value();
    }
    EXPECT_NEAR(told, 0.05 * sets, 3 * std::sqrt(0.05 * 0.95 * sets)) << n;
  }
}

// Eight peaks that scatter by 3 % about the model's, of which one was read in inches as centimetres; and none.
TEST(OddOne, OfPeaksIsAFinding) {
  for (const double factor : {1.0, 0.394}) {
    Dataset data;
    for (std::uint64_t k = 0; k < 8; ++k) {
      measurement::Test test;
      test.id = "t" + std::to_string(k + 1);
      test.motion = test::swings(4 + 0.5 * static_cast<double>(k), 0.6);
      test.specimen = {0.8, 0.6, 100.0};
      test.peaks.peak_slip_m = respond(test::sliding_cabinet(0.2), test.shaking()).peak_slip_m *
                               std::exp(0.03 * random::standard_normal(3, k, 0));
      data.tests.push_back(std::move(test));
    }
    *data.tests[4].peaks.peak_slip_m *= factor;
    const Bench bench(data, 0);
    ModelSpec model;
    model.mu_k.value = 0.2;
    model.model = Model::slide;
    std::vector<TestComparison> tests;
    for (std::size_t i = 0; i < bench.size(); ++i) tests.push_back(compare_test(bench, i, model, {}, {}));
    const auto told = testing::Contains(testing::HasSubstr("the peak slip of t5 is 0.39 times that of the others"));
    const auto findings = compare(bench, model, {}, std::move(tests), {}).findings;
    if (factor < 1)
      EXPECT_THAT(findings, told);
    else
      EXPECT_THAT(findings, testing::Not(testing::Contains(testing::HasSubstr("beside the model the peak slip"))));
  }
}

}  // namespace
}  // namespace freestand::measurement
