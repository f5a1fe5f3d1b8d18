#include <cmath>
#include <cstdio>
#include <freestand/error.hpp>
#include <random>

#include "motion/record.hpp"
#include "motion/record_fixture.hpp"

namespace freestand::motion {
namespace {

// ---- files with several channels and other agencies ----

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

// A count that is too small: what it leaves of the channel is no channel.
TEST_F(Record, CsmipV2WithMoreValuesThanItSaysIsRefused) {
  std::string text = csmip_channel(1, "H1", "  1.000000  2.000000  3.000000\n  4.000000  5.000000\n");
  expect_data_error(write("more.V2", text), 6, "more values here (the header says 3 in all)");
}

// Channels of other lengths: the shorter one ends at rest.
TEST_F(Record, AShorterVerticalChannelEndsAtRest) {
  std::string up = csmip_channel(2, "UP", "  7.000000  8.000000\n");
  up.replace(up.find("    3 points of accel"), 5, "    2");
  const FloorMotion both = read_record(write("x.V2", csmip_channel(1, "H1", "  1.000000  2.000000  3.000000\n") + up));
  EXPECT_THAT(samples(both, Channel::vertical), testing::Pointwise(testing::DoubleNear(1e-12), {0.07, 0.08, 0.0}));
}

// What is told of a record's direction is that of the channel which is read.
TEST_F(Record, TheDirectionIsThatOfTheChannel) {
  const std::string three = "  1.000000  2.000000  3.000000\n";
  const auto path = write("x.V2", csmip_channel(1, "H1", three) + csmip_channel(2, "UP", three));
  EXPECT_EQ(direction_of(path).vertical, "");
  EXPECT_EQ(direction_of(path, {.channel = "UP"}).vertical, "channel UP is");
  EXPECT_FALSE(direction_of(path, {.channel = "UP"}).down);
  const auto down = write("CPEDWN.AT2", at2_head + "NPTS= 7, DT= .0050 SEC\n" + seven_text);
  EXPECT_TRUE(direction_of(down).down);
  EXPECT_NE(direction_of(down).vertical, "");
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

}  // namespace
}  // namespace freestand::motion
