#include "io/samples_file.hpp"

#include <cstring>

#include "base/durable_file.hpp"
#include "io/python.hpp"
#include "support/error_text.hpp"
#include "support/sample_blocks.hpp"
#include "support/scratch.hpp"
#include "support/trouble.hpp"

namespace freestand::io {
namespace {

using test::error_text;
using test::small_blocks;
using test::small_header;
using test::small_rows;
using testing::AllOf;
using testing::HasSubstr;

std::filesystem::path write_ten(const test::Scratch& scratch) {
  SamplesHeader header = small_header();
  header.provenance.samples = 10;
  const BlockLayout layout{10, 4};
  write_samples({}, scratch / "samples.h5", header, layout, small_blocks(layout));
  return scratch / "samples.h5";
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

TEST(BlockLayout, TheLastBlockMayBeShort) {
  const BlockLayout layout{10, 4};
  EXPECT_EQ(layout.blocks(), 3);
  EXPECT_EQ(layout.rows(0), 4);
  EXPECT_EQ(layout.rows(2), 2);
  EXPECT_EQ(layout.rows(3), 0);
  EXPECT_EQ((BlockLayout{8, 4}.blocks()), 2);
  EXPECT_EQ((BlockLayout{0, 4}.blocks()), 0);
}

TEST(SamplesFile, RowsComeBackToTheBitInAnySlices) {
  const test::Scratch scratch("samples");
  const SampleReader reader(write_ten(scratch));
  EXPECT_EQ(reader.rows(), 10);
  for (const auto& [first, count] : {std::pair{0, 10}, {0, 1}, {3, 4}, {9, 1}, {10, 0}})
    EXPECT_TRUE(same_bits(reader.read(first, count).values, small_rows(first, count))) << first;
  EXPECT_THROW(reader.read(8, 3), Error);
  EXPECT_THROW(reader.read(-1, 3), Error);
}

TEST(SamplesFile, ColumnsAndProvenanceComeBack) {
  const test::Scratch scratch("samples");
  const SampleReader reader(write_ten(scratch));
  const SamplesHeader header = small_header();
  ASSERT_EQ(reader.columns().size(), header.columns.size());
  for (std::size_t i = 0; i < header.columns.size(); ++i) {
    EXPECT_EQ(reader.columns()[i].name, header.columns[i].name);
    EXPECT_EQ(reader.columns()[i].unit, header.columns[i].unit);
    EXPECT_EQ(reader.columns()[i].description, header.columns[i].description);
    EXPECT_EQ(reader.columns()[i].kind, header.columns[i].kind);
  }
  EXPECT_EQ(reader.motions().names, header.motions.names);
  EXPECT_EQ(reader.motions().group, header.motions.group);
  EXPECT_EQ(reader.motions().table.values, header.motions.table.values);
  EXPECT_EQ(reader.motions().table.columns.at(0).unit, "m/s2");
  EXPECT_EQ(reader.motions().table.columns.at(1).kind, ColumnKind::integer);
  EXPECT_EQ(reader.motions().sa_period_s, header.motions.sa_period_s);
  EXPECT_EQ(reader.motions().sa_mps2, header.motions.sa_mps2);
  EXPECT_EQ(reader.provenance().study, header.provenance.study);
  EXPECT_EQ(reader.provenance().seed, 7u);
  EXPECT_EQ(reader.provenance().samples, 10);
}

TEST(SamplesFile, NamedColumnsComeInTheOrderAsked) {
  const test::Scratch scratch("samples");
  const SampleReader reader(write_ten(scratch));
  const Table table = reader.read(4, 2, {"impacts", "block_width_m"});
  EXPECT_EQ(table.columns[0].name, "impacts");
  EXPECT_EQ(table.values, (std::vector<double>{-4, 0.1 * 4 + 0.3, -5, 0.1 * 5 + 0.3}));
  EXPECT_THAT(error_text(Exit::data, [&] { reader.read(0, 1, {"nothing"}); }), HasSubstr("nothing"));
}

TEST(SamplesFile, TheSizeOfTheBlocksLeavesNoTrace) {
  const test::Scratch scratch("samples");
  for (const std::int64_t size : {1, 7, 1000, 5000}) {
    const BlockLayout layout{5000, size};
    write_samples({}, scratch / std::to_string(size), small_header(), layout, small_blocks(layout));
    EXPECT_EQ(read_whole(scratch / std::to_string(size)), read_whole(scratch / "1"));
  }
}

TEST(SamplesFile, NoSamplesAtAllIsAFileToo) {
  const test::Scratch scratch("samples");
  write_samples({}, scratch / "samples.h5", small_header(), {0, 4}, small_blocks({0, 4}));
  const SampleReader reader(scratch / "samples.h5");
  EXPECT_EQ(reader.rows(), 0);
  EXPECT_EQ(reader.read(0, 0).rows(), 0u);
}

TEST(SamplesFile, OpensInH5py) {
  const test::Scratch scratch("samples");
  FREESTAND_CHECK_WITH_PYTHON("samples", write_ten(scratch));
}
TEST(SamplesFile, OpensInXarrayByNetcdf4) {
  const test::Scratch scratch("samples");
  FREESTAND_CHECK_WITH_PYTHON("xarray-samples-netcdf4", write_ten(scratch));
}
TEST(SamplesFile, OpensInXarrayByH5netcdf) {
  const test::Scratch scratch("samples");
  FREESTAND_CHECK_WITH_PYTHON("xarray-samples-h5netcdf", write_ten(scratch));
}

TEST(SamplesFile, AnotherFormatIsRefused) {
  const test::Scratch scratch("samples");
  h5::File file = h5::File::create(scratch / "x.h5");
  h5::Group root = file.root();
  write_provenance(root, "freestand-samples/9", small_header().provenance);
  file.finish();
  EXPECT_THAT(error_text(Exit::data, [&] { SampleReader(scratch / "x.h5"); }),
              AllOf(HasSubstr("x.h5"), HasSubstr("freestand-samples/9")));
}

TEST(SamplesFile, ABlockOfAnotherShapeIsRefused) {
  const test::Scratch scratch("samples");
  const auto short_by_one = [](std::int64_t) { return std::vector<double>(4 * 6 - 1); };
  EXPECT_THAT(error_text(Exit::data,
                         [&] {
                           write_samples({}, scratch / "x.h5", small_header(), {8, 4}, short_by_one);
                         }),
              HasSubstr("block 0"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "x.h5"));
}

TEST(SamplesFile, WholeNumberColumnsTakeOnlyWholeNumbers) {
  const test::Scratch scratch("samples");
  for (const double bad : {0.5, 256.0, -1.0, static_cast<double>(NAN)}) {
    const auto rows = [bad](std::int64_t) { return std::vector<double>{0, 0, 0, 0, 0, bad}; };
    EXPECT_THAT(error_text(Exit::data,
                           [&] {
                             write_samples({}, scratch / "x.h5", small_header(), {1, 1}, rows);
                           }),
                HasSubstr("overturned"));
  }
  EXPECT_TRUE(std::filesystem::is_empty(scratch.folder()));
}

TEST(SamplesFile, AFullDiskHasToBeCuredAndLeavesNothing) {
  const test::Scratch scratch("samples");
  const test::SmallDisk disk(scratch / "disk", "64k");
  if (!disk.mounted()) GTEST_SKIP() << "no right to mount a small file system here";
  const BlockLayout layout{100000, 1000};
  EXPECT_THAT(
      error_text(
          Exit::cure,
          [&] { write_samples({}, disk.folder() / "samples.h5", small_header(), layout, small_blocks(layout)); }),
      AllOf(HasSubstr("samples.h5"), HasSubstr("No space left")));
  EXPECT_TRUE(std::filesystem::is_empty(disk.folder()));
}

}  // namespace
}  // namespace freestand::io
