// The pulse of a record as the user gives it: in delta, on an axis, in the files, beside the one that is identified.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "study/evaluator.hpp"
#include "study/intensities.hpp"
#include "study/known.hpp"
#include "study/motion_summaries.hpp"
#include "study_text.hpp"
#include "support/error_text.hpp"
#include "support/scratch.hpp"

namespace freestand::study::known_pulse_test {
namespace {

using namespace test;
using testing::HasSubstr;

class KnownPulse : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"a.csv", "b.csv"}) {
      std::ofstream file(folder_ / name);
      file << "time_s,floor_acceleration_mps2\n";
      for (int i = 0; i <= 400; ++i) {
        const double t = i * 0.01, inside = t > 1 && t < 2 ? 1 : 0;  // a pulse A of 1 s in 4 s
        file << t << "," << inside * 6 * std::sin(2 * std::numbers::pi * (t - 1)) << "\n";
      }
    }
    std::ofstream(folder_ / "INDEX.csv") << "file,pulse_type,pulse_period_s\na.csv,B,0.5\nb.csv,,\n";
  }
  Study study(const std::string& keys, const std::string& fragility = "{edp: [delta]}") const {
    return parse_study(block + "friction: {mu: 0.1}\nmodel: slide\n" + samples + "motions: [{" + keys +
                           "}]\nfragility: " + fragility + "\n",
                       folder_ / "s.yaml", registries());
  }
  // Of the first samples.
  std::vector<double> column(const Study& s, const std::string& name, std::size_t count = 1) const {
    const Evaluator evaluator(s, load_motions(s), summarize(load_motions(s), {1.0}));
    Table rows{evaluator.columns(), {}};
    evaluator.append(0, count, rows.values);
    const Table wide = SampleIntensity({"pga_g"}, evaluator.summaries()).beside(rows);
    std::vector<double> values;
    for (std::size_t row = 0; row < count; ++row) values.push_back(wide.at(row, column_index(wide.columns, name)));
    return values;
  }
  std::string refusal(const std::string& keys) const {
    return freestand::test::error_text(Exit::usage, [&] { study(keys); });
  }
  freestand::test::Scratch folder_{"known_pulse"};
};

TEST_F(KnownPulse, IsThatOfDelta) {
  const Study identified = study("records: a.csv"), given = study("records: a.csv, pulse_period_s: 0.5");
  const double slip = column(given, "edp_peak_slip_m")[0], w = 2 * std::numbers::pi / 0.5;
  EXPECT_EQ(slip, column(identified, "edp_peak_slip_m")[0]);
  EXPECT_GT(slip, 0.01);
  EXPECT_NEAR(column(given, "edp_delta")[0], slip * w * w / 6, 1e-6 * slip * w * w);
  EXPECT_NEAR(column(given, "edp_delta")[0] / column(identified, "edp_delta")[0], 4, 0.1);  // identified: 1 s
}

TEST_F(KnownPulse, OfARowStandsBeforeThatOfTheEntry) {
  const Study s = study("records: INDEX.csv, pulse_period_s: 0.8, pulse_type: C1");
  const MotionSummaries summaries = summarize(load_motions(s), {});
  EXPECT_EQ(summaries[0].pulse.period_s, 0.5);
  EXPECT_EQ(summaries[0].pulse.type, "B");
  EXPECT_EQ(summaries[1].pulse.period_s, 0.8);
  EXPECT_EQ(summaries[1].pulse.type, "C1");
}

TEST_F(KnownPulse, GoesWithTheTimeScale) {
  const Study s = study("records: INDEX.csv, time_scale: 0.5");
  EXPECT_EQ(summarize(load_motions(s), {})[0].pulse.period_s, 0.25);
}

TEST_F(KnownPulse, IsAnAxis) {
  const Study s = study("records: INDEX.csv", "{edp: [delta], axes: [motion.pulse_period_s]}");
  const std::vector<double> periods = column(s, "motion_pulse_period_s", 40);
  EXPECT_THAT(periods, testing::Contains(0.5));
  for (const double period : periods) EXPECT_TRUE(period == 0.5 || std::abs(period - 1) < 0.01) << period;
  const Study pulses = study("pulse: B, period_s: {uniform: [0.3, 0.9]}, peak_acceleration_g: 0.5",
                             "{edp: [delta], axes: [motion.pulse_period_s]}");
  EXPECT_EQ(column(pulses, "motion_pulse_period_s", 8), column(pulses, "pulse_period_s", 8));
}

TEST_F(KnownPulse, IsToldInTheFilesAndBack) {
  const Study s = study("records: INDEX.csv");
  const MotionSet motions = load_motions(s);
  const MotionSummaries summaries = summarize(motions, {1.0});
  io::MotionRows rows = motion_rows(motions, summaries);
  rows.group = motions.groups();
  const MotionSummaries back = motion_summaries(rows);
  EXPECT_TRUE(back[0].pulse.period_given && back[0].pulse.type_given);
  EXPECT_FALSE(back[1].pulse.period_given || back[1].pulse.type_given);
  EXPECT_EQ(back[0].arias_mps, summaries[0].arias_mps);
  EXPECT_EQ(record_pulses_json(back).dump(), R"({"records":2,"period_given":1,"period_identified":1})");
  const Study again = parse_study(expanded(study("records: a.csv, pulse_type: B, pulse_period_s: 0.5")),
                                  folder_ / "s.yaml", registries());
  EXPECT_EQ(again.motions.front().pulse, (motion::KnownPulse{"B", 0.5}));
}

// Files of before have no such columns.
TEST_F(KnownPulse, IsIdentifiedInFilesThatDoNotSay) {
  const Study s = study("records: a.csv");
  const MotionSet motions = load_motions(s);
  io::MotionRows rows = motion_rows(motions, summarize(motions, {1.0}));
  for (const char* name : {"pulse_given", "arias_mps", "cav_mps"}) {
    const std::size_t at = column_index(rows.table.columns, name);
    rows.table.columns.erase(rows.table.columns.begin() + static_cast<std::ptrdiff_t>(at));
    rows.table.values.erase(rows.table.values.begin() + static_cast<std::ptrdiff_t>(at));
  }
  const motion::MotionSummary back = motion_summaries(rows).front();
  EXPECT_FALSE(back.pulse.period_given);
  EXPECT_NEAR(back.pulse.period_s, 1, 0.01);
  EXPECT_TRUE(std::isnan(back.arias_mps));
}

// The results would be others, so that they are not gone on with.
TEST_F(KnownPulse, CountsInTheFingerprintOfTheMotions) {
  const std::string before = load_motions(study("records: INDEX.csv")).fingerprint();
  std::ofstream(folder_ / "INDEX.csv") << "file,pulse_type,pulse_period_s\na.csv,B,0.6\nb.csv,,\n";
  EXPECT_NE(load_motions(study("records: INDEX.csv")).fingerprint(), before);
}

TEST_F(KnownPulse, ThatIsNoneIsRefusedWithItsLine) {
  EXPECT_THAT(refusal("records: a.csv, pulse_period_s: 0"), HasSubstr("motions[0].pulse_period_s"));
  EXPECT_THAT(refusal("records: a.csv, pulse_type: D"), HasSubstr("motions[0].pulse_type is D"));
  EXPECT_THAT(refusal("pulse: B, period_s: 1, peak_acceleration_g: 1, pulse_period_s: 1"),
              HasSubstr("motions[0].pulse_period_s does not go with pulse"));
  std::ofstream(folder_ / "INDEX.csv") << "file,pulse_type,pulse_period_s\na.csv,D,-1\n";
  EXPECT_THAT(refusal("records: INDEX.csv"), testing::AllOf(HasSubstr("INDEX.csv:2: pulse_type is \"D\""),
                                                            HasSubstr("pulse_period_s is not above zero")));
  EXPECT_THAT(
      freestand::test::error_text(
          Exit::usage,
          [&] { parse_case(block + friction + "motion: {file: a.csv, pulse_period_s: 1}\n", folder_ / "c.yaml"); }),
      HasSubstr("a case has no demand that looks at them"));
}

}  // namespace
}  // namespace freestand::study::known_pulse_test
