#include "base/csv_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <freestand/error.hpp>
#include <fstream>

namespace freestand {
namespace {

class CsvTables : public testing::Test {
 protected:
  ~CsvTables() override { std::filesystem::remove(file_); }
  CsvTable read(const std::string& text) const {
    std::ofstream(file_, std::ios::binary) << text;
    return read_csv_table(file_);
  }
  std::string problem(const std::string& text) const {
    try {
      read(text);
    } catch (const Error& error) {
      EXPECT_EQ(error.exit(), Exit::data);
      return error.what();
    }
    return "";
  }
  const std::filesystem::path file_ =
      std::filesystem::temp_directory_path() /
      ("freestand-csv-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".csv");
};

TEST_F(CsvTables, CellsQuotesCommentsAndLineEnds) {
  const CsvTable table = read(
      "\xEF\xBB\xBF# records\r\nfile, event ,pga_g\r\n\r\na.AT2,\"Chi-Chi, Taiwan\" , 0.3\r\n# left out\r\n"
      "\"b \"\"2\"\".AT2\",,\r\n");
  EXPECT_THAT(table.columns, testing::ElementsAre("file", "event", "pga_g"));
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_THAT(table.rows[0].cells, testing::ElementsAre("a.AT2", "Chi-Chi, Taiwan", "0.3"));
  EXPECT_THAT(table.rows[1].cells, testing::ElementsAre("b \"2\".AT2", "", ""));
  EXPECT_EQ(table.rows[1].line, 6);
  EXPECT_EQ(table.column("pga_g"), 2U);
  EXPECT_EQ(table.column("none"), 3U);
  EXPECT_THAT(csv_columns(file_), testing::ElementsAre("file", "event", "pga_g"));
}

TEST_F(CsvTables, EveryWrongLineIsNamed) {
  const std::string found = problem("a,b\n1\n1,2\n\"1,2\n1,2,3\n");
  EXPECT_THAT(found, testing::HasSubstr(file_.string() + ":2: 1 cells (the header has 2)"));
  EXPECT_THAT(found, testing::HasSubstr(":4: a quote does not end"));
  EXPECT_THAT(found, testing::HasSubstr(":5: 3 cells"));
  EXPECT_EQ(std::count(found.begin(), found.end(), '\n'), 2);
  EXPECT_THAT(problem("a,a\n1,2\n"), testing::HasSubstr(":1: column a stands twice"));
  EXPECT_THAT(problem("a,,b\n1,2,3\n"), testing::HasSubstr("column 2 has no name"));
  EXPECT_THAT(problem("a,b\n"), testing::HasSubstr("has no rows"));
  EXPECT_THAT(problem(""), testing::HasSubstr("has no rows"));
  EXPECT_THAT(problem(std::string("a,b\n1,\0\n", 8)), testing::HasSubstr(":2: no text but a binary file"));
  EXPECT_EQ(problem("a;b;c\n1;2;3\n4;5\n"),
            file_.string() +
                ":1: cells are parted by semicolons (commas part them here, and decimals have points): "
                "replace them");
  EXPECT_THROW(read_csv_table("no/such.csv"), Error);
  EXPECT_THAT(csv_columns("no/such.csv"), testing::IsEmpty());
}

}  // namespace
}  // namespace freestand
