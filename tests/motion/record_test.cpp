#include "motion/record.hpp"

#include <cmath>
#include <cstdio>
#include <freestand/error.hpp>

#include "motion/record_fixture.hpp"
#include "motion/record_format.hpp"
#include "support/data.hpp"

namespace freestand::motion {
namespace {

// ---- PEER .AT2 ----

TEST_F(Record, At2ReadsEveryVariantOfItsHeader) {
  const char* headers[] = {"NPTS=   7, DT=   .0050 SEC,                                             \n",
                           "NPTS=   7, DT=   .0050 SEC                                              \n",
                           "NPTS=   7, DT=   .0050 SEC,   0 POLE @    30.00000 HZ,  -5 POLE @      .05000\n",
                           "NPTS=  7, DT= .00500 SEC\n",
                           "NPTS=  7, DT= 5.0 MSEC\n",
                           "NPTS=  7, DT= 5.0 (MILLISECONDS)\n",
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

TEST_F(Record, At2ReadsTheUnitOfTheOldestHeaders) {
  const std::string head =
      "PEER STRONG MOTION DATABASE RECORD\nSOMEWHERE 10/15/79 2316, STATION, 230\n"
      "ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.1 Hz LP=33.0 Hz\n    7    .00500    NPTS, DT\n";
  expect_samples(read_record(write("x.AT2", head + seven_text)), 0.005, seven, g);
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

TEST_F(Record, AFileThatWasCutOffInANumberIsRefused) {
  const std::string csv = "time_s,floor_acceleration_mps2\n0,0.0000\n0.01,0.1250\n0.02,-0.2500\n0.03,0.12";
  expect_data_error(write("cut.csv", csv), 5, "the line has no end");
  EXPECT_EQ(read_record(write("whole.csv", csv + "\n")).knot_s.size(), 4U);
  EXPECT_EQ(read_record(write("full.csv", csv + "50")).knot_s.size(), 4U);
  const std::string at2 = at2_head + "NPTS= 4, DT= .01 SEC\n .1234E-02 .2345E-03\n .3456E-03 .4567";
  expect_data_error(write("cut.AT2", at2), 6, "the line has no end");
  EXPECT_EQ(read_record(write("full.AT2", at2 + "E-03")).knot_s.size(), 4U);
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

// However the header writes it; g where it says nothing and the user does not either.
TEST_F(Record, At2IsInTheUnitOfItsHeader) {
  const auto at2 = [&](const std::string& line) {
    return write("x.AT2", "a\nb\n" + line + "\nNPTS= 7, DT= .0050 SEC\n" + seven_text);
  };
  for (const char* line : {"ACCELERATION TIME HISTORY, UNITS: M/S2", "ACCELERATION TIME SERIES IN M/S2",
                           "Acceleration (m/s2)", "ACCELERATION TIME SERIES IN UNITS OF M/S2"}) {
    SCOPED_TRACE(line);
    expect_samples(read_record(at2(line)), 0.005, seven, 1);
    expect_usage_error(at2(line), "unit g contradicts the file (it says m/s2)", {.unit = "g"});
  }
  for (const char* line :
       {"ACCELERATION TIME SERIES IN CM/SEC**2", "ACCELERATION, UNITS: CM/S**2", "Acceleration (cm/sec**2)",
        "ACCELERATION IN GALS", "UNITS: GALS", "ACCELERATION (cm/s\u00b2)", "UNITS CM/S\u00b2", "ACCELERATION cm/s2",
        "CORRECTED ACCELERATION (CM/SEC/SEC)", "ACCELERATION IN CM /S2", "ACCELERATION, GAL",
        "TWIN PEAKS, ACCELERATION (CM/S2)", "ACCELERATION IN CM/S2, PEAK = 312.4",
        "ACCELERATION IN CM/S2\nPEAK ACCELERATION IN G: 0.35", "STATION IN M DISTRICT, ACCELERATION IN CM/S2"}) {
    SCOPED_TRACE(line);
    expect_samples(read_record(at2(line)), 0.005, seven, 0.01);
  }
  // Units of something, which are not known, are never taken for g; the user may name what they are.
  for (const char* line : {"ACC (CM/S-2) OF ACCELERATION", "ACCELERATION IN MILLI-G", "ACCELERATION (MG)", "ACC. (MG)",
                           "ACCELERATION %G", "ACCELERATION (%G)", "ACCELERATION IN CM/S"}) {
    SCOPED_TRACE(line);
    expect_data_error(at2(line), 0, "no unit of acceleration");
    expect_samples(read_record(at2(line), {.unit = "cm/s2"}), 0.005, seven, 0.01);
  }
  // Words that are no units.
  for (const char* line :
       {"ACCELERATION TIME HISTORY OF M 6.9 LOMA PRIETA", "ACCELERATION (E/W)", "ACCELERATION OF N/S COMPONENT",
        "ACCELERATION OF 10/18/89", "CORRECTED ACCELEROGRAM (10/18/89)", "SCALED TO (50%)", "ACCELEROGRAPH UNIT: SMA-1",
        "ACCELERATION TIME HISTORY\nPGA = 469.9 CM/S2", "ACCELERATION IN G\nPEAK = 469.9 CM/S2",
        "Galway (GAL), 090\nACCELERATION IN UNITS OF G",
        "PEER STRONG MOTION DATABASE RECORD. PROCESSING BY PACIFIC ENGINEERING.",
        "ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.2 Hz LP=40.0 Hz"}) {
    SCOPED_TRACE(line);
    expect_samples(read_record(at2(line)), 0.005, seven, g);
  }
  expect_samples(read_record(at2("ACCELERATION TIME HISTORY")), 0.005, seven, g);
  expect_samples(read_record(at2("ACCELERATION TIME HISTORY"), {.unit = "m/s2"}), 0.005, seven, 1);
  expect_samples(read_record(at2("ACCELERATION OF STATION G IN THE WEST (G)")), 0.005, seven, g);
}

TEST_F(Record, At2WithABrokenHeaderIsRefused) {
  expect_data_error(write("a.AT2", at2_head + "NPTS= x7, DT= .005\n" + seven_text), 4, "cannot read the count \"x7\"");
  expect_data_error(write("b.AT2", at2_head + "NPTS= 7, DT= 0 SEC\n" + seven_text), 0, "time step 0 s is of no use");
  expect_data_error(write("c.AT2", at2_head + "NPTS= 7, DT= \n" + seven_text), 4, "NPTS= or DT= without a value");
  expect_data_error(write("d.AT2", at2_head + "NPTS= 7, DT= -.005 SEC\n" + seven_text), 0, "not a positive number");
  expect_data_error(write("e.AT2", at2_head + "NPTS, DT\n" + seven_text), 4, "no count and step");
  expect_data_error(write("f.AT2", "a\nb\nVELOCITY TIME SERIES IN UNITS OF CM/S\nNPTS= 7, DT= .01\n" + seven_text), 3,
                    "not a record of acceleration");
  expect_data_error(write("i.AT2", "a\nb\nVELOCITY TIME HISTORY IN UNITS OF CM/S\nNPTS= 7, DT= .01\n" + seven_text), 3,
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

// A column that says that it is the floor's acceleration is read, or refused.
TEST_F(Record, FloorCsvLeavesNoAccelerationOfTheFloorUnread) {
  for (const char* name : {"floor_cross_acceleration_mps2", "floor_vertical_acceleration_g"})
    expect_data_error(write("f.csv", std::string("time_s,floor_acceleration_mps2,") + name + "\n0,1,1\n1,2,2\n"), 1,
                      "would be left unread");
  expect_data_error(write("f.csv", "time_s,floor_acceleration_mps2,floor_acceleration_mps2\n0,1,1\n1,2,2\n"), 1,
                    "column floor_acceleration_mps2 stands twice");
  EXPECT_EQ(
      read_record(write("f.csv", "time_s,floor_acceleration_mps2,floor_displacement_m\n0,1,1\n1,2,2\n")).knot_s[1], 1);
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
  expect_data_error(write("b", "1, 2, 3\n"), 1, "3 columns without a header", options);
  expect_data_error(write("b", "0,00;0,1234\n"), 1, "decimal commas", options);
  expect_data_error(write("b", "0,00\t0,1234\n"), 1, "decimal commas", options);
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
  EXPECT_THAT(message, HasSubstr("s.AT2 are no pair of components (their steps are 0.01 s and 0.02 s)"));
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
                    0, "no text but a binary file (byte 5 is zero)");
}

TEST_F(Record, FormatCanBeNamed) {
  const auto path = write("x", "1\n2\n");
  expect_samples(read_record(path, {.dt_s = 1, .unit = "g", .format = "plain"}), 1, {1, 2}, g);
  for (const double dt : {1e-300, 1e-7, 11.0, 1e300})
    expect_data_error(path, 0, "is its time in seconds?", {.dt_s = dt, .unit = "g", .format = "plain"});
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
