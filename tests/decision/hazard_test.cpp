#include "decision/hazard.hpp"

#include <gmock/gmock.h>

#include <freestand/error.hpp>

namespace freestand::decision {
namespace {

const std::vector<std::string> measures = {"pga_g", "pgv_mps", "sa_g"};

HazardCurve read(const std::string& text) { return parse_hazard(text, "hazard.csv", measures); }

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const Error& error) {
    EXPECT_EQ(error.exit(), Exit::data);
    return error.what();
  }
  return "accepted";
}

TEST(Hazard, ReadsPointsInWhateverOrderOfColumns) {
  const HazardCurve curve = read("\xef\xbb\xbf# site A\r\nannual_rate, pga_g\r\n0.1, 0.05\r\n\r\n0.001,0.5\r\n");
  EXPECT_EQ(curve.measure, "pga_g");
  EXPECT_THAT(curve.im, testing::ElementsAre(0.05, 0.5));
  EXPECT_THAT(curve.annual_rate, testing::ElementsAre(0.1, 0.001));
  EXPECT_EQ(curve.period_s, 0);
  EXPECT_EQ(read("sa_g,annual_rate,period_s\n0.1,0.1,0.5\n1,0.01,0.5\n").period_s, 0.5);
  const HazardCurve named = read("sa_g:0.5,annual_rate\n0.1,0.1\n1,0.01\n");
  EXPECT_EQ(named.measure, "sa_g");
  EXPECT_EQ(named.period_s, 0.5);
  EXPECT_THAT(refusal("sa_g:0.5,annual_rate,period_s\n0.1,0.1,1\n1,0.01,1\n"),
              testing::HasSubstr("hazard.csv:2: period_s changes"));
}

TEST(Hazard, IsAPowerLawBetweenItsPointsAndBeyond) {
  const HazardCurve curve = read("pga_g,annual_rate\n0.1,0.1\n1,0.001\n2,0.001\n");
  EXPECT_NEAR(curve.rate(0.1), 0.1, 1e-15);
  EXPECT_NEAR(curve.rate(0.2), 0.025, 1e-15);
  EXPECT_NEAR(curve.rate(0.05), 0.4, 1e-14);
  EXPECT_NEAR(curve.rate(1.5), 0.001, 1e-15);
  EXPECT_NEAR(curve.rate(9), 0.001, 1e-15);
}

// Two points so close that the slope beside the first leads beyond all numbers: nothing is exceeded more often than once an hour, which is
// what a point may say at most.
TEST(Hazard, NoSlopeLeadsBeyondOnceAnHour) {
  const HazardCurve curve = read("pga_g,annual_rate\n5.02,0.1\n5.05,0.00000005\n");
  EXPECT_EQ(curve.rate(0.5), 8766);
  EXPECT_NEAR(curve.rate(5.02), 0.1, 1e-12);
  EXPECT_EQ(curve.rate(50), 0);
}

TEST(Hazard, WhatCannotBeIsToldWithItsLine) {
  using testing::HasSubstr;
  EXPECT_THAT(refusal(""), HasSubstr("hazard.csv:1: is empty"));
  EXPECT_THAT(refusal("pga_g,annual_rate\n0.1,0.1\n0.2,0.05\n0.3,0.06\n"),
              HasSubstr("hazard.csv:4: annual_rate rises from 0.05 to 0.06"));
  EXPECT_THAT(refusal("pga_g,annual_rate\n0.1,0.1\n0.2,0\n"),
              HasSubstr("hazard.csv:3: annual_rate = 0 is not positive"));
  EXPECT_THAT(refusal("pga_g,annual_rate\n0.1,0.1\n0.2,-1e-3\n"), HasSubstr("not positive"));
  EXPECT_THAT(refusal("pga_g,annual_rate\n0,0.1\n0.2,1e-3\n"), HasSubstr("hazard.csv:2: pga_g = 0 is not positive"));
  EXPECT_THAT(refusal("pga_g,annual_rate\n0.1,0.1\n0.1,0.05\n"), HasSubstr("hazard.csv:3: pga_g is 0.1 again"));
  EXPECT_THAT(refusal("pga_g,annual_rate\n0.1,0.1\n0.2,1x\n"), HasSubstr("hazard.csv:3: 1x is no number"));
  EXPECT_THAT(refusal("pga_g,annual_rate\n0.1,0.1\n0.2,nan\n"), HasSubstr("hazard.csv:3: nan is no number"));
  EXPECT_THAT(refusal("pga_g,annual_rate\n0,1,0.1\n"), HasSubstr("hazard.csv:2: has 3 fields"));
  EXPECT_THAT(refusal("pga_g,annual_rate\n0.1,0.1\n"), HasSubstr("fewer than two points"));
  EXPECT_THAT(refusal("pga,annual_rate\n0.1,0.1\n"), HasSubstr("hazard.csv:1: column pga is unknown"));
  EXPECT_THAT(refusal("pga_g,rate\n0.1,0.1\n"), HasSubstr("hazard.csv:1: column rate is unknown (how often a year"));
  EXPECT_THAT(refusal("pga_g;annual_rate\n0.1;0.1\n"), HasSubstr("hazard.csv:1: cells are parted by semicolons"));
  EXPECT_THAT(refusal(std::string("pga_g\0,annual_rate\n", 19)), HasSubstr("no text but a binary file"));
  EXPECT_THAT(refusal("pga_g,pgv_mps,annual_rate\n"), HasSubstr("a second column like pgv_mps"));
  EXPECT_THAT(refusal("pga_g,period_s\n"), HasSubstr("no column annual_rate"));
  EXPECT_THAT(refusal("annual_rate\n0.1\n"), HasSubstr("no column of an intensity"));
  EXPECT_THAT(refusal("sa_g,annual_rate,period_s\n0.1,0.1,0.5\n1,0.01,0.6\n"),
              HasSubstr("hazard.csv:3: period_s changes"));
}

TEST(Hazard, NoIntensityIsExceededMoreThanOnceAnHour) {
  EXPECT_THAT(
      [] { parse_hazard("pga_g,annual_rate\n0.1,1e60\n0.2,0.1\n", "a.csv", {"pga_g"}); },
      testing::ThrowsMessage<Error>(testing::HasSubstr("a.csv:2: annual_rate is 1e+60 (more than once an hour")));
}

}  // namespace
}  // namespace freestand::decision
