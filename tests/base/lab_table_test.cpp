#include "base/lab_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "support/error_text.hpp"
#include "support/scratch.hpp"

namespace freestand::lab_table_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class LabTables : public testing::Test {
 protected:
  LabTable read(const std::string& text, const std::string& column = "t") const {
    std::ofstream(folder_ / "lab.csv", std::ios::binary) << text;
    return read_lab_table(folder_ / "lab.csv", column);
  }
  std::string problem(const std::string& text) const {
    return test::error_text(Exit::data, [&] { read(text); });
  }
  const test::Scratch folder_{"lab_tables"};
};

TEST_F(LabTables, NamesStandRightAboveTheNumbersOrAboveTheirUnits) {
  for (const char* text : {"t,lv\n0,1\n1,2\n", "Cabinet test, 12 May\nt,lv\n0,1\n1,2\n", "t,lv\n(s),(mm)\n0,1\n1,2\n",
                           "Cabinet test, 12 May\nt,lv\ns,mm\n0,1\n1,2\n", "run 7\n\nt,lv,\n0,1,\n1,2,\n",
                           "t;lv\n0,0;1,0\n1,0;2,0\n", "t\tlv\r\n0\t1\r\n1\t2\r\n", "t lv\n 0  1\n 1  2\n"}) {
    SCOPED_TRACE(text);
    const LabTable table = read(text);
    EXPECT_THAT(table.columns, ElementsAre("t", "lv"));
    EXPECT_THAT(table.values, ElementsAre(ElementsAre(0, 1), ElementsAre(1, 2)));
  }
  EXPECT_THAT(read("t,lv\n[s],[mm]\n0,1\n1,2\n").units, ElementsAre("[s]", "[mm]"));
  // Units in whatever words, a title as long as the table, numbers for names and in headers.
  for (const char* text : {"t,lv\ns,\xC2\xB5m\n0,1\n1,2\n", "t,lv\nsec,Volts\n0,1\n1,2\n", "t,lv\n(s),1\n0,1\n1,2\n",
                           "Range,10\nOffset,5\nt,lv\n0,1\n1,2\n", "Rate,200\nt,lv\n0,1\n1,2\n",
                           "Channel 1 of 3\nChannel 2 of 3\nt,lv\n0,1\n1,2\n",
                           "Samples\t1000\t1000\nt\tlv\n0\t1\n1\t2\n", "t,lv\n0,1,\n1,2\n"}) {
    SCOPED_TRACE(text);
    const LabTable table = read(text);
    EXPECT_THAT(table.columns, ElementsAre("t", "lv"));
    EXPECT_THAT(table.values, ElementsAre(ElementsAre(0, 1), ElementsAre(1, 2)));
  }
  // A slow column in the last place, one that is empty throughout, words where numbers begin.
  EXPECT_THAT(read("t,a,temp\n0,0,20.5\n1,1,\n2,2,\n3,3,20.6\n").values[0], ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(read("t,a,temp\ns,g,C\n0,0,20.5\n1,1,\n2,2,\n").columns, ElementsAre("t", "a", "temp"));
  EXPECT_THAT(read("t,a,n\ns,g,\n0,0,1\n1,1,2\n").units, ElementsAre("s", "g", ""));
  EXPECT_THAT(read("X_Value\tAcc\tComment\n0\t2\t\n1\t3\t\n", "X_Value").columns,
              ElementsAre("X_Value", "Acc", "Comment"));
  EXPECT_THAT(read("t lv\n0,00 1,0\n0,01 2,0\n").values[0], ElementsAre(0, 0.01));
  EXPECT_THAT(read("t,u,lv\n0,1,OVERLOAD\n1,1,OVERLOAD\n2,1,3\n3,1,4\n4,1,5\n").values[0], ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(read("Time;1;2\n0;1;2\n1;2;3\n", "1").columns, ElementsAre("Time", "1", "2"));
  EXPECT_THAT(read("0,1\n1,2\n").columns, ElementsAre("1", "2"));
  EXPECT_THAT(read("\"t, s\",\"lv, mm\"\n0,1\n1,2\n", "t, s").columns, ElementsAre("t, s", "lv, mm"));
}

// Dates, words and cells that are empty are flaws of their own columns alone.
TEST_F(LabTables, ColumnsMayHoldWords) {
  const LabTable table = read("t,when,lv,note\n0,12:00:01,1,ok\n1,12:00:02,2,\n2,12:00:03,--,ok\n");
  EXPECT_THAT(table.columns, ElementsAre("t", "when", "lv", "note"));
  EXPECT_THAT(table.values[0], ElementsAre(0, 1, 2));
  EXPECT_EQ(table.flaws[0], "");
  EXPECT_THAT(table.flaws[1], HasSubstr(":2: 12:00:01 in column when is no finite number"));
  EXPECT_THAT(table.flaws[2], HasSubstr(":4: -- in column lv"));
  EXPECT_TRUE(std::isnan(table.values[2][2]));
  // A first row that lacks some, and a last column that is empty throughout.
  EXPECT_THAT(read("t,lv\n0,--\n1,2\n2,3\n").values[0], ElementsAre(0, 1, 2));
  EXPECT_THAT(read("t,lv,note\n0,1,\n1,2,\n").columns, ElementsAre("t", "lv", "note"));
}

TEST_F(LabTables, ADecimalCommaIsShown) {
  EXPECT_EQ(read("t;lv\n0;44,600\n1;2\n").with_comma, "44,600");
  EXPECT_EQ(read("t,lv\n0,44\n1,2\n").with_comma, "");
}

TEST_F(LabTables, WhatIsNoTableIsRefused) {
  EXPECT_THAT(problem("t,lv\nnothing,here\n"), HasSubstr("holds no table of numbers"));
  EXPECT_THAT(problem(std::string("t,lv\n0,1\n\0,2\n", 12)), HasSubstr("is no text"));
  EXPECT_THAT(problem("t,lv\n0,1\n1,2,3\n"), HasSubstr(":3: 3 cells where the table has 2 columns"));
  // Row by row: one that is broken at the beginning is not taken for a title.
  EXPECT_THAT(problem("t,lv\n0,1\n1,2,3\n2,3\n3,4\n4,5\n"), HasSubstr(":3: 3 cells where the table has 2 columns"));
  EXPECT_THAT(read("t,lv\n0,NaN\n1,2\n2,3\n").values[0], ElementsAre(0, 1, 2));
  EXPECT_THAT(problem("t,lv\n0,1\n1\n"), HasSubstr(":3: 1 cells where the table has 2 columns"));
}

}  // namespace
}  // namespace freestand::lab_table_test
