// Intensities that a table of records brings: at the scale of each sample, in the file of samples and back.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "study/intensities.hpp"
#include "study/known.hpp"
#include "study/motion_summaries.hpp"
#include "study_text.hpp"
#include "support/error_text.hpp"
#include "support/scratch.hpp"

namespace freestand::study::record_numbers_test {
namespace {

using namespace test;
using testing::HasSubstr;

class RecordNumbers : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"a.csv", "b.csv"})
      std::ofstream(folder_ / name) << "time_s,floor_acceleration_mps2\n0,0\n0.1,1\n0.2,0\n0.3,-2\n0.4,0\n";
    std::ofstream(folder_ / "INDEX.csv") << "file,pga_g,arias_mps,magnitude_mw\na.csv,0.3,2,6.5\nb.csv,,1,7\n";
  }
  Study study(const std::string& im, Files look = Files::look) const {
    return parse_study(block + friction + samples +
                           "motions: [{records: INDEX.csv, scale: 1.5}]\nfragility: {edp: [delta], im: " + im + "}\n",
                       folder_ / "s.yaml", known(), look);
  }
  freestand::test::Scratch folder_{"record_numbers"};
};

TEST_F(RecordNumbers, AreScaledAsTheyAre) {
  const Study swept = study("record.pga_g");
  const MotionSet motions = load_motions(swept);
  const MotionSummaries summaries = summarize(motions, {1.0});
  const Table rows{{{"motion", "1", ""},
                    {"scale", "1", ""},
                    {"pulse_period_s", "s", ""},
                    {"block_alpha_rad", "rad", ""},
                    {"block_p_radps", "rad/s", ""},
                    {"friction_mu_k", "1", ""}},
                   {0, -1.5, std::nan(""), 0.3, 2, 0.2, 1, 1.5, std::nan(""), 0.3, 2, 0.2}};
  const double nan = std::nan("");
  const auto is = [](std::vector<double> values) {
    return testing::Pointwise(testing::NanSensitiveDoubleEq(), std::move(values));
  };
  for (const MotionSummaries& of : {summaries, motion_summaries(motion_rows(motions, summaries))}) {
    EXPECT_THAT(SampleIntensity({"record.pga_g"}, of)(rows), is({0.45, nan}));
    EXPECT_THAT(SampleIntensity({"record.arias_mps"}, of)(rows), is({4.5, 2.25}));
    EXPECT_THAT(SampleIntensity({"record.magnitude_mw"}, of)(rows), is({6.5, 7}));
  }
  EXPECT_EQ(SampleIntensity({"record.pga_g"}, summaries).beside(rows).columns.back().unit, "g");
}

// Drawn in proportion, so that all that is counted is of the weighted records, with no weights after.
TEST_F(RecordNumbers, AWeightIsHowOftenARecordIsDrawn) {
  const auto share_of_a = [&](const std::string& table) {
    std::ofstream(folder_ / "INDEX.csv") << table;
    const Study swept = study("report");
    const Realiser realise(swept, load_motions(swept));
    int first = 0;
    for (std::uint64_t i = 0; i < 4096; ++i) first += realise(i).motion == 0;
    return first / 4096.0;
  };
  const auto fingerprint = [&] { return load_motions(study("report")).fingerprint(); };
  EXPECT_NEAR(share_of_a("file\na.csv\nb.csv\n"), 0.5, 0.03);
  const std::string alike = fingerprint();
  EXPECT_NEAR(share_of_a("file,weight\na.csv,3\nb.csv,1\n"), 0.75, 0.03);
  EXPECT_NE(fingerprint(), alike);
  EXPECT_EQ(share_of_a("file,weight\na.csv,0\nb.csv,1\n"), 0);
  for (const char* wrong : {"-1", "", "much"})
    EXPECT_THAT(freestand::test::error_text(
                    Exit::usage, [&] { share_of_a("file,weight\na.csv," + std::string(wrong) + "\nb.csv,1\n"); }),
                HasSubstr("INDEX.csv:2: weight is"));
  EXPECT_THAT(freestand::test::error_text(Exit::usage, [&] { share_of_a("file,weight\na.csv,0\nb.csv,0\n"); }),
              HasSubstr("no record a weight above 0"));
}

TEST_F(RecordNumbers, OnlyThoseOfTheTableAreKnown) {
  EXPECT_THAT(freestand::test::error_text(Exit::usage, [&] { study("record.pgv_mps"); }),
              testing::HasSubstr("record.pgv_mps is not known (did you mean record.pga_g?)"));
  EXPECT_EQ(study("record.pgv_mps", Files::ignore).fragility.im.name, "record.pgv_mps");
  EXPECT_EQ(expanded(study("record.pga_g", Files::ignore)), expanded(study("record.pga_g")));
}

}  // namespace
}  // namespace freestand::study::record_numbers_test
