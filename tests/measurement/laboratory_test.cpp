// Faults of the laboratory instead of effects.
#include "measurement/laboratory/laboratory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "measurement/fit/least_squares.hpp"
#include "measurement/fit/own_numbers.hpp"
#include "measurement/made_tests.hpp"

namespace freestand::measurement {
namespace {

Specimen rigid_block(double width, double height, double mu) {
  Specimen s;
  s.block = Block::rectangular(width, height, 100);
  s.friction = {mu, mu};
  return s;
}

std::vector<std::string> names(const Bench& bench, double mu) {
  std::vector<std::string> all;
  for (const LaboratoryFault& fault : laboratory_faults(bench, test::free_friction(), {mu})) all.push_back(fault.name);
  return all;
}

TEST(Laboratory, WidthAndCentreOfABlockThatOnlySlidesShowNothing) {
  const Dataset squat = test::made_dataset(rigid_block(0.8, 0.6, 0.2)),
                slender = test::made_dataset(rigid_block(0.4, 1.4, 0.7));
  EXPECT_EQ(names(Bench(squat, 0), 0.2), (std::vector<std::string>{gain_fault, clock_fault}));
  EXPECT_EQ(names(Bench(slender, 0), 0.7),
            (std::vector<std::string>{width_fault, centre_fault, gain_fault, clock_fault}));
}

TEST(Laboratory, WhatIsKnownExactlyIsNotAskedAbout) {
  Dataset data = test::made_dataset(rigid_block(0.4, 1.4, 0.7));
  data.tolerance = {.width = 0, .centre_height = 0, .floor_gain = 0, .clock_s = 0};
  EXPECT_TRUE(names(Bench(data, 0), 0.7).empty());
}

// The number of one of the faults that fits the tests best, from what is stated.
double factor_found(const Dataset& data, double mu, const std::string& name, double stated = 1) {
  const Bench bench(data, 0);
  for (const LaboratoryFault& fault : laboratory_faults(bench, test::free_friction(), {mu})) {
    if (fault.name != name) continue;
    ModelFit fit{.model = fault.model, .x = {mu, stated}};
    descend_by_derivatives(bench, {&fit}, run_here);
    return fit.x[1];
  }
  return std::nan("");
}

// The factors take a wrong statement back, to their standard errors.
TEST(Laboratory, FitsFindHowFarOffTheStatementIs) {
  Dataset wide = test::made_dataset(rigid_block(0.4, 1.4, 0.7));
  for (measurement::Test& t : wide.tests) t.specimen.width_m = 0.4 * 1.015;
  const double width = factor_found(wide, 0.7, width_fault);
  EXPECT_NEAR(width, 1 / 1.015, 1e-3);
  EXPECT_EQ(fault_sentence(width_fault, width), "the width is 1.5 % smaller than stated");

  Dataset high = test::made_dataset(rigid_block(0.4, 1.4, 0.7));
  for (measurement::Test& t : high.tests) t.specimen.centre_height_m = 0.7 * 1.03;
  const double centre = factor_found(high, 0.7, centre_fault);
  EXPECT_NEAR(centre, 1 / 1.03, 1e-3);
  EXPECT_EQ(fault_sentence(centre_fault, centre), "the centre of mass is 2.9 % lower than stated");

  Dataset loud = test::made_dataset(rigid_block(0.8, 0.6, 0.2));
  for (measurement::Test& t : loud.tests) t.scale = 1.02;  // the floor as it was read
  const double gain = factor_found(loud, 0.2, gain_fault);
  EXPECT_NEAR(gain, 1 / 1.02, 2e-3);
  EXPECT_EQ(fault_sentence(gain_fault, gain), "the floor's accelerometer reads 2.0 % too much");
}

// The histories of a test, so many samples later.
void delay(Dataset& data, std::size_t test, int steps) {
  for (auto* samples : {&data.tests[test].slip_m, &data.tests[test].rotation_rad}) {
    const std::vector<double> before = *samples;
    for (int i = 0, n = static_cast<int>(before.size()); i < n; ++i)
      (*samples)[static_cast<std::size_t>(i)] = before[static_cast<std::size_t>(std::clamp(i - steps, 0, n - 1))];
  }
}

TEST(Laboratory, AClockThatAllTestsShareIsFound) {
  Dataset data = test::made_dataset(rigid_block(0.8, 0.6, 0.2));
  for (std::size_t i = 0; i < data.tests.size(); ++i) delay(data, i, 3);
  const double behind = factor_found(data, 0.2, clock_fault, 0);
  EXPECT_NEAR(behind, 0.015, 2e-4);
  EXPECT_EQ(fault_sentence(clock_fault, behind), "the responses are stamped 0.015 s late against the floor's channel");
  EXPECT_EQ(fault_sentence(clock_fault, -0.02), "the responses are stamped 0.020 s early against the floor's channel");
}

TEST(OwnClocks, FindTheTestThatRunsBehind) {
  Dataset data = test::made_dataset(rigid_block(0.8, 0.6, 0.2));
  delay(data, 1, 2);
  delay(data, 3, -6);
  const Bench bench(data, 0);
  const ModelFit base{.model = test::free_friction(), .x = {0.2}};
  const Judge judge(bench);
  const OwnNumbers own = own_clocks(bench, judge, base, run_here);
  const double samples = total(judge.samples()), least = total(judge.misfit_of_fit(base));
  for (const auto& [i, behind] : {std::pair(0, 0.0), {1, 0.01}, {2, 0.0}, {3, -0.03}})
    EXPECT_NEAR(own.of_tests[static_cast<std::size_t>(i)], behind, 4e-4) << i;
  EXPECT_TRUE(explain_tests(own, samples, least));
  EXPECT_FALSE(explain_tests(own, samples, own.misfit + 9));  // four numbers gain 9.5 by chance
}

// A sensor of no width, at a stop too: the floor's acceleration before the slip, friction's during it.
TEST(Bench, AccelerationOfTheBlockIsThatOfTheInstant) {
  Dataset data = test::made_dataset(rigid_block(0.8, 0.6, 0.2));
  measurement::Test& test = data.tests[0];
  test.block_acceleration_mps2.assign(test.slip_m.size(), 0);
  const double value[] = {0.2};
  const Prediction found = predict(test::free_friction(), test, value);
  std::size_t slipping = 0;
  for (std::size_t i = 0; i < found.mode.size(); ++i) {
    const double a = found.block_acceleration_mps2[i];
    const double floor = horizontal_acceleration(test.shaking(), static_cast<double>(i) * test.dt_s);
    const bool slips = found.mode[i] == Mode::slide;
    slipping += slips;
    EXPECT_NEAR(slips ? std::abs(a) : a, slips ? 0.2 * standard_gravity_mps2 : floor, 1e-9) << i;
  }
  EXPECT_GT(slipping, 100U);
}

TEST(OwnFriction, FindsTheScatterOfTheTests) {
  Dataset data = test::made_dataset(rigid_block(0.8, 0.6, 0.2));
  const double factors[] = {1.05, 0.93, 1.1, 0.98};
  const struct { double peak, period; } motions[] = {{6, 0.5}, {4, 0.8}, {8, 0.35}, {5, 1.1}};
  for (std::size_t i = 0; i < 4; ++i)
    data.tests[i] = test::made_test(data.tests[i].id, rigid_block(0.8, 0.6, 0.2 * factors[i]),
                                    test::swings(motions[i].peak, motions[i].period, 0.005), i + 1, 0.005);
  const Bench bench(data, 0);
  const ModelFit base{.model = test::free_friction(), .x = {0.2}};
  const Judge judge(bench);
  const OwnNumbers own = own_friction(bench, judge, base, run_here);
  double samples = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(own.of_tests[i], factors[i], 0.003);
    samples += judge.samples()[i];
  }
  EXPECT_NEAR(own.scatter, 0.0742, 0.003);  // of the logarithms of these four
  EXPECT_NEAR(own.misfit / samples, 1, 0.08);
}

}  // namespace
}  // namespace freestand::measurement
