// Pairs of horizontal components, turned into one direction.
#include <cmath>
#include <numbers>

#include "motion/record_pairs.hpp"
#include "record_fixture.hpp"
#include "support/data.hpp"
#include "support/error_text.hpp"

namespace freestand::motion::rotate_test {
namespace {

std::string at2(const std::string& values, const std::string& header = "NPTS=    3, DT= .01000 SEC\n") {
  return at2_head + header + values;
}
const std::string one = "  .1300000E+00 -.7000000E+00  .2900000E+00\n",
                  other = " -.5100000E+00  .1700000E+00  .0300000E+00\n";

class Rotation : public Record {
 protected:
  void SetUp() override {
    a_ = write("a.AT2", at2(one));
    b_ = write("b.AT2", at2(other));
  }
  std::vector<double> turned(double angle) const {
    return samples(read_record(a_, {.cross_file = b_.string(), .rotate_deg = angle}));
  }
  std::filesystem::path a_, b_;
};

TEST_F(Rotation, AtRightAnglesIsTheComponentsThemselvesToTheBit) {
  const std::vector<double> a = samples(read_record(a_)), b = samples(read_record(b_));
  const auto negative = [](std::vector<double> x) {
    for (double& value : x) value = -value;
    return x;
  };
  EXPECT_EQ(turned(0), a);
  EXPECT_EQ(turned(90), b);
  EXPECT_EQ(turned(180), negative(a));
  EXPECT_EQ(turned(270), negative(b));
  EXPECT_EQ(turned(-90), negative(b));
  EXPECT_EQ(turned(360), a);
  EXPECT_EQ(turned(450), b);
}

TEST_F(Rotation, KeepsTheSumOfSquares) {
  const std::vector<double> a = samples(read_record(a_)), b = samples(read_record(b_));
  for (const double angle : {17.0, 38.0, 123.4, -60.0}) {
    const std::vector<double> x = turned(angle), y = turned(angle + 90);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(x[i] * x[i] + y[i] * y[i], a[i] * a[i] + b[i] * b[i], 1e-13);
  }
}

TEST_F(Rotation, ByThirtyDegreesIsByTheirSineAndCosine) {
  const std::vector<double> a = samples(read_record(a_)), b = samples(read_record(b_)), x = turned(30);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(x[i], std::sqrt(3) / 2 * a[i] + b[i] / 2, 1e-13);
}

// A floor csv holds one horizontal channel; a file that holds two is its own partner.
TEST_F(Rotation, OfAFileWithItselfIsByItsOtherHorizontalChannel) {
  const std::string channels = csmip_channel(1, "H1", "  1.000000  2.000000  3.000000\n") +
                               csmip_channel(2, "UP", "  7.000000  8.000000  9.000000\n") +
                               csmip_channel(3, "H2", "  4.000000 -5.000000  6.000000\n");
  const auto file = write("x.V2", channels);
  const auto turned = [&](const std::string& channel) {
    return samples(read_record(file, {.channel = channel, .cross_file = file.string(), .rotate_deg = 90}));
  };
  EXPECT_EQ(turned(""), samples(read_record(file, {.channel = "H2"})));
  EXPECT_EQ(turned("3"), samples(read_record(file, {.channel = "H1"})));
  const auto refusal = [&](const std::filesystem::path& a, const std::filesystem::path& b) {
    return freestand::test::error_text(Exit::data,
                                       [&] { read_record(a, {.cross_file = b.string(), .rotate_deg = 45}); });
  };
  EXPECT_THAT(refusal(a_, a_), testing::HasSubstr("named as both components of a pair"));
  EXPECT_THAT(refusal(a_, write("copy.AT2", at2(one))), testing::HasSubstr("they hold the same motion"));
}

TEST_F(Rotation, OfWhatDoesNotBeginTogetherIsRefusedWithBothNames) {
  const auto refusal = [&](const std::filesystem::path& cross) {
    const auto [text, exit] = problem(a_, {.cross_file = cross.string(), .rotate_deg = 30});
    EXPECT_EQ(exit, Exit::data);
    EXPECT_THAT(text, AllOf(HasSubstr(a_.string()), HasSubstr(cross.string())));
    return text;
  };
  EXPECT_THAT(refusal(write("long.AT2", at2("  .1 .2 .3 .4\n", "NPTS=    4, DT= .01000 SEC\n"))),
              HasSubstr("3 and 4 samples, and nothing tells whether they begin together"));
  const FloorMotion told =
      read_record(a_, {.cross_file = (folder_ / "long.AT2").string(), .rotate_deg = 90, .begin_together = true});
  EXPECT_THAT(samples(told), testing::Pointwise(testing::DoubleNear(1e-14), {.1 * g, .2 * g, .3 * g, .4 * g}));
  EXPECT_THAT(refusal(write("slow.AT2", at2(other, "NPTS=    3, DT= .02000 SEC\n"))),
              HasSubstr("their steps are 0.01 s and 0.02 s"));
  EXPECT_THAT(problem(a_, {.cross_file = (folder_ / "none.AT2").string()}).first, HasSubstr("none.AT2"));
}

std::string esm(const std::string& start, int count, const std::string& values) {
  return "EVENT_NAME: X\nDATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS: " + start +
         "\nSAMPLING_INTERVAL_S: 0.005\nNDATA: " + std::to_string(count) +
         "\nSTREAM: HNE\nUNITS: cm/s^2\nDATA_TYPE: ACCELERATION\n" + values;
}

TEST_F(Rotation, GoesByTheTimesThatFilesState) {
  const auto early = write("e.ASC", esm("20190728_160919.870", 3, "10\n20\n30\n"));
  const auto longer = write("n.ASC", esm("20190728_160919.870", 4, "1\n2\n3\n4\n"));
  const auto late = write("l.ASC", esm("20190728_160920.000", 3, "1\n2\n3\n"));
  const FloorMotion turned = read_record(early, {.cross_file = longer.string(), .rotate_deg = 90});
  EXPECT_THAT(samples(turned), testing::Pointwise(testing::DoubleNear(1e-15), {.01, .02, .03, .04}));  // ends at rest
  const auto refusal = problem(early, {.cross_file = late.string(), .rotate_deg = 90}).first;
  EXPECT_THAT(refusal, AllOf(HasSubstr("20190728_160919.870"), HasSubstr("20190728_160920.000")));
  EXPECT_THAT(problem(early, {.cross_file = a_.string(), .rotate_deg = 90}).first, HasSubstr("no pair of components"));
}

TEST_F(Rotation, VerticalRecordsBeginWithTheirHorizontalOnes) {
  const std::string start = "20190728_160919.870";
  const auto along = write("h.ASC", esm(start, 3, "10\n20\n30\n"));
  const auto up = write("z.ASC", esm(start, 3, "1\n2\n3\n"));
  const auto late = write("zl.ASC", esm("20190728_160925.870", 3, "1\n2\n3\n"));
  EXPECT_FALSE(read_record(along, {.vertical_file = up.string()}).vertical_mps2.empty());
  const auto [text, exit] = problem(along, {.vertical_file = late.string()});
  EXPECT_EQ(exit, Exit::data);
  EXPECT_THAT(text, AllOf(HasSubstr("no pair of components"), HasSubstr("20190728_160925.870")));
}

// A clock of a table tells when it begins, unless it begins with the record itself.
TEST_F(Rotation, GoesByTheClocksOfTables) {
  const auto table = [&](const std::string& name, const std::string& times) {
    std::string text = "time_s,floor_acceleration_mps2\n";
    for (const char* value : {"1", "2", "3"}) text += times + value + "," + value + (name == "late.csv" ? ".5\n" : "\n");
    return write(name, text);
  };
  const auto zero = table("zero.csv", "0.0"), late = table("late.csv", "35.0"), too = table("too.csv", "35.0");
  EXPECT_THAT(problem(zero, {.cross_file = late.string(), .rotate_deg = 30}).first,
              AllOf(HasSubstr("no pair of components"), HasSubstr("35.01 s")));
  EXPECT_THAT(problem(zero, {.vertical_file = late.string()}).first, HasSubstr("35.01 s"));
  EXPECT_NO_THROW(read_record(late, {.cross_file = too.string(), .rotate_deg = 30}));
  EXPECT_NO_THROW(read_record(zero, {.cross_file = late.string(), .rotate_deg = 30, .begin_together = true}));
  const auto pair = [&](const std::string& name, const std::string& from) {
    return write(name, from + " 1\n" + from + "1 2\n" + from + "2 3\n");
  };
  const auto plain = pair("plain.txt", "0.0"), plain_late = pair("plain_late.txt", "6.0");
  EXPECT_THAT(problem(plain, {.unit = "g", .cross_file = plain_late.string(), .rotate_deg = 30}).first,
              HasSubstr("6 s"));
}

class Pairs : public Rotation {
 protected:
  RecordTable paired(const std::string& rows,
                     const std::string& header = "file,event,station,azimuth_deg,pga_g,rjb_km\n") {
    RecordTable table = read_record_table(write("INDEX.csv", header + rows));
    pair_components(table);
    return table;
  }
  std::string refusal(const std::string& rows,
                      const std::string& header = "file,event,station,azimuth_deg,pga_g,rjb_km\n") {
    return freestand::test::error_text(Exit::usage, [&] { paired(rows, header); });
  }
};

TEST_F(Pairs, ComeFromTheRowsOfAStation) {
  const RecordTable table = paired("a.AT2,E,S,30,0.7,5\nb.AT2,E,S,300,0.5,5\n");
  ASSERT_EQ(table.rows.size(), 1u);
  const RecordRow& pair = table.rows.front();
  EXPECT_EQ(pair.cross.filename(), "b.AT2");
  EXPECT_EQ(pair.cross_side, -1);  // 300 is 90 degrees counterclockwise of 30
  EXPECT_EQ(angle_to_azimuth_deg(pair, 30), 0);
  EXPECT_EQ(angle_to_azimuth_deg(pair, 300 - 360), 90);
  EXPECT_TRUE(std::isnan(pair.numbers[0]));  // a peak of one component
  EXPECT_EQ(pair.numbers[1], 5);             // a distance of both
}

// Turned out of the same two, in whatever order they stand: durations and periods are those of one component too.
TEST_F(Pairs, KeepWhatBothRowsGiveAlike) {
  const std::string header = "file,event,station,azimuth_deg,significant_5_75_s,identified_pulse_period_s,rjb_km\n";
  for (const char* rows :
       {"a.AT2,E,S,30,0.9,0.97,5\nb.AT2,E,S,300,1.0,0.38,5\n", "b.AT2,E,S,300,1.0,0.38,5\na.AT2,E,S,30,0.9,0.97,5\n"}) {
    const RecordTable table = paired(rows, header);
    EXPECT_TRUE(std::isnan(table.rows[0].numbers[0]) && std::isnan(table.rows[0].numbers[1]));
    EXPECT_EQ(table.rows[0].numbers[2], 5);
  }
}

TEST_F(Pairs, TakeAzimuthsFromNumericComponentsNorthAndEast) {
  const std::string header = "file,event,station,component\n";
  EXPECT_EQ(paired("a.AT2,E,S,NS\nb.AT2,E,S,EW\n", header).rows.front().cross_side, 1);
  EXPECT_EQ(paired("a.AT2,E,S,128\nb.AT2,E,S,038\n", header).rows.front().cross_side, -1);
  EXPECT_THAT(refusal("a.AT2,E,S,H1\nb.AT2,E,S,H2\n", header), HasSubstr("give azimuth_deg"));
}

TEST_F(Pairs, ThatAreNoneAreRefusedWithTheirRows) {
  EXPECT_THAT(refusal("a.AT2,E,S,30,0.7,5\n"), AllOf(HasSubstr("INDEX.csv:2: a.AT2"), HasSubstr("1 horizontal")));
  EXPECT_THAT(refusal("a.AT2,E,S,30,0.7,5\nb.AT2,E,S,60,0.7,5\n"),
              HasSubstr("30 and 60 degrees, not at a right angle"));
  EXPECT_THAT(refusal("a.AT2,30\nb.AT2,120\n", "file,azimuth_deg\n"), HasSubstr("no column station"));
  EXPECT_THAT(refusal("a.AT2,E,S,0,g\nb.AT2,E,S,90,m/s2\n", "file,event,station,azimuth_deg,unit\n"),
              HasSubstr("differ in dt_s, unit"));
  EXPECT_THAT(refusal("a.AT2,E,S,0,9\nb.AT2,E,S,90,1\n", "file,event,station,azimuth_deg,weight\n"),
              HasSubstr("differ in weight"));
}

// The two of Corralitos begin together (NGA-West2); the files of Los Gatos were cut each for itself.
TEST(RealPairs, OfCorralitosAreTurnedAndThoseOfLosGatosRefused) {
  FREESTAND_NEEDS_RECORDS();
  const auto folder = test::records_dir() / "peer_ngawest2_corralitos";
  const auto first = folder / "RSN753_LOMAP_CLS000.AT2", second = folder / "RSN753_LOMAP_CLS090.AT2";
  const auto turned = [&](double azimuth) {  // the second file goes on for four samples more
    return samples(read_record(first, {.cross_file = second.string(), .rotate_deg = azimuth, .begin_together = true}));
  };
  const std::vector<double> normal = turned(38), parallel = turned(128);  // strike 128
  double of_turned = 0, of_both = 0;
  for (std::size_t i = 0; i < normal.size(); ++i) of_turned += normal[i] * normal[i] + parallel[i] * parallel[i];
  for (const auto& file : {first, second})
    for (const double value : samples(read_record(file))) of_both += value * value;
  EXPECT_NEAR(of_turned, of_both, 1e-10 * of_both);
  const auto cut = test::records_dir() / "slammer" / "Loma_Prieta_1989";
  EXPECT_THAT(freestand::test::error_text(
                  Exit::data,
                  [&] {
                    read_record(
                        cut / "LGP-000",
                        {.dt_s = 0.005, .unit = "g", .cross_file = (cut / "LGP-090").string(), .rotate_deg = 38});
                  }),
              AllOf(HasSubstr("LGP-000"), HasSubstr("LGP-090"), HasSubstr("begin together")));
}

}  // namespace
}  // namespace freestand::motion::rotate_test
