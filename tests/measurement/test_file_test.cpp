// The csv of one measured test: what is read, what is refused, what is left unread.
#include "measurement/data/test_file.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <freestand/error.hpp>
#include <fstream>

#include "measurement/laboratory/plausible.hpp"
#include "measurement/predict/bench.hpp"

namespace freestand::measurement {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class TestFile : public testing::Test {
 protected:
  TestFile() {
    std::string name = (std::filesystem::temp_directory_path() / "freestand-test-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~TestFile() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& text) const {
    std::ofstream(folder_ / "t.csv", std::ios::binary) << text;
    return folder_ / "t.csv";
  }
  measurement::Test read(const std::string& text) const {
    measurement::Test test;
    test.id = "t";
    read_test_file(write(text), 0, test);
    return test;
  }
  std::string refused(const std::string& text) const {
    try {
      read(text);
    } catch (const Error& error) {
      EXPECT_EQ(error.exit(), Exit::data);
      return std::string(error.what()).substr(folder_.string().size() + 1);
    }
    return "nothing was refused";
  }

  std::filesystem::path folder_;
};

// A header, and twelve rows of so many more columns, parted by `comma`.
std::string file(const std::string& header, std::size_t more = 0, const std::string& cell = "0.5") {
  std::string text = header + "\n";
  for (int i = 0; i < 12; ++i) {
    text += std::to_string(0.01 * i) + ",1.5," + std::to_string(0.001 * i);
    for (std::size_t k = 0; k < more; ++k) text += "," + cell;
    text += "\n";
  }
  return text;
}

const std::string needed = "time_s,floor_acceleration_mps2,slip_m";

TEST_F(TestFile, RotationAlone) {
  const measurement::Test test = read(file("time_s,floor_acceleration_mps2,rotation_rad"));
  EXPECT_TRUE(test.slip_m.empty());
  EXPECT_EQ(test.rotation_rad.size(), 12U);
  EXPECT_THAT(refused(file("time_s,floor_acceleration_mps2,block_acceleration_mps2")),
              HasSubstr("t.csv:1: no column slip_m and none rotation_rad"));
}

// Of another unit, too, and with an offset; what two sensors read of one motion is no copy.
TEST_F(TestFile, AChannelThatIsAnotherOnesCopy) {
  const auto with = [](auto&& value) {
    std::string text = "time_s,floor_acceleration_mps2,slip_m,rotation_rad\n";
    for (int i = 0; i < 12; ++i)
      text += std::to_string(0.01 * i) + "," + std::to_string(std::cos(i)) + "," + std::to_string(0.001 * i * i) + "," +
              std::to_string(value(i)) + "\n";
    return text;
  };
  EXPECT_THAT(refused(with([](int i) { return 0.001 * i * i; })),
              HasSubstr("t.csv:1: column rotation_rad is a copy of slip_m"));
  EXPECT_THAT(refused(with([](int i) { return 3 - 9.81 * std::cos(i); })),
              HasSubstr("column rotation_rad is a copy of floor_acceleration_mps2"));
  EXPECT_EQ(read(with([](int i) { return 0.001 * i * i + 1e-5 * (i % 3); })).rotation_rad.size(), 12U);
}

TEST_F(TestFile, ReadsItsColumnsInAnyOrder) {
  const measurement::Test test = read(file("time_s,floor_acceleration_mps2,slip_m,rotation_rad", 1));
  EXPECT_EQ(test.slip_m.size(), 12U);
  EXPECT_EQ(test.rotation_rad[3], 0.5);
  EXPECT_EQ(test.unused_columns, std::vector<std::string>{});
}

TEST_F(TestFile, ColumnsThatAreNotUsedAreNamed) {
  const measurement::Test test = read(file(needed + ",temperature_c,remark", 2, "warm"));
  EXPECT_THAT(test.unused_columns, ElementsAre("temperature_c", "remark"));
  Dataset data;
  data.noise.slip_m = 1e-3;
  data.tests = {test, test, read(file(needed))};
  data.tests[1].id = "u";
  for (std::size_t i : {1U, 2U})  // no two tests have the same slip
    for (double& slip : data.tests[i].slip_m) slip *= 1 + 0.01 * static_cast<double>(i);
  const auto sentences = doubts(Bench(data, 0)).sentences;
  EXPECT_THAT(sentences, testing::Contains(HasSubstr("column temperature_c of tests t, u is not used")));
  EXPECT_EQ(doubts(Bench(data, 0)).spoilt_tests, 0U);
}

// They would be left out of every comparison without a word.
TEST_F(TestFile, AChannelUnderAnotherNameOrUnitIsRefused) {
  EXPECT_EQ(refused(file(needed + ",rotation_deg", 1)),
            "t.csv:1: column rotation_deg has another unit (freestand reads SI, here rad): convert it and write "
            "rotation_rad");
  EXPECT_THAT(refused(file(needed + ",rotation", 1)), HasSubstr("column rotation has no unit"));
  EXPECT_THAT(refused(file(needed + ",rotatoin_rad", 1)), HasSubstr("did you mean rotation_rad?"));
  EXPECT_THAT(refused(file("time_s,floor_acceleration_g,slip_m")), HasSubstr("floor_acceleration_g has another unit"));
  EXPECT_THAT(refused(file("time_s,floor_acceleration_mps2,slip_mm")), HasSubstr("convert it and write slip_m"));
  EXPECT_THAT(refused(file("time_s,floor_acceleration_mps2,lvdt")),
              HasSubstr("no column slip_m and none rotation_rad (the columns are time_s"));
  EXPECT_THAT(refused(file(needed + ",slip_m", 1)), HasSubstr("column slip_m stands twice"));
  EXPECT_THAT(refused(file(needed + ",", 1)), HasSubstr("column 4 has no name"));
  EXPECT_EQ(read(file(needed + ",slip_mm", 1)).unused_columns.size(), 1U);  // beside slip_m
}

TEST_F(TestFile, OtherTablesAreToldAsWhatTheyAre) {
  std::string semicolons = file(needed);
  std::replace(semicolons.begin(), semicolons.end(), ',', ';');
  EXPECT_THAT(refused(semicolons), HasSubstr("t.csv:1: the columns are parted by semicolons"));
  std::replace(semicolons.begin(), semicolons.end(), ';', '\t');
  EXPECT_THAT(refused(semicolons), HasSubstr("parted by tabs"));
  EXPECT_THAT(refused(file("0.0,1.5,0.001")), HasSubstr("no names of columns"));
  EXPECT_THAT(refused(std::string("\xFF\xFEt\0i\0m\0", 8)), HasSubstr("UTF-16"));
}

TEST_F(TestFile, GapsNameColumnAndLine) {
  for (const char* gap : {"", "nan", "NaN", "NA", "#N/A", "--"}) {
    const std::string said = refused(file(needed + ",rotation_rad", 1, gap));
    EXPECT_THAT(said, HasSubstr("t.csv:2: rotation_rad is ")) << gap;
    EXPECT_THAT(said, HasSubstr("a gap cannot be compared")) << gap;
  }
  EXPECT_THAT(refused(file(needed) + "0,12,1,5,0,001\n"), HasSubstr("6 columns (the header has 3)"));
}

TEST_F(TestFile, TimesThatGoBackAreNoGap) {
  EXPECT_THAT(refused(file(needed) + "0.05,1,1\n"), HasSubstr("t.csv:14: time goes back after 0.11 s"));
  EXPECT_THAT(refused(file(needed) + "0.11,1,1\n"), HasSubstr("t.csv:14: time stands still after 0.11 s"));
  EXPECT_THAT(refused(file(needed) + "0.14,1,1\n"), HasSubstr("t.csv:14: time jumps by 0.03 s"));
}

// A terminal obeys what stands in a binary file.
TEST_F(TestFile, WhatIsNoTextReachesNoMessage) {
  std::vector<std::string> files = {std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\x1b[2J", 20),
                                    "\x1b[2J\x07\x9b,time_s\n1,2\n", file(needed + ",\x1b]0;x\x07", 1)};
  files.push_back(file(needed));
  files.back().replace(files.back().find("1.5"), 3, "\x1b[31m\xff");
  files.push_back(std::string(100000, 'x') + "\n");
  for (const std::string& text : files) {
    std::string said;
    measurement::Test test;
    try {
      read_test_file(write(text), 0, test);
      Dataset data;
      data.tests = {test};
      for (const std::string& sentence : doubts(Bench(data, 0)).sentences) said += sentence;
    } catch (const Error& error) {
      said = error.what();
    }
    EXPECT_NE(said, "");
    EXPECT_LT(said.size(), 500U);
    for (const char c : said) EXPECT_TRUE(c >= 0x20 && c < 0x7f) << said;
  }
}

}  // namespace
}  // namespace freestand::measurement
