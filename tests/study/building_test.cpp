// Records of the ground and equipment upstairs: what a study says of the building, what is shaken, and which intensity is whose.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/units.hpp"
#include "motion/building_response.hpp"
#include "motion/spectrum.hpp"
#include "study/doubts.hpp"
#include "study/drawn_building.hpp"
#include "study/intensities.hpp"
#include "study/known.hpp"
#include "study/motion_summaries.hpp"
#include "study/read_building.hpp"
#include "study/sampled.hpp"
#include "study_text.hpp"
#include "support/error_text.hpp"
#include "support/scratch.hpp"

namespace freestand::study::building_test {
namespace {

using namespace test;
using testing::HasSubstr;

class Upstairs : public testing::Test {
 protected:
  void SetUp() override {
    for (const int number : {0, 1}) {
      std::ofstream file(folder_ / (number ? "b.csv" : "a.csv"));
      file << "time_s,floor_acceleration_mps2\n";
      for (int i = 0; i < 300; ++i)
        file << 0.02 * i << "," << (1 + number) * std::sin(0.02 * i * (8 + 3 * number)) * std::exp(-0.2 * 0.02 * i)
             << "\n";
    }
    std::ofstream(folder_ / "museum.yaml") << "storeys: 4\nperiod_s: 0.6\ndamping: 0.03\n";
  }
  Study study(const std::string& source, const std::string& im = "ground.pga_g") const {
    return parse_study(block + friction + samples + "motions:\n  - {records: \"*.csv\", " + source +
                           "}\nfragility: {edp: [delta], im: " + im + "}\n",
                       folder_ / "s.yaml", known(), Files::look);
  }
  std::string problem(const std::string& source, const std::string& im = "report") const {
    return freestand::test::error_text(Exit::usage, [&] { study(source, im); });
  }
  freestand::test::Scratch folder_{"upstairs"};
};

TEST_F(Upstairs, AFileAndAMappingAreTheSameBuilding) {
  const Study by_file = study("building: museum.yaml, storey: 3");
  const Study inlined = study("building: {name: museum, storeys: 4, period_s: 0.6, damping: 0.03}, storey: 3");
  EXPECT_EQ(expanded(by_file), expanded(inlined));
  EXPECT_THAT(
      expanded(by_file),
      HasSubstr("building: {name: museum, storeys: 4, period_s: 0.6, stiffness: equal, damping: 0.03}\n    storey: 3"));
  EXPECT_EQ(load_motions(by_file).fingerprint(), load_motions(inlined).fingerprint());
}

TEST_F(Upstairs, EveryBuildingIsWrittenBackAsItIs) {
  for (const char* text :
       {"{name: \"a: b\", storeys: [{mass_kg: 4e5, height_m: 4.2, stiffness_npm: 3e8}, {mass_kg: 3e5, height_m: 3.5, "
        "stiffness_npm: "
        "2.5e8}], damping: 0.02, rayleigh_modes: [1, 2]}",
        "{storeys: [{height_m: 4.2, mass_kg: 4e5}, {height_m: 3.5, mass_kg: 3e5, count: 3}], period_s: 0.5, stiffness: "
        "straight_first_mode}",
        "{storeys: [{mass_kg: 4e5, count: 2}], period_s: 0.5}", "{storeys: 12, period_s: 1.3}"}) {
    const Study once = study(std::string("building: ") + text + ", storey: {choice: [0, 1, 2], weights: [1, 2, 1]}");
    std::ofstream(folder_ / "again.yaml") << expanded(once);
    const Study again = read_study(folder_ / "again.yaml", known());
    EXPECT_EQ(expanded(again).substr(expanded(again).find("seed")), expanded(once).substr(expanded(once).find("seed")));
    EXPECT_EQ(load_motions(again).fingerprint(), load_motions(once).fingerprint());
  }
}

TEST_F(Upstairs, SamplesAreShakenByTheFloorAndScaledByTheGround) {
  const Study upstairs = study("building: museum.yaml, storey: 3, scale_to: {pga_g: {uniform: [0.1, 1]}}");
  const Study spectral =
      study("building: museum.yaml, storey: 3, scale_to: {sa_g: {uniform: [0.1, 1]}, period_s: 0.5}");
  const Study below = study("scale_to: {pga_g: {uniform: [0.1, 1]}}", "report");
  const MotionSet motions = load_motions(upstairs), ground = load_motions(below);
  const Realiser realise(upstairs, motions), by_spectrum(spectral, load_motions(spectral)), on_ground(below, ground);
  ASSERT_EQ(motions.size(), 4U);
  ASSERT_EQ(ground.size(), 2U);
  EXPECT_THAT(motions.names(),
              testing::ElementsAre("a.csv", "a.csv museum storey 3", "b.csv", "b.csv museum storey 3"));
  EXPECT_THAT(motions.groups(), testing::ElementsAre(0, 0, 2, 2));
  const auto modes = motion::modes(*upstairs.motions.front().building);
  for (std::uint64_t sample = 0; sample < 20; ++sample) {
    const Realisation up = realise(sample), down = on_ground(sample), by_sa = by_spectrum(sample);
    EXPECT_EQ(up.shaking.scale, down.shaking.scale);  // of the ground's peak
    const FloorMotion& record = *down.shaking.motion;
    EXPECT_EQ(up.shaking.motion->horizontal_mps2, motion::BuildingResponse(record, modes).floor(3, "").horizontal_mps2);
    EXPECT_EQ(motions.ground(up.motion), 2 * down.motion);
    EXPECT_NEAR(up.pta_g, up.shaking.scale * motion::peaks(*up.shaking.motion).pga_mps2 / standard_gravity_mps2, 1e-12);
    const double sa = by_sa.shaking.scale * motion::spectral_acceleration_mps2(record, 0.5);
    EXPECT_NEAR(sa, down.shaking.scale * motion::peaks(record).pga_mps2, 1e-14 * sa);
    EXPECT_EQ(up.draws.back(), 3);
  }
  EXPECT_EQ(realise.draw_columns().back().name, "storey");
  EXPECT_EQ(on_ground.draw_columns().back().name, "pulse_period_s");
}

TEST_F(Upstairs, StoreysAreDrawnByTheirWeights) {
  const Study swept = study("building: museum.yaml, storey: {choice: [0, 2, 4], weights: [1, 2, 1]}");
  const MotionSet motions = load_motions(swept);
  ASSERT_EQ(motions.size(), 6U);
  EXPECT_THAT(motions.groups(), testing::ElementsAre(0, 0, 0, 3, 3, 3));
  const Realiser realise(swept, motions);
  int of[5] = {}, of_record[2] = {};
  for (std::uint64_t sample = 0; sample < 1024; ++sample) {
    const Realisation one = realise(sample);
    ++of[static_cast<int>(one.draws.back())];
    ++of_record[one.motion / 3];
    EXPECT_EQ((*motions.entries)[one.motion].storey, one.draws.back());
  }
  EXPECT_NEAR(of[0], 256, 8);  // a Sobol sequence is even
  EXPECT_NEAR(of[2], 512, 8);
  EXPECT_NEAR(of[4], 256, 8);
  EXPECT_NEAR(of_record[0], 512, 8);
  EXPECT_EQ(Realiser::column_of("motion.storey"), "storey");
  std::vector<std::string> names;
  for (const Sampled& one : sampled(swept, 6, {0, 0, 0, 3, 3, 3})) {
    names.push_back(one.parameter.name);
    if (names.back() == "motion") {
      EXPECT_EQ(one.class_of(0, 5), 3);
    }
  }
  EXPECT_THAT(names, testing::ElementsAre("motion.storey", "motion"));
}

TEST_F(Upstairs, IntensitiesOfTheGroundAreThoseOfTheRecord) {
  const Study swept = study("building: museum.yaml, storey: {choice: [0, 3]}", "{name: ground.sa_g, period_s: 0.7}");
  const MotionSet motions = load_motions(swept);
  const MotionSummaries summaries = summarize(motions, motion::kept_periods_s());
  const double nan = std::nan("");
  const Table rows{{{"motion", "1", ""},
                    {"scale", "1", ""},
                    {"pulse_period_s", "s", ""},
                    {"block_alpha_rad", "rad", ""},
                    {"block_p_radps", "rad/s", ""},
                    {"friction_mu_k", "1", ""}},
                   {0, -1.5, nan, 0.3, 2, 0.2, 1, -1.5, nan, 0.3, 2, 0.2}};
  const FloorMotion &record = motions.motion(0), &floor = motions.motion(1);
  for (const MotionSummaries& of : {summaries, motion_summaries(motion_rows(motions, summaries))}) {
    for (const char* name : {"pga_g", "pgv_mps", "pgd_m", "housner_m"}) {
      const auto own = SampleIntensity({name}, of)(rows),
                 ground = SampleIntensity({std::string("ground.") + name}, of)(rows);
      EXPECT_EQ(own[0], ground[0]) << name;  // storey 0 is the ground
      EXPECT_EQ(ground[1], ground[0]) << name;
      EXPECT_NE(own[1], ground[1]) << name;
    }
    const double sa = 1.5 * motion::spectral_acceleration_mps2(record, 0.7) / standard_gravity_mps2;
    EXPECT_THAT(SampleIntensity({"ground.sa_g", "period_s", 0.7}, of)(rows), testing::ElementsAre(sa, sa));
    EXPECT_NE(motion::spectral_acceleration_mps2(floor, 0.7), motion::spectral_acceleration_mps2(record, 0.7));
  }
  EXPECT_THAT(motion_rows(motions, summaries).table.columns.back().name, "storey");
}

// Each record has a building of its own, the same for all its floors; a study's number that is drawn besides changes none.
TEST_F(Upstairs, APeriodThatIsADistributionIsDrawnForEachRecord) {
  const std::string period = "period_s: {lognormal: {median: 0.6, dispersion: 0.2}}";
  const auto in = [&](const std::string& numbers, const std::string& storey = "{choice: [1, 3]}") {
    return study("building: {storeys: 4, " + numbers + "}, storey: " + storey, "ground.pga_g");
  };
  const Study swept = in(period);
  const MotionSet motions = load_motions(swept);
  ASSERT_EQ(motions.numbers.size(), 1U);
  EXPECT_EQ(motions.numbers[0].name, "building_period_s");
  std::vector<double> drawn;
  for (const auto& entry : *motions.entries) drawn.push_back(entry.numbers[0]);
  ASSERT_EQ(drawn.size(), 6U);  // the ground and two floors of each record
  EXPECT_NE(drawn[0], drawn[3]);
  for (const std::size_t record : {0U, 3U}) {
    motion::Building building = *swept.motions.front().building;
    building.period_s = drawn[record];
    const auto modes = motion::modes(building);
    EXPECT_NEAR(modes.front().period_s(), drawn[record], 1e-12);
    for (const int floor : {1, 2}) {
      EXPECT_EQ(drawn[record + floor], drawn[record]);
      EXPECT_EQ(motions.motion(record + floor).horizontal_mps2,
                motion::BuildingResponse(motions.motion(record), modes).floor(2 * floor - 1, "").horizontal_mps2);
    }
  }
  const MotionSet more = load_motions(in(period + ", damping: {uniform: [0.02, 0.08]}", "3"));
  EXPECT_EQ((*more.entries)[0].numbers[0], drawn[0]);
  EXPECT_EQ((*more.entries)[2].numbers[0], drawn[3]);
  EXPECT_NE(more.motion(1).horizontal_mps2, motions.motion(2).horizontal_mps2);  // of another damping
  ASSERT_EQ(more.numbers.back().name, "building_damping");
  motion::Building damped = *swept.motions.front().building;
  damped.period_s = drawn[0], damped.damping = (*more.entries)[1].numbers.back();
  EXPECT_EQ(more.motion(1).horizontal_mps2,
            motion::BuildingResponse(more.motion(0), motion::modes(damped)).floor(3, "").horizontal_mps2);
  EXPECT_EQ(load_motions(parse_study(expanded(swept), folder_ / "s.yaml", known(), Files::look)).fingerprint(),
            motions.fingerprint());
}

TEST_F(Upstairs, WhatTheBuildingsDrawsMayNotBeIsRefused) {
  const auto in = [&](const std::string& numbers) {
    return problem("building: {storeys: 4, " + numbers + "}, storey: 1");
  };
  EXPECT_THAT(in("period_s: {uniform: [0, 1]}, damping: {normal: {mean: 0.05, standard_deviation: 0.02}}"),
              HasSubstr("building.damping can take impossible values"));
  EXPECT_THAT(in("period_s: {normal: {mean: 0.5, standard_deviation: 0.2}}"),
              HasSubstr("building.period_s can take impossible values"));
  EXPECT_THAT(case_problems(block + friction + "motion: {file: " + (folder_ / "a.csv").string() +
                            ", building: {storeys: 3, period_s: {uniform: [0.4, 0.6]}}, storey: 1}\n"),
              HasSubstr("building.period_s is a distribution (a case is one sample)"));
}

// Over many records the draws follow the distribution: Kolmogorov's distance stays below 1.95/sqrt(n) in 999 of 1000 cases.
TEST(DrawnBuilding, FollowsItsDistribution) {
  BuildingPart part;
  part.name = "museum";
  part.drawn_period = Quantity{"building.period_s", "s", sampling::Uniform{0, 1}};
  std::vector<double> drawn_s;
  for (int record = 0; record < 400; ++record)
    drawn_s.push_back(*drawn(part, 3, "records/" + std::to_string(record) + ".AT2").period_s);
  std::sort(drawn_s.begin(), drawn_s.end());
  double distance = 0;
  for (int n = 0; n < 400; ++n)
    distance = std::max({distance, std::abs(drawn_s[n] - n / 400.0), std::abs(drawn_s[n] - (n + 1) / 400.0)});
  EXPECT_LT(distance, 1.95 / 20);
}

// On the ground of a building the ground's intensities are the motion's own.
TEST_F(Upstairs, StoreyZeroIsTheGround) {
  const MotionSet motions = load_motions(study("building: museum.yaml, storey: 0"));
  EXPECT_EQ(motions.size(), 2U);
  EXPECT_FALSE(motions.has_floors());
  const MotionSummaries summaries = summarize(motions, {1.0});
  const Table row{{{"motion", "1", ""},
                   {"scale", "1", ""},
                   {"pulse_period_s", "s", ""},
                   {"block_alpha_rad", "rad", ""},
                   {"block_p_radps", "rad/s", ""},
                   {"friction_mu_k", "1", ""}},
                  {1, 2, std::nan(""), 0.3, 2, 0.2}};
  EXPECT_EQ(SampleIntensity({"ground.pga_g"}, summaries)(row), SampleIntensity({"pga_g"}, summaries)(row));
}

TEST_F(Upstairs, WhatIsNoBuildingIsRefusedWithItsLine) {
  EXPECT_THAT(problem("building: museum.yaml"), HasSubstr("s.yaml:5: motions[0].storey is missing"));
  EXPECT_THAT(problem("storey: 3"), HasSubstr("motions[0].storey is of no building"));
  EXPECT_THAT(problem("building: museum.yaml, storey: 5"),
              HasSubstr("storey is 5 (the building has 4 floors above the ground"));
  EXPECT_THAT(problem("building: museum.yaml, storey: 1.5"), HasSubstr("name a whole number from 0 to 4"));
  EXPECT_THAT(problem("building: museum.yaml, storey: {choice: [1, -2]}"), HasSubstr("whole number from 0 to 4"));
  EXPECT_THAT(problem("building: museum.yaml, storey: {uniform: [1, 3]}"), HasSubstr("stands on whole storeys"));
  EXPECT_THAT(problem("building: nowhere.yaml, storey: 1"), HasSubstr("motions[0].building: "));
  EXPECT_THAT(problem("building: {storeys: 3}, storey: 1"), HasSubstr("neither period_s nor the stiffness_npm"));
  EXPECT_THAT(problem("building: {storeys: 3, period_s: 1, damping: -0.1}, storey: 1"), HasSubstr("damping is -0.1"));
  EXPECT_THAT(problem("building: {storeys: 3, period_s: 1, damping: 1}, storey: 1"), HasSubstr("damping is 1"));
  EXPECT_THAT(problem("building: {storeys: 3, period: 1}, storey: 1"), HasSubstr("write period_s"));
  EXPECT_THAT(problem("building: {storeys: [{mass_kg: 0, stiffness_npm: 1}]}, storey: 1"),
              HasSubstr("storeys[0].mass_kg is 0"));
  EXPECT_THAT(problem("building: {storeys: 0, period_s: 1}, storey: 1"), HasSubstr("storeys is 0"));
  EXPECT_THAT(problem("building: {period_s: 1}, storey: 1"), HasSubstr("storeys is missing"));
  EXPECT_THAT(problem("building: {storeys: 3, period_s: 1, rayleigh_modes: [1, 9]}, storey: 1"),
              HasSubstr("rayleigh_modes is [1, 9]"));
  EXPECT_THAT(problem("scale: 1", "ground.pga_g"), HasSubstr("take pga_g, or give building and storey"));
  std::ofstream(folder_ / "museum.yaml") << "storeys: 4\nperiod_s: 0.6\ndampign: 0.03\n";
  EXPECT_THAT(problem("building: museum.yaml, storey: 3"),
              HasSubstr("museum.yaml:3: unknown key dampign (did you mean damping?)"));
  EXPECT_THAT(problems(block + friction + samples + fragility +
                       "motions: [{pulse: B, period_s: 1, peak_acceleration_g: 1, building: {storeys: 1, period_s: 1}, "
                       "storey: 1}]\n"),
              HasSubstr("building does not go with pulse"));
  EXPECT_THAT(case_problems(block + friction + "motion: {file: " + (folder_ / "a.csv").string() +
                            ", building: {storeys: 3, period_s: 0.4}, storey: {choice: [1, 2]}}\n"),
              HasSubstr("motion.storey is a distribution (a case is one sample)"));
}

TEST_F(Upstairs, ABuildingOutsideTheRecordsBandIsRefused) {
  for (const char* period : {"0.03", "200"}) {
    const std::string text = freestand::test::error_text(Exit::data, [&] {
      load_motions(study(std::string("building: {storeys: 3, period_s: ") + period + "}, storey: 1"));
    });
    EXPECT_THAT(text, HasSubstr("a.csv: no mode of the building lies in the record's band"));
    EXPECT_THAT(text, HasSubstr("the same of"));
  }
}

TEST_F(Upstairs, OnlyFloorsAreKnownToBeFloors) {
  const Study upstairs = study("building: museum.yaml, storey: 3"), below = study("building: museum.yaml, storey: 0"),
              plain = study("scale: 1", "report");
  EXPECT_TRUE(is_of_a_floor("pga_g", upstairs));
  EXPECT_FALSE(is_of_a_floor("ground.pga_g", upstairs));
  EXPECT_FALSE(is_of_a_floor("record.pga_g", upstairs));
  EXPECT_FALSE(is_of_a_floor("pga_g", below));
  EXPECT_FALSE(is_of_a_floor("pga_g", plain));
}

}  // namespace
}  // namespace freestand::study::building_test
