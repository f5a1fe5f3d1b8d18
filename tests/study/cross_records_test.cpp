// Records in pairs of horizontal components: how they are named, what they give, what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>

#include "study/evaluator.hpp"
#include "study/motion_summaries.hpp"
#include "study/simulate.hpp"
#include "study_text.hpp"
#include "support/scratch.hpp"

namespace freestand::study::cross_records_test {
namespace {

using namespace test;
using testing::HasSubstr;

// What is thrown; "" where nothing is.
template <class Work>
std::string text_of(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

class CrossRecords : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* folder : {"along", "across"}) std::filesystem::create_directories(folder_ / folder);
    write("along/a.csv", 200, [](double t) { return 4 * std::sin(5 * t); });
    write("along/b.csv", 200, [](double t) { return 3 * std::sin(9 * t) + t; });
    write("across/a.csv", 200, [](double t) { return 3 * std::cos(5 * t); });
    write("across/b.csv", 200, [](double) { return 0.0; });
  }
  template <class Value>
  void write(const std::string& name, int rows, Value&& value, double dt = 0.01) {
    std::ofstream file(folder_ / name);
    file << "time_s,floor_acceleration_mps2\n";
    for (int i = 0; i < rows; ++i) file << i * dt << ',' << value(i * dt) << '\n';
  }
  Study study(const std::string& motion, const std::string& more = "model: slide\n") const {
    return parse_study(block + friction + samples +
                           "fragility: {edp: [peak_slip_m], capacities: {peak_slip_m: [0.1]}}\nmotions: [" + motion +
                           "]\n" + more,
                       folder_ / "s.yaml", known());
  }
  Case one(const std::string& text) const {
    return parse_case(block + friction + "model: slide\n" + text, folder_ / "c.yaml");
  }
  freestand::test::Scratch folder_{"cross_records"};
};

const std::string pairs = "{records: \"along/*\", cross_records: \"across/*\"}";

TEST_F(CrossRecords, ArePairedInTheOrderOfNames) {
  const MotionSet set = load_motions(study(pairs));
  ASSERT_EQ(set.size(), 2u);
  EXPECT_DOUBLE_EQ(set.motion(0).cross_mps2.at(0), 3);
  EXPECT_TRUE(std::isnan(set.motion(0).cross_over_horizontal));
  EXPECT_EQ(set.motion(1).cross_over_horizontal, 0);  // zero throughout: it shakes along a line
  // Intensities are those of the first component.
  EXPECT_NEAR((*set.entries)[0].peak_mps2, 4, 1e-3);
}

TEST_F(CrossRecords, ATableNamesThem) {
  std::ofstream(folder_ / "table.csv") << "file,cross\nalong/a.csv,across/a.csv\nalong/b.csv,\n";
  const MotionSet set = load_motions(study("{records: table.csv}"));
  EXPECT_FALSE(set.motion(0).cross_mps2.empty());
  EXPECT_TRUE(set.motion(1).cross_mps2.empty());
  const Table told = motion_rows(set, summarize(set, {1.0})).table;
  ASSERT_EQ(told.columns.back().name, "cross");
  EXPECT_EQ(told.at(0, told.columns.size() - 1), 1);
  EXPECT_EQ(told.at(1, told.columns.size() - 1), 0);
  const MotionSet lines = load_motions(study("{records: \"along/*\"}"));
  EXPECT_NE(motion_rows(lines, summarize(lines, {1.0})).table.columns.back().name, "cross");
  std::ofstream(folder_ / "table.csv") << "file,cross\nalong/a.csv,across/none.csv\n";
  EXPECT_THAT(text_of([&] { study("{records: table.csv}"); }), HasSubstr("across/none.csv is not there"));
  std::ofstream(folder_ / "table.csv") << "file\nalong/a.csv\n";
  EXPECT_THAT(text_of([&] { study("{records: table.csv, cross_records: \"across/*\"}"); }),
              HasSubstr("give the table a column cross"));
}

// A vertical component would shake the floor sideways there, too.
TEST_F(CrossRecords, AreNoVerticalOnes) {
  for (const char* name : {"along/c-NS.txt", "across/c-UP.txt"})
    std::ofstream(folder_ / name) << "0 0\n0.1 1\n0.2 -1\n";
  const std::string why = "c-UP.txt (its name ends in UP) is a vertical component";
  EXPECT_THAT(text_of([&] { study("{records: \"along/*.txt\", cross_records: \"across/*.txt\", unit: g}"); }),
              HasSubstr(why));
  EXPECT_THAT(text_of([&] { one("motion: {file: along/c-NS.txt, cross_file: across/c-UP.txt, unit: g}\n"); }),
              HasSubstr(why));
  std::ofstream(folder_ / "table.csv") << "file,cross,unit\nalong/c-NS.txt,across/c-UP.txt,g\n";
  EXPECT_THAT(text_of([&] { study("{records: table.csv}"); }), HasSubstr("cross is c-UP.txt (its name ends in UP)"));
}

// An empty cell says nothing of the component: its file does.
TEST_F(CrossRecords, AnEmptyComponentOfATableIsLookedUp) {
  std::ofstream(folder_ / "c-UP.txt") << "0 0\n0.1 1\n0.2 -1\n";
  std::ofstream(folder_ / "table.csv") << "file,component,unit\nalong/a.csv,NS,\nc-UP.txt,,g\n";
  const MotionSource source = study("{records: table.csv}").motions.at(0);
  EXPECT_EQ(source.files.size(), 1u);
  ASSERT_EQ(source.left_out.size(), 1u);
  EXPECT_THAT(source.left_out[0], HasSubstr("its name ends in UP"));
}

TEST_F(CrossRecords, TheExpandedStudyIsTheSame) {
  const Study first = study(pairs);
  EXPECT_THAT(expanded(first), HasSubstr("cross_records: across/*"));
  const Study again = parse_study(expanded(first), folder_ / "s.yaml", known());
  EXPECT_EQ(expanded(again), expanded(first));
  EXPECT_EQ(load_motions(again).fingerprint(), load_motions(first).fingerprint());
  // What is across counts.
  EXPECT_NE(load_motions(study("{records: \"along/*\"}")).fingerprint(), load_motions(first).fingerprint());
}

// A stored study is read without the tables of records that it names, which alone say that they hold pairs.
TEST_F(CrossRecords, AStoredStudyWithATableOfPairsIsRead) {
  std::ofstream(folder_ / "table.csv") << "file,cross\nalong/a.csv,across/a.csv\n";
  const Study first =
      parse_study(block + "friction: {mu_k: 0.2, ratio_across: 0.7}\n" + samples +
                      "fragility: {edp: [peak_slip_m], capacities: {peak_slip_m: [0.1]}}\nmodel: slide\nmotions: "
                      "[{records: table.csv}]\n",
                  folder_ / "s.yaml", known());
  const std::string stored = expanded(first);
  std::filesystem::remove(folder_ / "table.csv");
  EXPECT_EQ(text_of([&] { parse_stored(stored, folder_ / "s.yaml"); }), "");
}

TEST_F(CrossRecords, TheDemandIsTheSizeOfTheVector) {
  const Study swept = study("{records: along/a.csv, cross_records: across/a.csv, scale: {uniform: [-2, 2]}}");
  const Evaluator evaluate(swept, load_motions(swept));
  const Realiser realise(swept, load_motions(swept));
  for (std::uint64_t sample = 0; sample < 20; ++sample) {
    std::vector<double> alone, row;
    evaluate.append_alone(sample, alone);
    evaluate.append(sample, row);
    ASSERT_EQ(alone.size(), row.size());
    EXPECT_EQ(std::memcmp(alone.data(), row.data(), row.size() * sizeof(double)), 0);  // to the bit, nan too
    const Realisation drawn = realise(sample);
    History history;
    const Response r = respond(drawn.specimen, drawn.shaking, integration_settings(swept), &history);
    const auto value = [&](const std::string& column) { return row.at(column_index(evaluate.columns(), column)); };
    double most = 0;
    for (const HistoryPoint& p : history.points) most = std::max(most, std::hypot(p.slip_m, p.cross_slip_m));
    EXPECT_NEAR(value("edp_peak_slip_m"), most, 1e-3 * most);
    EXPECT_GE(value("edp_peak_slip_m"), most * (1 - 1e-9));
    EXPECT_EQ(value("edp_residual_slip_m"), std::hypot(r.residual_slip_m, r.residual_cross_slip_m));
    EXPECT_GE(value("edp_slid_path_m"), value("edp_peak_slip_m") * (1 - 1e-9));
  }
}

TEST_F(CrossRecords, PairsThatAreNoneAreRefusedByBothNames) {
  const auto told = [&] {
    return text_of([&] { load_motions(study("{records: along/a.csv, cross_records: across/a.csv}")); });
  };
  EXPECT_EQ(told(), "");
  write("across/a.csv", 150, [](double t) { return t; });
  EXPECT_THAT(told(),
              testing::AllOf(HasSubstr("along/a.csv"), HasSubstr("across/a.csv"), HasSubstr("200 and 150 samples")));
  write(
      "across/a.csv", 200, [](double t) { return t; }, 0.02);
  EXPECT_THAT(told(), testing::AllOf(HasSubstr("across/a.csv"), HasSubstr("their steps are 0.01 s and 0.02 s")));
  EXPECT_THAT(text_of([&] { study("{records: \"along/*\", cross_records: across/a.csv}"); }),
              HasSubstr("cross_records matches 1 files but records matches 2"));
}

// Two files of an agency say when they begin.
TEST_F(CrossRecords, PairsThatDoNotBeginTogetherAreRefused) {
  const auto knet = [&](const std::string& name, const std::string& start) {
    std::ofstream file(folder_ / name);
    file << "Origin Time       2003/05/26 18:24:00\nLat.              38.805\nLong.             141.682\n"
            "Depth. (km)       71\nMag.              7.0\nStation Code      IWT007\nStation Lat.      39.2700\n"
            "Station Long.     141.8567\nStation Height(m) 42\nRecord Time       "
         << start
         << "\nSampling Freq(Hz) 100Hz\nDuration Time(s)  0.08\nDir.              N-S\nScale Factor      "
            "3920(gal)/6182761\nMax. Acc. (gal)   1.0\nLast Correction   2003/05/26 18:24:15\nMemo.\n"
            "     1000    -1000     2000    -2000     3000    -3000     1000    "
         << (name.ends_with("EW") ? "-2000\n" : "-1000\n");
  };
  knet("along/k.NS", "2003/05/26 18:24:15");
  const std::string motion = "{records: along/k.NS, cross_records: across/k.EW}";
  knet("across/k.EW", "2003/05/26 18:24:15");
  EXPECT_NO_THROW(load_motions(study(motion)));
  knet("across/k.EW", "2003/05/26 18:24:17");
  EXPECT_THAT(text_of([&] { load_motions(study(motion)); }),
              testing::AllOf(HasSubstr("k.NS"), HasSubstr("k.EW"),
                             HasSubstr("they begin at 2003/05/26 18:24:15 and at 2003/05/26 18:24:17")));
}

TEST_F(CrossRecords, WhatDoesNotGoWithThemIsRefusedWithTheReason) {
  const auto told = [&](const std::string& more) { return text_of([&] { study(pairs, more); }); };
  EXPECT_EQ(told("model: slide\neffects: [{name: static_friction, ratio: 1.2}]\n"), "");
  EXPECT_THAT(told("model: slide_rock\n"), HasSubstr("model does not go with a second horizontal channel"));
  EXPECT_THAT(told(""), HasSubstr("set model: slide"));
  for (const char* effect : {"name: floor_tilt, angle_rad: 0.01", "name: rate_weakening, drop: 0.3, speed_mps: 0.1",
                             "name: centering_spring, frequency_hz: 1"})
    EXPECT_THAT(told(std::string("model: slide\neffects: [{") + effect + "}]\n"),
                HasSubstr("is along one line, and not known in the plane"))
        << effect;
  EXPECT_THAT(told("model: slide\nslip_by_side: true\n"), HasSubstr("slip_by_side does not go with"));
  EXPECT_THAT(told("model: slide\nchain: {slack_m: 0.01, stiffness_npm: 4e5, strength_n: 2736}\n"),
              HasSubstr("chain does not go with"));
}

TEST_F(CrossRecords, ACaseHasItsHistoryInBothDirections) {
  const Case both = one("motion: {file: along/a.csv, cross_file: across/a.csv}\n");
  const Simulation result = simulate(both, false);
  EXPECT_TRUE(result.history.cross);
  const HistoryPoint& last = result.history.points.back();
  // The motion ends while the block slides: it goes on for some milliseconds.
  EXPECT_NEAR(last.cross_slip_m, result.response.residual_cross_slip_m, 1e-3);
  EXPECT_NE(last.cross_slip_m, 0);
  EXPECT_NEAR(result.response.peak_slip_m, result.tighter.peak_slip_m, 1e-7 * result.response.peak_slip_m);
  EXPECT_THAT(expanded(both, folder_.folder()), HasSubstr("cross_file: across/a.csv"));
  EXPECT_THAT(text_of([&] { simulate(both, true); }), HasSubstr("--reference integrates along one line"));
  EXPECT_FALSE(simulate(one("motion: {file: along/a.csv}\n"), false).history.cross);
}

}  // namespace
}  // namespace freestand::study::cross_records_test
