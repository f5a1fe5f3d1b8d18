// Scales of length and time: a block and its record, and the same at a quarter of the size, give one dimensionless answer.
#include "motion/similitude.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <freestand/simulate.hpp>
#include <fstream>
#include <numbers>

#include "intensity/intensity.hpp"
#include "measurement/data/dataset.hpp"
#include "motion/peaks.hpp"
#include "motion/spectrum.hpp"
#include "study/intensities.hpp"
#include "study/motion_summaries.hpp"
#include "study/read_measurements.hpp"
#include "study/realise.hpp"
#include "study_text.hpp"
#include "support/error_text.hpp"
#include "support/scratch.hpp"

namespace freestand::study::similitude_test {
namespace {

using namespace test;
using testing::HasSubstr;

// Ten seconds of three sines with a beginning and an end, in steps of 1/128 s; with a vertical channel.
std::string record_text() {
  std::string text = "time_s,floor_acceleration_mps2,floor_vertical_acceleration_mps2\n";
  for (int i = 0; i <= 1280; ++i) {
    const double t = i / 128.0, grows = std::pow(std::sin(std::numbers::pi * t / 10), 2);
    const double a = grows * (3 * std::sin(7.3 * t) + 2 * std::sin(11.9 * t + 1) + std::sin(23.1 * t + 2));
    text += std::to_string(t) + "," + std::to_string(a) + "," + std::to_string(0.3 * grows * std::sin(31 * t)) + "\n";
  }
  return text;
}

class Scales : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder_ / "floor.csv") << record_text();
    std::ofstream(folder_ / "INDEX.csv") << "file,pga_g,pgv_mps,pgd_m,arias_mps,magnitude_mw,duration_s,mean_frequency_"
                                            "hz,sa_1s_g\nfloor.csv,0.5,1,0.25,3,6.5,8,2,0.7\n";
  }
  Study study(const std::string& motion, const std::string& more = "") const {
    return parse_study(block + friction + samples + fragility + "motions: [" + motion + "]\n" + more,
                       folder_ / "s.yaml", known());
  }
  FloorMotion motion(const std::string& keys) const {
    return load_motions(study("{records: floor.csv" + keys + "}")).motion(0);
  }
  std::string refusal(const std::string& keys) const {
    return freestand::test::error_text(Exit::usage, [&] { motion(keys); });
  }
  freestand::test::Scratch folder_{"similitude"};
};

struct Answers {
  Response fast, reference;
};

// Of a block of that size under the motion; the vertical channel is felt.
Answers answers(double size, double mu, ImpactLaw law, const FloorMotion& motion, double vertical, double free_s) {
  Specimen specimen;
  specimen.block = Block::rectangular(0.7 * size, 2.0 * size, 100);
  specimen.friction = {mu, mu};
  specimen.impact.law = law;
  const Shaking shaking{.motion = &motion, .scale = 1.5, .vertical_scale = vertical};
  const Settings settings{.free_vibration_s = free_s};
  return {respond(specimen, shaking, settings), respond_reference(specimen, shaking, settings)};
}

// A quarter of the size: slips a quarter, rotations and accelerations the same, times half. near: a relative difference.
void expect_the_same(const Response& full, const Response& quarter, double length, double time, double near) {
  const auto same = [&](double a, double b) { EXPECT_NEAR(a, b, near * (std::abs(a) + 1e-12)) << "of " << a; };
  EXPECT_EQ(full.outcome, quarter.outcome);
  EXPECT_EQ(full.impacts, quarter.impacts);
  EXPECT_EQ(full.events, quarter.events);
  same(full.peak_slip_m * length, quarter.peak_slip_m);
  same(full.residual_slip_m * length, quarter.residual_slip_m);
  same(full.slid_path_m * length, quarter.slid_path_m);
  same(full.peak_rotation_rad, quarter.peak_rotation_rad);
  same(full.peak_acceleration_mps2, quarter.peak_acceleration_mps2);
  same(full.end_time_s * time, quarter.end_time_s);
}

TEST_F(Scales, AQuarterScaleModelGivesTheAnswerOfFullSizeToTheBit) {
  const FloorMotion full = motion(""), quarter = motion(", time_scale: 0.5, length_scale: 0.25");
  for (const double mu : {0.15, 0.3, 0.8})
    for (const ImpactLaw law : {ImpactLaw::housner, ImpactLaw::coulomb})
      for (const double vertical : {0.0, 1.0}) {
        SCOPED_TRACE(testing::Message() << "mu " << mu << ", law " << static_cast<int>(law) << ", vertical "
                                        << vertical);
        const Answers of_full = answers(1, mu, law, full, vertical, 16);
        const Answers of_quarter = answers(0.25, mu, law, quarter, vertical, 8);
        EXPECT_GT(of_full.fast.events, 0);
        expect_the_same(of_full.fast, of_quarter.fast, 0.25, 0.5, 0);
        expect_the_same(of_full.reference, of_quarter.reference, 0.25, 0.5, 1e-6);
      }
}

TEST_F(Scales, AModelAtFiveTwelfthsGivesItToRoundOff) {
  const double length = 5.0 / 12, time = std::sqrt(length);
  const FloorMotion full = motion(""), model = motion(", length_scale: " + std::to_string(length));
  const double given = std::stod(std::to_string(length));
  const Answers of_full = answers(1, 0.15, ImpactLaw::housner, full, 0, 16);
  const Answers of_model = answers(given, 0.15, ImpactLaw::housner, model, 0, 16 * time);
  expect_the_same(of_full.fast, of_model.fast, given, std::sqrt(given), 1e-9);
}

TEST_F(Scales, OneOfTheTwoLeavesAccelerationsAsTheyAre) {
  const FloorMotion full = motion("");
  for (const char* keys : {", time_scale: 0.5", ", length_scale: 0.25"}) {
    const FloorMotion model = motion(keys);
    EXPECT_EQ(model.duration_s(), full.duration_s() / 2);
    EXPECT_EQ(motion::peaks(model).pga_mps2, motion::peaks(full).pga_mps2);
    EXPECT_EQ(motion::peaks(model).pgd_m, motion::peaks(full).pgd_m / 4);
  }
}

TEST_F(Scales, IntensitiesFollow) {
  const Study full = study("{records: INDEX.csv}");
  const Study model = study("{records: INDEX.csv, time_scale: 0.5, length_scale: 0.125}");  // accelerations halved
  const auto summary = [](const Study& s, double period) { return summarize(load_motions(s), {period}).front(); };
  const motion::MotionSummary of_full = summary(full, 1), of_model = summary(model, 0.5);
  EXPECT_EQ(of_model.peaks.pga_mps2, of_full.peaks.pga_mps2 / 2);
  EXPECT_EQ(of_model.peaks.pgv_mps, of_full.peaks.pgv_mps / 4);
  EXPECT_EQ(of_model.peaks.pgd_m, of_full.peaks.pgd_m / 8);
  EXPECT_NEAR(motion::spectral_acceleration_mps2(of_model, 0.5, 1),
              motion::spectral_acceleration_mps2(of_full, 1, 1) / 2, 1e-12);
  EXPECT_NEAR(of_model.pulse.period_s, of_full.pulse.period_s / 2, 1e-3 * of_full.pulse.period_s);
  const auto given = [&](const char* column) { return of_model.given_value(column) / of_full.given_value(column); };
  EXPECT_EQ(given("pga_g"), 0.5);
  EXPECT_EQ(given("pgv_mps"), 0.25);
  EXPECT_EQ(given("pgd_m"), 0.125);
  EXPECT_EQ(given("arias_mps"), 0.125);  // integral of a^2
  EXPECT_EQ(given("magnitude_mw"), 1);
  EXPECT_EQ(given("duration_s"), 0.5);
  EXPECT_EQ(given("mean_frequency_hz"), 2);
  EXPECT_TRUE(std::isnan(given("sa_1s_g")));  // which is that of half a second now
}

TEST_F(Scales, StandInTheExpandedStudyAndInItsFingerprint) {
  const Study model = study("{records: floor.csv, length_scale: 0.25}");
  EXPECT_THAT(expanded(model), HasSubstr("time_scale: 0.5\n    length_scale: 0.25\n"));
  const Study again = parse_study(expanded(model), folder_ / "s.yaml", known());
  EXPECT_EQ(expanded(again), expanded(model));
  EXPECT_EQ(load_motions(again).fingerprint(), load_motions(model).fingerprint());
  EXPECT_NE(samples_fingerprint(model), samples_fingerprint(study("{records: floor.csv}")));
  const Case one = parse_case(block + friction + "motion: {file: floor.csv, time_scale: 0.5}\n", folder_ / "c.yaml");
  EXPECT_THAT(expanded(one, folder_.folder()), HasSubstr("length_scale: 0.25"));
}

TEST_F(Scales, ThatShakeNothingAreRefusedWithTheirLine) {
  for (const char* value : {"0", "-0.5", "1e-300", "1e-12", "2e4"}) {
    EXPECT_THAT(refusal(std::string(", time_scale: ") + value), HasSubstr("s.yaml:5: motions[0].time_scale"));
    EXPECT_THAT(refusal(std::string(", length_scale: ") + value), HasSubstr("it must lie from 1e-4 to 1e4"));
  }
  EXPECT_THAT(refusal(", time_scale: {uniform: [0.5, 1]}"), HasSubstr("motions[0].time_scale"));
  EXPECT_THAT(problems(block + friction + samples + fragility +
                       "motions: [{pulse: B, period_s: 0.5, peak_acceleration_g: 1, time_scale: 0.5}]\n"),
              HasSubstr("motions[0].time_scale does not go with pulse"));
}

// A measured test says what its table did by a record and the scale of the model.
TEST_F(Scales, OfAMeasuredTestGoWithItsRecord) {
  const auto read = [&](const std::string& test) {
    std::ofstream(folder_ / "dataset.yaml") << "format: freestand-measurements/1\nspecimen: {width_m: 0.2, height_m: "
                                               "0.5, mass_kg: 10}\ntests:\n  - {id: a, role: calibration, "
                                            << test << "}\n";
    return read_measurements(folder_ / "dataset.yaml");
  };
  const auto data = read("motion: floor.csv, length_scale: 0.25, peak_slip_m: 0.01");
  EXPECT_EQ(data.tests.front().motion.horizontal_mps2, motion(", length_scale: 0.25").horizontal_mps2);
  EXPECT_THAT(
      freestand::test::error_text(Exit::data, [&] { read("motion: floor.csv, time_scale: 0, overturned: true"); }),
      HasSubstr("dataset.yaml:4: tests[0].time_scale"));
  EXPECT_THAT(freestand::test::error_text(Exit::data,
                                          [&] {
                                            read(
                                                "pulse: B, period_s: 0.5, peak_acceleration_g: 1, time_scale: 0.5, "
                                                "peak_slip_m: 0.01");
                                          }),
              HasSubstr("tests[0].time_scale goes with motion alone"));
}

}  // namespace
}  // namespace freestand::study::similitude_test
