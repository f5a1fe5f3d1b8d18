// What a study asks to be done to records: baseline, band-pass, pairs turned into one direction.
#include "motion/processing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "motion/record.hpp"
#include "study/realise.hpp"
#include "study_text.hpp"
#include "support/error_text.hpp"
#include "support/scratch.hpp"

namespace freestand::study::processing_test {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;

class Processed : public testing::Test {
 protected:
  void SetUp() override {
    record("a.csv", 400, 3);
    record("b.csv", 400, 5);
    record("short.csv", 300, 5);
    std::filesystem::create_directories(folder_ / "H1");
    std::filesystem::create_directories(folder_ / "H2");
    for (const char* name : {"H1/1.csv", "H1/2.csv", "H2/1.csv", "H2/2.csv"}) record(name, 100, name[1] + name[3]);
    std::ofstream(folder_ / "INDEX.csv")
        << "file,event,station,component,strike_deg,pga_g\na.csv,E,S,000,128,0.5\nb.csv,E,S,090,128,0.6\n";
  }
  void record(const std::string& name, int count, int seed) const {
    std::ofstream file(folder_ / name);
    file << "time_s,floor_acceleration_mps2\n";
    for (int i = 0; i < count; ++i) file << i * 0.01 << "," << ((i * i * seed) % 17 - 8) / 4.0 << "\n";
  }
  MotionSet motions(const std::string& keys) const {
    return load_motions(parse_study(block + friction + samples + fragility + "motions: [{" + keys + "}]\n",
                                    folder_ / "s.yaml", known()));
  }
  MotionValues values(const std::string& keys) const { return motions(keys).motion(0).horizontal_mps2; }
  std::string refusal(Exit exit, const std::string& keys) const {
    return freestand::test::error_text(exit, [&] { motions(keys); });
  }
  freestand::test::Scratch folder_{"processing"};
};

TEST_F(Processed, IsWhatTheFunctionsGiveInTheirOrder) {
  const FloorMotion raw = motions("records: a.csv").motion(0);
  const FloorMotion level = motion::remove_baseline(raw, motion::Baseline::quadratic);
  const FloorMotion passed = motion::band_pass(level, {0.5, 20});
  EXPECT_EQ(values("records: a.csv, baseline: quadratic"), level.horizontal_mps2);
  EXPECT_EQ(values("records: a.csv, baseline: quadratic, band_pass_hz: [0.5, 20]"), passed.horizontal_mps2);
  EXPECT_EQ(values("records: a.csv, baseline: quadratic, band_pass_hz: [0.5, 20], time_scale: 0.5"),
            motion::at_scale(passed, motion::similitude(0.5, {})).horizontal_mps2);
}

TEST_F(Processed, StandsInTheExpandedStudy) {
  const auto again = [&](const std::string& keys) {
    const std::string text = block + friction + samples + fragility + "motions: [{" + keys + "}]\n";
    const Study one = parse_study(text, folder_ / "s.yaml", known());
    const Study other = parse_study(expanded(one), folder_ / "s.yaml", known());
    EXPECT_EQ(expanded(one), expanded(other));
    EXPECT_EQ(load_motions(one).fingerprint(), load_motions(other).fingerprint());
    return expanded(one);
  };
  EXPECT_THAT(again("records: a.csv, baseline: linear, band_pass_hz: [0.5, 20]"),
              AllOf(HasSubstr("baseline: linear"), HasSubstr("band_pass_hz: [0.5, 20]")));
  EXPECT_THAT(again("records: a.csv, cross_records: b.csv, rotate_deg: 38"),
              AllOf(HasSubstr("cross_records: b.csv"), HasSubstr("rotate_deg: 38")));
  EXPECT_THAT(again("records: INDEX.csv, rotate: fault_parallel"), HasSubstr("rotate: fault_parallel"));
  EXPECT_THAT(again("records: a.csv, cross_records: short.csv, rotate_deg: 38, begin_together: true"),
              HasSubstr("begin_together: true"));
  const Case one =
      parse_case(block + friction + "motion: {file: a.csv, cross_file: b.csv, rotate_deg: 90}\n", folder_ / "c.yaml");
  EXPECT_THAT(expanded(one, folder_.folder()), HasSubstr("cross_file: b.csv"));
  EXPECT_EQ(load_motions(one.study).motion(0).horizontal_mps2, values("records: b.csv"));
}

TEST_F(Processed, PairsAreTurnedByAnAngleAndByAzimuths) {
  EXPECT_EQ(values("records: a.csv, cross_records: b.csv, rotate_deg: 0"), values("records: a.csv"));
  EXPECT_EQ(values("records: a.csv, cross_records: b.csv, rotate_deg: 90"), values("records: b.csv"));
  EXPECT_EQ(values("records: INDEX.csv, rotate_deg: 90"), values("records: b.csv"));
  EXPECT_EQ(motions("records: INDEX.csv, rotate_deg: 90").size(), 1u);
  EXPECT_EQ(values("records: INDEX.csv, rotate: fault_parallel"),
            values("records: a.csv, cross_records: b.csv, rotate_deg: 128"));
  EXPECT_EQ(values("records: INDEX.csv, rotate: fault_normal"),
            values("records: a.csv, cross_records: b.csv, rotate_deg: 218"));
  const MotionSet two = motions("records: H1/*.csv, cross_records: H2/*.csv, rotate_deg: 90");
  EXPECT_EQ(two.motion(1).horizontal_mps2, values("records: H2/2.csv"));
}

TEST_F(Processed, WhatCannotBeDoneIsRefusedWithTheReason) {
  EXPECT_THAT(refusal(Exit::usage, "records: a.csv, baseline: cubic"), HasSubstr("motions[0].baseline"));
  for (const char* band : {"[10, 1]", "[0, 10]", "[1]", "[1, 2, 3]"})
    EXPECT_THAT(refusal(Exit::usage, std::string("records: a.csv, band_pass_hz: ") + band),
                HasSubstr("s.yaml:5: motions[0].band_pass_hz is no band"));
  EXPECT_THAT(refusal(Exit::data, "records: a.csv, band_pass_hz: [0.5, 60]"),
              AllOf(HasSubstr("a.csv"), HasSubstr("60 Hz")));
  EXPECT_THAT(refusal(Exit::usage, "records: a.csv, rotate_deg: 38"), HasSubstr("one component only"));
  EXPECT_THAT(refusal(Exit::usage, "records: a.csv, cross_records: b.csv"), HasSubstr("second horizontal channel"));
  EXPECT_THAT(refusal(Exit::usage, "records: a.csv, cross_records: b.csv, rotate: fault_normal"),
              HasSubstr("goes with a table of records"));
  EXPECT_THAT(refusal(Exit::usage, "records: INDEX.csv, rotate: fault_normal, rotate_deg: 3"), HasSubstr("both given"));
  EXPECT_THAT(refusal(Exit::usage, "records: H1/*.csv, cross_records: a.csv, rotate_deg: 3"),
              HasSubstr("matches 1 files but records matches 2"));
  EXPECT_THAT(refusal(Exit::data, "records: a.csv, cross_records: short.csv, rotate_deg: 3"),
              AllOf(HasSubstr("a.csv"), HasSubstr("short.csv"), HasSubstr("400 and 300 samples")));
  std::ofstream(folder_ / "INDEX.csv") << "file,event,station,component\na.csv,E,S,000\nb.csv,E,S,090\n";
  EXPECT_THAT(refusal(Exit::usage, "records: INDEX.csv, rotate: fault_normal"),
              AllOf(HasSubstr("INDEX.csv:2"), HasSubstr("strike_deg")));
  EXPECT_THAT(refusal(Exit::usage, "records: INDEX.csv, cross_records: b.csv, rotate_deg: 3"),
              HasSubstr("does not go with a table of records"));
  std::ofstream(folder_ / "INDEX.csv") << "file,event,station,component\na.csv,E,S,000\nb.csv,E,T,090\n";
  EXPECT_THAT(refusal(Exit::usage, "records: INDEX.csv, rotate_deg: 3"),
              AllOf(HasSubstr("INDEX.csv:2"), HasSubstr("INDEX.csv:3")));
}

}  // namespace
}  // namespace freestand::study::processing_test
