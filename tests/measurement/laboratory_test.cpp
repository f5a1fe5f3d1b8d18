// Faults of the laboratory instead of effects.
#include "measurement/laboratory.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measurement/least_squares.hpp"
#include "measurement/made_tests.hpp"
#include "measurement/own_friction.hpp"

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
  EXPECT_EQ(names(Bench(squat, 0), 0.2), std::vector<std::string>{gain_fault});
  EXPECT_EQ(names(Bench(slender, 0), 0.7), (std::vector<std::string>{width_fault, centre_fault, gain_fault}));
}

TEST(Laboratory, WhatIsKnownExactlyIsNotAskedAbout) {
  Dataset data = test::made_dataset(rigid_block(0.4, 1.4, 0.7));
  data.tolerance = {.width = 0, .centre_height = 0, .floor_gain = 0};
  EXPECT_TRUE(names(Bench(data, 0), 0.7).empty());
}

// The factor of one of the faults that fit the tests best, from 1.
double factor_found(const Dataset& data, double mu, const std::string& name) {
  const Bench bench(data, 0);
  for (const LaboratoryFault& fault : laboratory_faults(bench, test::free_friction(), {mu})) {
    if (fault.name != name) continue;
    ModelFit fit{.model = fault.model, .x = {mu, 1}};
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
  const OwnFriction own = own_friction(bench, judge, base, run_here);
  double samples = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(own.factors[i], factors[i], 0.003);
    samples += judge.samples()[i];
  }
  EXPECT_NEAR(own.scatter, 0.0742, 0.003);  // of the logarithms of these four
  EXPECT_NEAR(own.misfit / samples, 1, 0.08);
}

}  // namespace
}  // namespace freestand::measurement
