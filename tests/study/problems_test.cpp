#include "study/problems.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace freestand::study {
namespace {

TEST(Problems, EditDistanceCountsTheFourSimpleMistakes) {
  EXPECT_EQ(edit_distance("width_m", "width_m"), 0);
  EXPECT_EQ(edit_distance("widht_m", "width_m"), 1);  // exchanged
  EXPECT_EQ(edit_distance("with_m", "width_m"), 1);   // left out
  EXPECT_EQ(edit_distance("widdth_m", "width_m"), 1);
  EXPECT_EQ(edit_distance("wibth_m", "width_m"), 1);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
}

TEST(Problems, NearestSuggestsOnlyWhatIsNear) {
  const std::vector<std::string> keys = {"width_m", "height_m", "mass_kg"};
  EXPECT_EQ(nearest("hieght_m", keys), "height_m");
  EXPECT_EQ(nearest("colour", keys), "");
  EXPECT_EQ(nearest("WIDTH_M", keys), "width_m");
  EXPECT_EQ(hint("masskg", keys), "did you mean mass_kg?");
  EXPECT_EQ(hint("colour", keys), "known: width_m, height_m, mass_kg");
}

TEST(Problems, UnitsComeFromSuffixes) {
  EXPECT_EQ(unit_of("block.width_m"), "m");
  EXPECT_EQ(unit_of("motion.peak_velocity_mps"), "m/s");
  EXPECT_EQ(unit_of("effects.viscous_drag.rate_per_s"), "1/s");
  EXPECT_EQ(unit_of("block.p_radps"), "rad/s");
  EXPECT_EQ(unit_of("friction.mu_k"), "1");
  EXPECT_EQ(unit_of("friction.mu_s"), "1");
  EXPECT_EQ(without_unit("width_mm"), "width");
  EXPECT_EQ(without_unit("mu"), "mu");
}

TEST(Problems, AllAreThrownTogetherInTheOrderOfTheFile) {
  Problems problems("a.yaml");
  EXPECT_NO_THROW(problems.throw_if_any());
  problems.add(7, "second (why): do");
  problems.add(2, "first (why): do");
  try {
    problems.throw_if_any();
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "a.yaml:2: first (why): do\na.yaml:7: second (why): do");
    EXPECT_EQ(error.exit(), Exit::usage);
  }
}

TEST(Problems, WhatIsTheSameOfManyIsToldOnce) {
  std::vector<Refusal> refusals;
  for (const char* name : {"a.csv", "b.csv", "c.csv", "d.csv", "e.csv", "f.csv"})
    refusals.push_back({name, std::string(name) + ": its unit is not known", std::string("INDEX.csv:") + name[0]});
  refusals.push_back({"g.csv", "g.csv:7: no number"});
  EXPECT_EQ(told_once(refusals),
            (std::vector<std::string>{
                "INDEX.csv:a: a.csv: its unit is not known; and the same of b.csv, c.csv, d.csv and 2 more",
                "g.csv:7: no number"}));
}

}  // namespace
}  // namespace freestand::study
