#include "io/database_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <set>

#include "database/made_database.hpp"
#include "io/database_columns.hpp"
#include "io/h5.hpp"
#include "io/python.hpp"
#include "support/error_text.hpp"
#include "support/scratch.hpp"

namespace freestand::io {
namespace {

using freestand::test::error_text;

// Every column holds another value than any other, so that two that are exchanged are seen.
template <class Row>
void fill(std::span<const DatabaseColumn<Row>> columns, Row& row, int& counter) {
  for (const auto& column : columns) {
    ++counter;
    if (const auto* text = std::get_if<std::string Row::*>(&column.member))
      row.** text = "text " + std::to_string(counter) + ", \"ä\"";
    else if (const auto* whole = std::get_if<std::int64_t Row::*>(&column.member))
      row.** whole = counter;
    else
      row.*std::get<double Row::*>(column.member) = counter + 0.1;
  }
}

template <class Row>
void expect_same(std::span<const DatabaseColumn<Row>> columns, const Row& a, const Row& b) {
  for (const auto& column : columns)
    std::visit(
        [&]<class T>(T Row::*member) {
          if constexpr (std::is_same_v<T, double>)
            EXPECT_EQ(std::bit_cast<std::uint64_t>(a.*member), std::bit_cast<std::uint64_t>(b.*member)) << column.name;
          else
            EXPECT_EQ(a.*member, b.*member) << column.name;
        },
        column.member);
}

TEST(DatabaseFile, ReadsBackAsItWasWritten) {
  database::Database db = database::test::made_database();
  int counter = 0;
  for (database::Entry& entry : db.entries) fill(entry_columns(), entry, counter);
  for (database::Curve& curve : db.curves) fill(curve_columns(), curve, counter);
  db.curves[3].points.clear();
  db.curves[1].points[2].lower = database::unknown;
  const freestand::test::Scratch scratch("database");
  write_database(scratch / "database.h5", db);
  const database::Database back = read_database(scratch / "database.h5");
  EXPECT_EQ(back.name, db.name);
  EXPECT_EQ(back.revision, db.revision);
  EXPECT_EQ(back.confidence, db.confidence);
  EXPECT_EQ(back.classes, db.classes);
  ASSERT_EQ(back.demands.size(), 2U);
  EXPECT_TRUE(back.demands[1].binary);
  EXPECT_EQ(back.intensities[0].summary, db.intensities[0].summary);
  ASSERT_EQ(back.entries.size(), db.entries.size());
  for (std::size_t i = 0; i < db.entries.size(); ++i) expect_same(entry_columns(), back.entries[i], db.entries[i]);
  ASSERT_EQ(back.curves.size(), db.curves.size());
  for (std::size_t i = 0; i < db.curves.size(); ++i) {
    EXPECT_EQ(back.curves[i].entry, db.curves[i].entry);
    expect_same(curve_columns(), back.curves[i], db.curves[i]);
    ASSERT_EQ(back.curves[i].points.size(), db.curves[i].points.size());
    for (std::size_t k = 0; k < db.curves[i].points.size(); ++k)
      expect_same(point_columns(), back.curves[i].points[k], db.curves[i].points[k]);
  }
}

std::filesystem::path write_made(const freestand::test::Scratch& scratch) {
  write_database(scratch / "database.h5", database::test::made_database());
  return scratch / "database.h5";
}

TEST(DatabaseFile, OpensInH5pyWithItsScales) {
  const freestand::test::Scratch scratch("database_h5py");
  FREESTAND_CHECK_WITH_PYTHON("database", write_made(scratch));
}

TEST(DatabaseFile, OpensInXarrayByH5netcdf) {
  const freestand::test::Scratch scratch("database_xarray");
  FREESTAND_CHECK_WITH_PYTHON("xarray-database-h5netcdf", write_made(scratch));
}

TEST(DatabaseFile, NamesOfColumnsAreNoOthers) {
  std::set<std::string> names;
  for (const auto& column : entry_columns()) EXPECT_TRUE(names.insert(column.name).second) << column.name;
  names.clear();
  for (const auto& column : curve_columns()) EXPECT_TRUE(names.insert(column.name).second) << column.name;
}

TEST(DatabaseFile, AnotherFileIsRefused) {
  const freestand::test::Scratch scratch("no_database");
  {
    h5::File file = h5::File::create(scratch / "other.h5");
    file.root().attribute("format", "freestand-samples/1");
    file.finish();
  }
  EXPECT_THAT(error_text(Exit::data, [&] { read_database(scratch / "other.h5"); }),
              testing::AllOf(testing::HasSubstr("is no database"), testing::HasSubstr("freestand-samples/1")));
  EXPECT_THAT(error_text(Exit::data, [&] { read_database(scratch / "nowhere.h5"); }), testing::HasSubstr("nowhere.h5"));
}

}  // namespace
}  // namespace freestand::io
