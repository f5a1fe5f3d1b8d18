#include "motion/record_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "motion/record_fixture.hpp"

namespace freestand::motion {
namespace {

const char* const record = "time_s,floor_acceleration_mps2\n0,0\n0.1,1\n0.2,0\n";

class Table : public TemporaryFolder {
 protected:
  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  void SetUp() override {
    for (const char* name : {"a.csv", "b.csv", "up.csv"}) write(name, record);
    std::filesystem::create_directories(path("more"));
    write("more/c.csv", record);
  }
  RecordTable read(const std::string& text, const std::string& group = "", bool vertical = false) const {
    return read_record_table(write("INDEX.csv", text), group, vertical);
  }
  std::string problem(const std::string& text, const std::string& group = "") const {
    try {
      read(text, group);
    } catch (const Error& error) {
      EXPECT_EQ(error.exit(), Exit::data);
      return error.what();
    }
    return "";
  }
};

TEST_F(Table, RowsSayWhatTheFilesDoNot) {
  const RecordTable table = read(
      "file,dt_s,unit,format,channel,group,pga_g,magnitude_mw,distance_km,arias_mps,vs30_mps,npts,ia_mps,bracketed_s\n"
      "a.csv,0.01,cm/s2,plain,2,loma,0.4,6.9,12,1.5,400,300,1.5,9\n"
      "more/c.csv,,,,,,,7,n/a,,,200,,\n");
  ASSERT_EQ(table.rows.size(), 2U);
  const RecordRow& row = table.rows[0];
  EXPECT_EQ(row.where, path("INDEX.csv").string() + ":2");
  EXPECT_EQ(row.file, path("a.csv"));
  EXPECT_EQ(row.dt_s, 0.01);
  EXPECT_EQ(row.unit + row.format + row.channel + row.group, "cm/s2plain2loma");
  EXPECT_FALSE(table.rows[1].dt_s);
  EXPECT_EQ(table.rows[1].file, path("more/c.csv"));
  // Amplitudes scale with the record, Arias intensity with its square; magnitude, distance and site do not; how the time
  // above a level changes is not known.
  std::vector<std::string> names, units;
  std::vector<int> powers;
  for (const RecordNumber& number : table.numbers) {
    names.push_back(number.name);
    units.push_back(number.unit);
    powers.push_back(number.power);
  }
  EXPECT_THAT(names, testing::ElementsAre("pga_g", "magnitude_mw", "distance_km", "arias_mps", "vs30_mps", "ia_mps"));
  EXPECT_THAT(units, testing::ElementsAre("g", "1", "km", "m/s", "m/s", "m/s"));
  EXPECT_THAT(powers, testing::ElementsAre(1, 0, 0, 2, 0, 2));
  EXPECT_THAT(row.numbers, testing::ElementsAre(0.4, 6.9, 12, 1.5, 400, 1.5));
  EXPECT_TRUE(std::isnan(table.rows[1].numbers[0]) && std::isnan(table.rows[1].numbers[2]));
}

TEST_F(Table, VerticalComponentsAreLeftOutAndFoundAsPartners) {
  const std::string text =
      "suite,file,event,station,component\nmore,c.csv,E,S,NS\n,a.csv,E,S,NS\n,b.csv,E,S,EW\n,up.csv,E,S,UD\n";
  const RecordTable table = read(text);
  EXPECT_EQ(table.rows.size(), 3U);
  EXPECT_THAT(table.left_out, testing::ElementsAre("up.csv (its component is UD)"));
  EXPECT_TRUE(table.rows[1].vertical.empty());
  const RecordTable paired = read(text, "event", true);
  EXPECT_TRUE(paired.rows[0].vertical.empty());  // of another suite
  EXPECT_EQ(paired.rows[1].vertical, path("up.csv"));
  EXPECT_EQ(paired.rows[2].vertical, path("up.csv"));
  EXPECT_EQ(paired.rows[0].group, "E");
  EXPECT_EQ(read("file,vertical\na.csv,up.csv\nb.csv,\n").rows[0].vertical, path("up.csv"));
}

TEST_F(Table, ItsGroupsAreAColumn) {
  EXPECT_THAT(read("file,event,station\na.csv,E,S\n").grouping_columns, testing::ElementsAre("event", "station"));
  EXPECT_THAT(read("file,event,group\na.csv,E,G\n").grouping_columns, testing::IsEmpty());
  EXPECT_EQ(read("file,event,group\na.csv,E,G\n").rows[0].group, "G");
  EXPECT_EQ(read("file,event,group\na.csv,E,G\n", "event").rows[0].group, "E");
  EXPECT_THAT(problem("file,event\na.csv,E\n", "quake"), HasSubstr("no column quake to group by"));
}

TEST_F(Table, EveryRowThatIsWrongIsNamed) {
  const std::string found = problem(
      "file,dt_s,unit,pga_g\n"
      "gone.csv,,,\n"
      "a.csv,-0.01,,\n"
      "a.csv,,furlong/s2,\n"
      "a.csv,,,strong\n"
      ",,,1\n"
      "b.csv,0.1,g,0.3\n");
  for (const char* says : {":2: file gone.csv is not there", ":3: dt_s is not above zero",
                           ":4: no unit of acceleration", ":5: pga_g is \"strong\"", ":6: file is empty"})
    EXPECT_THAT(found, HasSubstr(path("INDEX.csv").string() + says));
  EXPECT_EQ(std::count(found.begin(), found.end(), '\n'), 4) << found;
  EXPECT_THAT(problem("name,dt_s\na,1\n"), HasSubstr("has no column file"));
  EXPECT_THAT(problem("file,component\nup.csv,UP\n"), HasSubstr("names no horizontal component"));
}

TEST_F(Table, IsToldFromARecord) {
  EXPECT_TRUE(is_record_table(write("INDEX.csv", "suite,file\n,a.csv\n")));
  EXPECT_FALSE(is_record_table(path("a.csv")));
  EXPECT_FALSE(is_record_table(write("x.AT2", std::string("file\0", 5))));
  EXPECT_FALSE(is_record_table(path("more")));
  EXPECT_FALSE(is_record_table(path("gone.csv")));
}

}  // namespace
}  // namespace freestand::motion
