// Friction that differs between specimens, and friction that only scatters from test to test.
#include "measurement/verdict/specimens.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/random.hpp"
#include "measurement/made_tests.hpp"

namespace freestand::measurement {
namespace {

// Eight tests, of which the last five are on a wider specimen.
Dataset of_two_specimens() {
  Dataset data = test::made_dataset(test::cabinet(), 0);
  const measurement::Test one = data.tests[0];
  data.tests.assign(8, one);
  for (std::size_t k = 0; k < 8; ++k) {
    data.tests[k].id = "t" + std::to_string(k + 1);
    if (k > 2) data.tests[k].specimen.width_m = 1.2;
  }
  return data;
}

// Of sets whose frictions only scatter, alike, something is told of one in twenty.
void expect_told_by_chance(int sets, const Bench& bench, std::uint64_t stream,
                           const std::function<bool(const Bench&, const OwnNumbers&)>& told) {
  int times = 0;
  for (int key = 0; key < sets; ++key) {
    OwnNumbers own;
    for (std::uint64_t k = 0; k < bench.size(); ++k)
      own.of_tests.push_back(std::exp(0.06 * random::standard_normal(stream, static_cast<std::uint64_t>(key), k)));
    times += told(bench, own);
  }
  EXPECT_NEAR(times, 0.05 * sets, 3 * std::sqrt(0.05 * 0.95 * sets));
}

TEST(Specimens, AreTheirTestsWithTheSameDimensions) {
  Dataset data = of_two_specimens();
  data.tests[1].role = Role::holdout;
  EXPECT_THAT(several_specimens(Bench(data, 0)), testing::HasSubstr("2 specimens (t1, t3; t4, t5, t6, t7, t8)"));
  for (measurement::Test& t : data.tests) t.specimen = data.tests[0].specimen;
  EXPECT_EQ(several_specimens(Bench(data, 0)), "");
}

TEST(Specimens, OfTwoFrictionsAreTold) {
  const Dataset data = of_two_specimens();
  const Bench bench(data, 0);
  EXPECT_THAT(friction_of_specimens(bench, {.of_tests = {0.62, 0.61, 0.615, 1, 1.01, 0.99, 1, 1}}),
              testing::AllOf(testing::HasSubstr("1 in t1, t2, t3; 1.63 in t4, t5, t6, t7, t8"),
                             testing::HasSubstr(
                                 "within them by 0.74 %")));  // by hand: sqrt((0.000132 + 0.0002)/6) of the logarithms
}

TEST(Specimens, OfOneFrictionAreNotToldButByChance) {
  const Dataset data = of_two_specimens();
  const Bench bench(data, 0);
  expect_told_by_chance(400, bench, 5,
                        [](const Bench& b, const OwnNumbers& f) { return !friction_of_specimens(b, f).empty(); });
  Dataset alike = data;
  for (measurement::Test& t : alike.tests) t.specimen = alike.tests[0].specimen;
  EXPECT_EQ(friction_of_specimens(Bench(alike, 0), {.of_tests = {0.6, 0.6, 0.6, 1, 1, 1, 1, 1}}), "");
}

// One block of five was another one: its friction was called scatter of 18 %, and the test that tells was not named.
TEST(Specimens, OneTestOfAnotherFrictionIsTold) {
  Dataset data = of_two_specimens();
  data.tests.resize(5);
  const Bench bench(data, 0);
  EXPECT_THAT(told(test_of_other_friction(bench, {.of_tests = {1, 1.01, 1.5, 0.99, 1}}).value()),
              testing::HasSubstr("the friction of t3 is 1.5 times that of the others, which differ by 0.82 %"));
  EXPECT_FALSE(test_of_other_friction(bench, {.of_tests = {1, 1, 1, 1, 1}}));
  EXPECT_FALSE(test_of_other_friction(bench, {.of_tests = {0.9, 1.01, 1.15, 0.97, 1.04}}));
  expect_told_by_chance(2000, bench, 6,
                        [](const Bench& b, const OwnNumbers& f) { return test_of_other_friction(b, f).has_value(); });
}

}  // namespace
}  // namespace freestand::measurement
