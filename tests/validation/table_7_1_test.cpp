// Table 7.1: quarter-scale wooden blocks on the shake table, overturned or not (report/quarter_scale.hpp): the 18 rows of the two
// sound blocks, 16 of them under motions whose records are there.
//
//   half power       as recorded    20 Hz   10 Hz
//   Brier score        0.55          0.18    0.18      mean of (probability - outcome)^2; a coin gets 0.25
//   after the others   0.46         0.12     0.08
//   agree, of 16       2, 6          8, 12   8, 13    the report's own model, under the table's motions: 12
//
// Were the two files of Los Gatos added as if they began together, the Brier scores would be 0.43, 0.32 and 0.22.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "motion/record.hpp"
#include "report/quarter_scale.hpp"
#include "support/data.hpp"

namespace freestand::test::table_7_1_test {
namespace {

using report::BlockTest;
using report::predict;
using report::Prediction;
using report::read_component;
using report::record_dt_s;
using report::Score;
using report::score;
using report::Sides;
using report::sound_tests;
using report::Sources;
using report::Station;
using report::station_of;
using report::stations;
using report::weight_after_others;

Sources sources() { return {.tables = source_dir() / "configs/report", .records = records_dir()}; }

std::filesystem::path folder() { return records_dir() / "slammer/Loma_Prieta_1989"; }

// Sample in which the first hundredth of the integral of acceleration^2 has come.
std::size_t arrival(const std::vector<double>& samples) {
  double total = 0, so_far = 0;
  for (const double a : samples) total += a * a;
  std::size_t k = 0;
  for (; so_far < 0.01 * total; ++k) so_far += samples[k] * samples[k];
  return k;
}

std::vector<Prediction> predicted(double half_power_hz, double Sides::*width) {
  const std::vector<Prediction> all = predict(sources(), records_dir(), half_power_hz, width);
  for (const Prediction& one : all)
    std::printf(
        "  %-10s %-38s %.2f g  experiment %d, its model %d; normal %.2f, parallel %.2f; after the others %.2f\n",
        one.test.block.c_str(), one.test.motion.c_str(), one.test.pta_g, one.test.overturned,
        one.test.working_model_overturned, one.normal, one.parallel, one.mixed(weight_after_others(all, one)));
  return all;
}

TEST(Table7_1AsPrinted, EighteenRowsOfSoundBlocksAndSixteenRecords) {
  int rows = 0, with_record = 0, overturned = 0, model_agrees = 0;
  for (const BlockTest& row : sound_tests(sources())) {
    ++rows;
    with_record += station_of(row.motion) != nullptr;
    overturned += row.overturned;
    model_agrees += row.working_model_overturned == row.overturned;
    if (!station_of(row.motion)) std::printf("no record of %s (%s): left out\n", row.motion.c_str(), row.block.c_str());
  }
  EXPECT_EQ(rows, 18);
  EXPECT_EQ(with_record, 16);
  EXPECT_EQ(overturned, 16);
  EXPECT_EQ(model_agrees, 14);
}

class Table7_1 : public testing::Test {
 protected:
  void SetUp() override {
    for (const Station& station : stations)
      for (const char* file : station.files)
        if (!std::filesystem::exists(folder() / file))
          GTEST_SKIP() << "record " << folder() / file << " is not there: set FREESTAND_DATA_DIR to run this test";
  }
};

// At one station the shaking comes from both sides at one time: within 0.2 s where the two files are known to begin together.
TEST_F(Table7_1, ComponentsOfAStationBeginWhereTheirShakingMeets) {
  for (const Station& station : stations) {
    double begins_s[2];
    for (int i = 0; i < 2; ++i)
      begins_s[i] =
          record_dt_s * static_cast<double>(station.begins[i] + arrival(read_component(folder(), station.files[i])));
    EXPECT_NEAR(begins_s[0], begins_s[1], 0.2) << station.named;
  }
}

TEST_F(Table7_1, CorralitosBeginsAsThePairThatBeginsTogether) {
  const auto pair = records_dir() / "peer_ngawest2_corralitos";
  if (!std::filesystem::exists(pair)) GTEST_SKIP() << "records " << pair << " are not there";
  for (const auto& [file, whole] :
       {std::pair{"CLS-000", "RSN753_LOMAP_CLS000.AT2"}, {"CLS-090", "RSN753_LOMAP_CLS090.AT2"}}) {
    const std::vector<double> cut = read_component(folder(), file);
    const FloorMotion motion = motion::read_record(pair / whole);
    double difference = 0, size = 0;
    for (std::size_t k = 0; k < cut.size(); ++k) {
      difference += std::pow(cut[k] - motion.horizontal_mps2[2 * k], 2);
      size += cut[k] * cut[k];
    }
    EXPECT_LT(std::sqrt(difference / size), 0.03) << file;  // 0.05 s apart they would differ by more than 1
  }
}

// The numbers are what this program gives with 2000 members, kept so that a change of the kernel that moves them is seen. Nearly all of
// the experiments overturned, so that "always" is right in 14 of the 16.
TEST_F(Table7_1, OutcomesOfTheEnsembles) {
  struct Expected {
    double half_power_hz, brier, brier_after_others;
    int agree, agree_after_others;
  };
  constexpr Expected expected[] = {{0, 0.546, 0.462, 2, 6}, {20, 0.179, 0.115, 8, 12}, {10, 0.183, 0.082, 8, 13}};
  for (const Expected& e : expected) {
    std::printf("table that follows up to %.0f Hz (0: the record as it is)\n", e.half_power_hz);
    const Score s = score(predicted(e.half_power_hz, &Sides::narrow_m));
    std::printf(
        "  Brier %.3f, %d agree; after the others %.3f, %d; the report's model %d; FORMA %.2f, Kelvinator %.2f\n",
        s.brier, s.agree, s.brier_after_others, s.agree_after_others, s.working_model_agrees, s.forma, s.kelvinator);
    EXPECT_NEAR(s.brier, e.brier, 0.02);
    EXPECT_NEAR(s.brier_after_others, e.brier_after_others, 0.02);
    EXPECT_NEAR(s.agree, e.agree, 1);
    EXPECT_NEAR(s.agree_after_others, e.agree_after_others, 1);
    EXPECT_EQ(s.working_model_agrees, 12);
    EXPECT_NEAR(s.forma, s.kelvinator, 0.1);  // 8 of 8 and 6 of 8 in the experiment
  }
}

// So the experiment, where it always overturned, shook it along its narrow side.
TEST_F(Table7_1, FormaNearlyAlwaysStandsOnItsWideSide) {
  for (const double half_power_hz : {0.0, 20.0, 10.0}) {
    double sum = 0, most = 0;
    int rows = 0;
    for (const Prediction& one : predicted(half_power_hz, &Sides::wide_m))
      if (one.test.block == "FORMA") {
        ++rows;
        sum += one.mixed(0.5);
        most = std::max({most, one.normal, one.parallel});
      }
    std::printf("up to %.0f Hz: on its wide side FORMA overturns with probability %.3f, at most %.2f\n", half_power_hz,
                sum / rows, most);
    EXPECT_LT(sum / rows, half_power_hz == 10 ? 0.05 : 0.005);
  }
}

}  // namespace
}  // namespace freestand::test::table_7_1_test
