#include "motion/record.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <freestand/error.hpp>
#include <random>

#include "base/units.hpp"
#include "motion/peaks.hpp"
#include "motion/record_format.hpp"
#include "motion/temporary_folder.hpp"
#include "support/data.hpp"

namespace freestand::motion {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr double g = standard_gravity_mps2;

// Samples of a piecewise linear motion: the starts of its segments and the end of the last.
std::vector<double> samples(const FloorMotion& motion, Channel channel = Channel::horizontal) {
  const std::vector<double>& c = channel == Channel::horizontal ? motion.horizontal_mps2 : motion.vertical_mps2;
  std::vector<double> values;
  for (std::size_t i = 0; i < c.size(); i += 2) values.push_back(c[i]);
  if (!c.empty()) values.push_back(c[c.size() - 2] + c.back() * (motion.knot_s.back() - motion.knot_s.end()[-2]));
  return values;
}

std::vector<double> in_mps2(std::vector<double> values, double unit) {
  for (double& value : values) value *= unit;
  return values;
}

void expect_samples(const FloorMotion& motion, double dt, std::vector<double> values, double unit) {
  EXPECT_NEAR(motion.knot_s[1], dt, 1e-15);
  EXPECT_THAT(samples(motion), testing::Pointwise(testing::DoubleNear(1e-12), in_mps2(std::move(values), unit)));
}

class Record : public TemporaryFolder {
 protected:
  // The message of the Error that reading throws, and its exit code.
  std::pair<std::string, Exit> problem(const std::filesystem::path& path, const ReadOptions& options = {}) const {
    try {
      read_record(path, options);
    } catch (const Error& error) {
      return {error.what(), error.exit()};
    }
    return {"(no error)", Exit::done};
  }
  void expect_data_error(const std::filesystem::path& path, int line, const std::string& text,
                         const ReadOptions& options = {}) const {
    const auto [message, exit] = problem(path, options);
    const std::string place = line > 0 ? path.string() + ":" + std::to_string(line) + ": " : path.string();
    EXPECT_THAT(message, AllOf(HasSubstr(place), HasSubstr(text)));
    EXPECT_EQ(exit, Exit::data) << message;
  }
  void expect_usage_error(const std::filesystem::path& path, const std::string& text,
                          const ReadOptions& options = {}) const {
    const auto [message, exit] = problem(path, options);
    EXPECT_THAT(message, HasSubstr(text));
    EXPECT_EQ(exit, Exit::usage) << message;
  }
};

const std::string at2_head =
    "PEER NGA STRONG MOTION DATABASE RECORD\n"
    "Somewhere, 1/1/2000, Station, 90\n"
    "ACCELERATION TIME SERIES IN UNITS OF G\n";
const std::vector<double> seven = {0.1394908e-2, -0.5, 0.25, -0.125, 1.5, -.4229e-5, 0.75};
const std::string seven_text =
    "   .1394908E-02  -.5000000E+00   .2500000E+00  -.1250000E+00   .1500000E+01\n"
    "  -.4229000E-05   .7500000E+00\n";

// ---- PEER .AT2 ----

TEST_F(Record, At2ReadsEveryVariantOfItsHeader) {
  const char* headers[] = {"NPTS=   7, DT=   .0050 SEC,                                             \n",
                           "NPTS=   7, DT=   .0050 SEC                                              \n",
                           "NPTS=   7, DT=   .0050 SEC,   0 POLE @    30.00000 HZ,  -5 POLE @      .05000\n",
                           "NPTS=  7, DT= .00500 SEC\n",
                           "NPTS=7,DT=5.0E-03\n",
                           "npts =     7 , dt =   0.005 sec\n",
                           "    7    0.0050    NPTS, DT\n"};
  for (const char* header : headers) {
    SCOPED_TRACE(header);
    expect_samples(read_record(write("x.AT2", at2_head + header + seven_text)), 0.005, seven, g);
  }
}

TEST_F(Record, At2ReadsOldHeadersEightColumnsAndAMissingLastLineEnd) {
  const std::string text =
      "Data for El Centro 1940 North South Component (Peknold Version)\n"
      "9 points at equal spacing of 0.02 sec Points are listed in the format of 8F10.5\n"
      "The units are (g)\n"
      "NPTS=  9, DT= .02000 SEC\n"
      "   0.00630   0.00364   0.00099   0.00428   0.00758   0.01087   0.00682   0.00277\n"
      "  -0.00128";
  expect_samples(read_record(write("elCentro.AT2", text)), 0.02,
                 {0.0063, 0.00364, 0.00099, 0.00428, 0.00758, 0.01087, 0.00682, 0.00277, -0.00128}, g);
}

TEST_F(Record, At2ReadsDosAndOldMacLineEnds) {
  const std::string text = at2_head + "NPTS= 7, DT= .0050 SEC\n" + seven_text + "   \n\n";
  for (const char* line_end : {"\r\n", "\r"}) {
    std::string other;
    for (const char c : text) other += c == '\n' ? line_end : std::string(1, c);
    expect_samples(read_record(write("x.AT2", other)), 0.005, seven, g);
  }
  expect_samples(read_record(write("x.AT2", text + "\x1a")), 0.005, seven, g);
}

TEST_F(Record, At2ReadsNumbersThatRunTogether) {
  const std::string text = at2_head + "NPTS= 6, DT= .01 SEC\n-.1234E-02-.2345E-03-0.5-.25+.125-1.D-01\n";
  expect_samples(read_record(write("x.AT2", text)), 0.01, {-.1234e-2, -.2345e-3, -0.5, -0.25, 0.125, -0.1}, g);
}

TEST_F(Record, At2ReadsOtherUnitsWhereTheHeaderNamesThem) {
  const std::string text = "a\nb\nACCELERATION TIME SERIES IN UNITS OF CM/S2\nNPTS= 2, DT= .01 SEC\n 100. -50\n";
  expect_samples(read_record(write("x.AT2", text)), 0.01, {1, -0.5}, 1);
}

TEST_F(Record, At2WithAWrongCountIsRefused) {
  const std::string head = at2_head + "NPTS= 9, DT= .0050 SEC\n";
  expect_data_error(write("few.AT2", head + seven_text), 6, "the record ends after 7 values (the header says 9)");
  const std::string short_head = at2_head + "NPTS= 5, DT= .0050 SEC\n";
  expect_data_error(write("many.AT2", short_head + seven_text), 6, "more values here (the header says 5 in all)");
  const std::string four = at2_head + "NPTS= 4, DT= .0050 SEC\n";
  expect_data_error(write("midline.AT2", four + seven_text), 5, "more values here (the header says 4 in all)");
}

TEST_F(Record, At2WithABadNumberNamesFileLineAndNumber) {
  const std::string head = at2_head + "NPTS= 4, DT= .0050 SEC\n .1 .2\n";
  expect_data_error(write("a.AT2", head + " 0.1x3 .2\n"), 6, "cannot read the number \"0.1x3\" (it is not a number)");
  expect_data_error(write("b.AT2", head + " .1 NaN\n"), 6, "\"NaN\" (it is not finite)");
  expect_data_error(write("c.AT2", head + " .1 -inf\n"), 6, "\"-inf\" (it is not finite)");
  expect_data_error(write("d.AT2", head + " .1 1e999\n"), 6, "\"1e999\" (beyond the range of numbers)");
  expect_data_error(write("e.AT2", head + " .1 *****\n"), 6, "\"*****\"");
  expect_data_error(write("f.AT2", head + " .1 1.2.3\n"), 6, "\"1.2.3\"");
  expect_data_error(write("g.AT2", head + " .1 --1\n"), 6, "\"--1\"");
  expect_data_error(write("h.AT2", head + " .1 +-1\n"), 6, "\"+-1\"");
  expect_data_error(write("i.AT2", head + " .1 1.5-\n"), 6, "\"-\"");
}

TEST_F(Record, At2WithABrokenHeaderIsRefused) {
  expect_data_error(write("a.AT2", at2_head + "NPTS= x7, DT= .005\n" + seven_text), 4, "cannot read the count \"x7\"");
  expect_data_error(write("b.AT2", at2_head + "NPTS= 7, DT= 0 SEC\n" + seven_text), 0, "time step 0 s is of no use");
  expect_data_error(write("c.AT2", at2_head + "NPTS= 7, DT= \n" + seven_text), 4, "NPTS= or DT= without a value");
  expect_data_error(write("d.AT2", at2_head + "NPTS= 7, DT= -.005 SEC\n" + seven_text), 0, "not a positive number");
  expect_data_error(write("e.AT2", at2_head + "NPTS, DT\n" + seven_text), 4, "no count and step");
  expect_data_error(write("f.AT2", "a\nb\nVELOCITY TIME SERIES IN UNITS OF CM/S\nNPTS= 7, DT= .01\n" + seven_text), 3,
                    "not a record of acceleration");
  expect_data_error(write("h.AT2", "a\nb\nIN UNITS OF FURLONGS\nNPTS= 7, DT= .01\n" + seven_text), 0,
                    "no unit of acceleration \"furlongs\"");
  expect_data_error(write("g.AT2", at2_head + "NPTS= 1, DT= .01\n .5\n"), 0, "fewer than two samples");
}

// ---- floor csv ----

TEST_F(Record, FloorCsvReadsBothChannels) {
  const FloorMotion motion = read_record(write(
      "floor.csv", "time_s,floor_acceleration_mps2,floor_vertical_acceleration_mps2\n0,1,10\n0.005,2,20\n0.01,3,30\n"));
  expect_samples(motion, 0.005, {1, 2, 3}, 1);
  EXPECT_THAT(samples(motion, Channel::vertical), testing::Pointwise(testing::DoubleNear(1e-12), {10, 20, 30}));
  EXPECT_TRUE(read_record(write("h.csv", "time_s,floor_acceleration_mps2\r\n0,1\r\n1,2\r\n")).vertical_mps2.empty());
}

TEST_F(Record, FloorCsvFindsItsColumnsByNameAmongOthers) {
  const FloorMotion motion = read_record(
      write("test.csv", "\xEF\xBB\xBF# a comment\nslip_m, time_s ,floor_acceleration_mps2\n9,2.0,-1.5\n9,2.1,2.5\n"));
  expect_samples(motion, 0.1, {-1.5, 2.5}, 1);
}

TEST_F(Record, FloorCsvWithAnUnevenStepIsRefusedWhereItIsUneven) {
  std::string text = "time_s,floor_acceleration_mps2\n";
  for (int i = 0; i < 100; ++i)
    if (i != 60) text += std::to_string(0.01 * i) + ",1\n";
  expect_data_error(write("gap.csv", text), 62, "the time step is not constant (0.02 s here, elsewhere 0.01 s)");
  expect_data_error(write("back.csv", "time_s,floor_acceleration_mps2\n0,1\n0.1,1\n0.05,1\n0.3,1\n"), 4,
                    "not constant");
  expect_data_error(write("same.csv", "time_s,floor_acceleration_mps2\n0,1\n0,1\n"), 3, "the times do not increase");
}

TEST_F(Record, FloorCsvTakesTimesRoundedInPrint) {
  std::string text = "time_s,floor_acceleration_mps2\n";
  char line[40];
  for (int i = 0; i < 200; ++i) {
    snprintf(line, sizeof line, "%.4f,%d\n", i / 120.0, i);
    text += line;
  }
  EXPECT_NEAR(read_record(write("floor.csv", text)).knot_s[1], 1 / 120.0, 1e-6);
}

TEST_F(Record, FloorCsvWithABadLineIsRefused) {
  const std::string head = "time_s,floor_acceleration_mps2\n0,1\n";
  expect_data_error(write("a.csv", head + "0.1,2,3\n"), 3, "3 columns (the header has 2)");
  expect_data_error(write("b.csv", head + "0.1,\n"), 3, "cannot read the number \"\"");
  expect_data_error(write("c.csv", head + "0.1,nan\n"), 3, "\"nan\" (it is not finite)");
  expect_data_error(write("d.csv", head), 0, "fewer than two samples");
  expect_data_error(write("e.csv", "time_s,acceleration\n0,1\n"), 1, "no column floor_acceleration_mps2");
  expect_usage_error(write("f.csv", head + "0.1,2\n"), "contradicts the file", {.dt_s = 0.2});
  expect_usage_error(write("g.csv", head + "0.1,2\n"), "contradicts the file (it says m/s2)", {.unit = "g"});
}

// ---- plain columns ----

TEST_F(Record, PlainColumnNeedsStepAndUnit) {
  const auto path = write("x.acc", "# comment\n-0.00000000\r\n0.5\r\n\r\n  2.5e-001 \r\n");
  expect_samples(read_record(path, {.dt_s = 0.005, .unit = "m/s2"}), 0.005, {0, 0.5, 0.25}, 1);
  expect_samples(read_record(path, {.dt_s = 0.02, .unit = "g"}), 0.02, {0, 0.5, 0.25}, g);
  expect_usage_error(path, "give dt_s", {.unit = "g"});
  expect_usage_error(path, "give unit", {.dt_s = 0.01});
  expect_usage_error(path, "no unit of acceleration \"furlong\"", {.dt_s = 0.01, .unit = "furlong"});
  expect_data_error(path, 0, "not a positive number", {.dt_s = -1, .unit = "g"});
}

TEST_F(Record, PlainTwoColumnsAreTimeAndAcceleration) {
  for (const char* text :
       {"0 1\n0.02 2\n0.04 3\n", "0.00,1\n0.02,2\n0.04,3\n", "0;1\n2.e-2;2\n.04;3\n", "5\t1\n5.02\t2\n5.04\t3"})
    expect_samples(read_record(write("x.txt", text), {.unit = "gal"}), 0.02, {1, 2, 3}, 0.01);
  expect_usage_error(write("x.txt", "0 1\n0.02 2\n"), "give unit");
  expect_usage_error(write("y.txt", "0 1\n0.02 2\n"), "contradicts the file", {.dt_s = 0.01, .unit = "g"});
  expect_data_error(write("z.txt", "0 1\n0.02 2\n0.04 3\n0.09 4\n"), 4, "not constant", {.unit = "g"});
}

TEST_F(Record, PlainColumnsOfOtherShapesAreRefused) {
  const ReadOptions options{.dt_s = 0.01, .unit = "g"};
  expect_data_error(write("a", "1\n2\n3 4\n"), 3, "2 columns (the first line has 1)", options);
  expect_data_error(write("b", "1 2 3\n"), 1, "3 columns without a header", options);
  expect_data_error(write("c", "1\n2\nx\n"), 3, "cannot read the number \"x\"", options);
}

TEST(Units, AreThoseThatRecordsUse) {
  EXPECT_EQ(acceleration_unit_mps2("g"), g);
  EXPECT_EQ(acceleration_unit_mps2("G"), g);
  EXPECT_EQ(acceleration_unit_mps2("m/s^2"), 1);
  EXPECT_EQ(acceleration_unit_mps2("cm/sec/sec"), 0.01);
  EXPECT_EQ(acceleration_unit_mps2("mm/s2"), 0.001);
  EXPECT_EQ(acceleration_unit_mps2("in/s2"), 0.0254);
  EXPECT_DOUBLE_EQ(acceleration_unit_mps2("ft/s2"), 0.3048);
}

// ---- files with several channels and other agencies ----

std::string csmip_channel(int number, const std::string& name, const std::string& values,
                          const std::string& dt = ".010") {
  return "Corrected accelerogram   58667-L2866-14236.52       Chan  " + std::to_string(number) + ":  " + name +
         "         from   \nChan  " + std::to_string(number) + ":  " + name +
         "   \nsome header\n    3 points of accel data equally spaced at  " + dt + " sec, in cm/sec2. (8f10.6)    \n" +
         values +
         "    3 points of veloc data equally spaced at  .010 sec, in cm/sec.  (8f10.7)\n 9.0000000 9.0000000 "
         "9.0000000\n/&  ----------  End of data\n";
}

TEST_F(Record, CsmipV2ReadsItsChannels) {
  // Columns of ten that run together, as they do where values are large.
  const auto path = write("x.V2", csmip_channel(1, "H1", "  -.001239100.123456200.000000\n") +
                                      csmip_channel(2, "H2", "  1.000000  2.000000  3.000000\n") +
                                      csmip_channel(3, "UP", "  7.000000  8.000000  9.000000\n"));
  const FloorMotion first = read_record(path);
  expect_samples(first, 0.01, {-.001239, 100.123456, 200}, 0.01);
  EXPECT_THAT(samples(first, Channel::vertical), testing::Pointwise(testing::DoubleNear(1e-12), {0.07, 0.08, 0.09}));
  expect_samples(read_record(path, {.channel = "h2"}), 0.01, {1, 2, 3}, 0.01);
  expect_samples(read_record(path, {.channel = "2"}), 0.01, {1, 2, 3}, 0.01);
  const FloorMotion up = read_record(path, {.channel = "UP"});
  expect_samples(up, 0.01, {7, 8, 9}, 0.01);
  EXPECT_TRUE(up.vertical_mps2.empty());
  expect_usage_error(path, "no channel \"H9\" (the channels are 1 H1, 2 H2, 3 UP)", {.channel = "H9"});
}

TEST_F(Record, CsmipV2WithAHoleOrAnotherStepIsRefused) {
  expect_data_error(write("hole.V2", csmip_channel(1, "H1", "  1.000000            3.000000\n")), 5, "column 11");
  expect_data_error(write("step.V2", csmip_channel(1, "H1", "  1.000000  2.000000  3.000000\n") +
                                         csmip_channel(2, "H2", "  1.000000  2.000000  3.000000\n", ".020")),
                    12, "another step or unit");
}

std::string cosmos_channel(const std::string& name, const std::string& units, const std::string& entry_62) {
  std::string reals;
  for (int i = 1; i <= 100; ++i) {
    char field[20];
    snprintf(field, sizeof field, "%15s", i == 34 ? "0.005000" : i == 62 ? entry_62.c_str() : "-999.000000");
    reals += field + std::string(i % 5 == 0 ? "\n" : "");
  }
  return "Corrected acceleration    (Format v01.20 with 13 text lines) Someone\nSta Chan   1: " + name +
         " (Rcrdr Chan  1) Location:\n 100 Real-header values follow on 20 lines , Format = (5F15.6)\n" + reals +
         "   1 Comment line(s) follow, each starting with a \"|\":\n| acceleration of something\n       3 acceleration "
         "pts, approx    0 secs, units=" +
         units + ",Format=(10F8.5)\n-0.00003 0.12345-0.54321\nEnd-of-data for Chan  1 acceleration\n";
}

TEST_F(Record, CosmosV2ReadsItsChannelsAndBothEntriesOfTheStep) {
  expect_samples(read_record(write("a.V2c", cosmos_channel("90 deg", "cm/s^2 (4)", "10.000000"))), 0.01,
                 {-0.00003, 0.12345, -0.54321}, 0.01);
  const auto both = write("b.V2c", cosmos_channel("Up", "cm/sec2(04)", "-999.000000") +
                                       cosmos_channel("90 deg", "cm/sec2(04)", "-999.000000"));
  const FloorMotion motion = read_record(both);
  expect_samples(motion, 0.005, {-0.00003, 0.12345, -0.54321}, 0.01);
  EXPECT_EQ(samples(motion), samples(motion, Channel::vertical));
  expect_data_error(write("c.V0c", cosmos_channel("90 deg", "counts (50)", "10.000000")), 26, "raw counts");
}

std::string esm(const std::string& units, int count, const std::string& type = "ACCELERATION") {
  return "EVENT_NAME: SOMEWHERE\nSAMPLING_INTERVAL_S: 0.005000\nNDATA: " + std::to_string(count) + "\nUNITS: " + units +
         "\nPGA_CM/S^2: 2\nDATA_TYPE: " + type + "\nUSER5:\n0.5\n-2.000000\n1.25\n";
}

TEST_F(Record, EsmReadsItsHeader) {
  expect_samples(read_record(write("x.ASC", esm("cm/s^2", 3))), 0.005, {0.5, -2, 1.25}, 0.01);
  expect_data_error(write("a.ASC", esm("cm/s^2", 4)), 10, "the record ends after 3 values");
  expect_data_error(write("b.ASC", esm("cm/s^2", 2)), 10, "more values here");
  expect_data_error(write("c.ASC", esm("cm/s", 3, "VELOCITY")), 6, "not a record of acceleration");
}

std::string knet(const std::string& scale, const std::string& seconds) {
  return "Origin Time       2014/12/31 23:49:00\nSampling Freq(Hz) 2Hz\nDuration Time(s)  " + seconds +
         "\nDir.              E-W\nScale Factor      " + scale +
         "\nMax. Acc. (gal)   6\nMemo.             \n   -10    -13 \n    -7    -10 \n";
}

TEST_F(Record, KnetTakesItsZeroOff) {
  expect_samples(read_record(write("x.EW", knet("4000(gal)/2000", "2"))), 0.5, {0, -6, 6, 0}, 0.01);
  expect_data_error(write("a.EW", knet("4000(gal)/2000", "3")), 9,
                    "the record ends after 4 values (the header says 6)");
  expect_data_error(write("b.EW", knet("4000/2000", "2")), 5, "cannot read the scale factor");
}

std::string smc(const std::string& count) {
  std::string text = "2 CORRECTED ACCELEROGRAM\n*\n";
  for (int i = 2; i < 11; ++i) text += "text\n";
  for (int i = 1; i <= 48; ++i) {
    char field[12];
    snprintf(field, sizeof field, "%10s", i == 16 ? "2" : i == 17 ? count.c_str() : "-32768");
    text += field + std::string(i % 8 == 0 ? "\r\n" : "");
  }
  for (int i = 1; i <= 50; ++i)
    text += (i == 2 ? "  0.2000000E+03" : "  0.1700000E+39") + std::string(i % 5 == 0 ? "\n" : "");
  return text + "|\n| comment with numbers 1 2 3\n 1.5057E+0-2.2223E+0-1.9234E+0\n-5.5295E+0\n";
}

TEST_F(Record, SmcReadsItsColumns) {
  expect_samples(read_record(write("x.smc", smc("4"))), 0.005, {1.5057, -2.2223, -1.9234, -5.5295}, 0.01);
  expect_data_error(write("a.smc", smc("5")), 31, "the record ends after 4 values (the header says 5)");
  expect_data_error(write("b.smc", smc("-32768")), 14, "where a count stands");
}

// ---- what holds for all formats ----

TEST_F(Record, VerticalFileIsPairedAndTheShorterEndsAtRest) {
  const std::string head = at2_head + "NPTS= ", tail = ", DT= .01 SEC\n";
  const auto horizontal = write("h.AT2", head + "2" + tail + "1 2\n"),
             vertical = write("v.AT2", head + "4" + tail + "3 4 5 6\n");
  const FloorMotion motion = read_record(horizontal, {.vertical_file = vertical.string()});
  expect_samples(motion, 0.01, {1, 2, 0, 0}, g);
  EXPECT_THAT(samples(motion, Channel::vertical),
              testing::Pointwise(testing::DoubleNear(1e-12), in_mps2({3, 4, 5, 6}, g)));
  const auto slow = write("s.AT2", head + "2, DT= .02 SEC\n1 2\n");
  const auto [message, exit] = problem(horizontal, {.vertical_file = slow.string()});
  EXPECT_THAT(message, HasSubstr("s.AT2: another time step (0.02 s) than the horizontal record (0.01 s)"));
  EXPECT_EQ(exit, Exit::data);
}

TEST_F(Record, UnreadableFilesAreDataErrors) {
  expect_data_error(folder_ / "missing.AT2", 0, "No such file or directory");
  expect_data_error(folder_, 0, "it is a folder");
  expect_data_error(write("empty", ""), 0, "it is empty");
  expect_data_error(write("blank", " \n\r\n \n"), 0, "it is empty");
  expect_data_error(
      write("prose", "This is no record.\n1 2 3\n"), 1,
      "no known record format (the formats are at2, cosmos_v2, csmip_v2, esm, floor_csv, knet, plain, smc)");
  expect_data_error(write("binary", std::string("\x7f"
                                                "ELF\0\0\1\2",
                                                8)),
                    1, "no known record format");
}

TEST_F(Record, FormatCanBeNamed) {
  const auto path = write("x", "1\n2\n");
  expect_samples(read_record(path, {.dt_s = 1, .unit = "g", .format = "plain"}), 1, {1, 2}, g);
  expect_usage_error(path, "no record format \"peer\"", {.dt_s = 1, .unit = "g", .format = "peer"});
}

TEST_F(Record, NegatedFileIsTheMirroredMotionToTheBit) {
  const std::string head = at2_head + "NPTS= 3, DT= .005 SEC\n";
  const FloorMotion one = read_record(write("a.AT2", head + " .1234567E-02  .3333333E+00 -.7777777E-01\n"));
  const FloorMotion other = read_record(write("b.AT2", head + "-.1234567E-02 -.3333333E+00  .7777777E-01\n"));
  for (std::size_t i = 0; i < one.horizontal_mps2.size(); ++i)
    EXPECT_EQ(one.horizontal_mps2[i], -other.horizontal_mps2[i]);
}

TEST(Formats, EveryFileIsInTheRegistry) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_dir() / "src" / "motion"))
    files += entry.path().extension() == ".cpp" && entry.path().filename().string().rfind("format_", 0) == 0;
  EXPECT_EQ(registry<RecordFormat>().size(), files);
  EXPECT_EQ(record_formats().size(), files);
}

// Whatever stands in a file, it is read or refused with an Error, and what is read is finite.
TEST_F(Record, DamagedFilesAreReadOrRefusedButNothingElse) {
  const std::string originals[] = {
      at2_head + "NPTS= 7, DT= .0050 SEC\n" + seven_text,
      "time_s,floor_acceleration_mps2,floor_vertical_acceleration_mps2\n0,1,10\n0.005,2,20\n0.01,3,30\n",
      "0 1\n0.02 2\n0.04 3\n",
      csmip_channel(1, "H1", "  1.000000  2.000000  3.000000\n"),
      cosmos_channel("90 deg", "cm/s^2 (4)", "10.000000"),
      esm("cm/s^2", 3),
      knet("4000(gal)/2000", "2"),
      smc("4")};
  std::mt19937_64 random(20);
  const std::string marks = "0159-+.eE, \t\n\r\"#:=()/*|\xff";
  int read = 0, refused = 0;
  for (const std::string& original : originals)
    for (int i = 0; i < 300; ++i) {
      std::string text = original;
      for (int k = 0; k < 1 + i % 3; ++k) {
        const std::size_t place = random() % text.size();
        if (random() % 3 == 0)
          text.erase(place, 1 + random() % 20);
        else
          text[place] = random() % 4 == 0 ? static_cast<char>(random() % 256) : marks[random() % marks.size()];
        if (text.empty()) text = "1";
      }
      try {
        const FloorMotion motion = read_record(write("x", text), {.unit = "cm/s2"});
        for (const double c : motion.horizontal_mps2) ASSERT_TRUE(std::isfinite(c)) << text;
        ++read;
      } catch (const Error&) {
        ++refused;
      }
    }
  EXPECT_GT(read, 100);
  EXPECT_GT(refused, 100);
}

// ---- globs ----

class Glob : public TemporaryFolder {};

TEST_F(Glob, FindsFilesSortedByNameAndNothingElse) {
  write("b.AT2", "x");
  write("a.AT2", "x");
  write("B.AT2", "x");
  write("c.txt", "x");
  std::filesystem::create_directory(folder_ / "d.AT2");
  const auto names = [](const std::vector<std::filesystem::path>& files) {
    std::vector<std::string> found;
    for (const auto& file : files) found.push_back(file.filename());
    return found;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(expand_glob("*.AT2", folder_)), (Names{"B.AT2", "a.AT2", "b.AT2"}));
  EXPECT_EQ(names(expand_glob((folder_ / "[ab].AT?").string())), (Names{"a.AT2", "b.AT2"}));
  EXPECT_EQ(names(expand_glob("", folder_)), (Names{"B.AT2", "a.AT2", "b.AT2", "c.txt"}));
  EXPECT_EQ(names(expand_glob(folder_.string())), (Names{"B.AT2", "a.AT2", "b.AT2", "c.txt"}));
  EXPECT_EQ(names(expand_glob("c.txt", folder_)), (Names{"c.txt"}));
}

TEST_F(Glob, ThatFindsNothingIsAnError) {
  for (const char* pattern : {"*.AT2", "nowhere/*", "x.txt"}) {
    try {
      expand_glob(pattern, folder_);
      ADD_FAILURE() << pattern << " matched";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("no file matches \"" + std::string(pattern) + "\""));
      EXPECT_EQ(error.exit(), Exit::usage);
    }
  }
}

}  // namespace
}  // namespace freestand::motion
