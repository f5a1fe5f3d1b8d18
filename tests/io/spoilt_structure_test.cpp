// Result files of which one dataset or attribute is of another kind or shape, or gone: each is refused in words, or read as one whose
// parts fit together, and none takes memory for values that it does not hold. FREESTAND_SPOILT_EVERY=1 reads all of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <functional>

#include "database/made_database.hpp"
#include "io/database_file.hpp"
#include "io/fragility_file.hpp"
#include "io/made_fragility.hpp"
#include "io/samples_file.hpp"
#include "io/tally_file.hpp"
#include "support/sample_blocks.hpp"
#include "support/scratch.hpp"

namespace freestand::io {
namespace {

namespace fs = std::filesystem;

// Reads every so many of the spoilt copies. Skips where h5py is not there.
void expect_read_or_refused(const fs::path& file, const test::Scratch& scratch, int every,
                            const std::function<void(const fs::path&)>& read) {
  ASSERT_NO_THROW(read(file));
  if (const char* wanted = std::getenv("FREESTAND_SPOILT_EVERY")) every = std::atoi(wanted);
  const fs::path folder = scratch / "spoilt";
  fs::create_directories(folder);
  const std::string command = std::string("/usr/bin/python3 '") + FREESTAND_SOURCE_DIR +
                              "/tests/io/spoil_structure.py' '" + file.string() + "' '" + folder.string() + "' " +
                              std::to_string(every) + " > /dev/null";
  const int code = std::system(command.c_str());
  if (WEXITSTATUS(code) == 77 || WEXITSTATUS(code) == 127) GTEST_SKIP() << "h5py is not there";
  ASSERT_EQ(code, 0);
  int refused = 0, files = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".h5") continue;
    ++files;
    std::string what;
    std::getline(std::ifstream(fs::path(entry.path()).replace_extension(".txt")), what);
    SCOPED_TRACE(what);
    try {
      read(entry.path());
    } catch (const Error& error) {
      ++refused;
      EXPECT_EQ(error.exit(), Exit::data) << error.what();
      EXPECT_THAT(error.what(), testing::HasSubstr(entry.path().string()));
    } catch (const std::exception& other) {
      ADD_FAILURE() << other.what();
    }
  }
  EXPECT_GT(files, 10);
  EXPECT_GT(refused, files / 3);
}

void expect_size(const std::vector<double>& values, std::size_t size, const char* of) {
  EXPECT_EQ(values.size(), size) << of;
}

void expect_whole(const fragility::FragilityFunction& curve) {
  expect_size(curve.probability, curve.grid.size(), "probability");
  expect_size(curve.lower, curve.grid.size(), "lower");
  expect_size(curve.upper, curve.grid.size(), "upper");
  expect_size(curve.resampled_dispersion, curve.resampled_median.size(), "resampled");
  expect_size(curve.left_out_dispersion, curve.left_out_median.size(), "left out");
}

void expect_whole(const fragility::Result& result) {
  const std::size_t bins = result.im.size();
  expect_size(result.im_edge, bins + 1, "edges");
  for (const fragility::EdpResult& edp : result.edps) {
    const std::size_t points = bins * edp.capacity.size();
    EXPECT_EQ(edp.bins.size(), bins);
    for (const auto* values :
         {&edp.surface.probability, &edp.surface.lower, &edp.surface.upper, &edp.surface.empirical, &edp.surface.least,
          &edp.surface.most, &edp.surface.empirical_lower, &edp.surface.empirical_upper})
      expect_size(*values, points, "surface");
    if (points) {
      EXPECT_EQ(edp.surface.resampled.size() % points, 0U);
      EXPECT_EQ(edp.surface.left_out.size() % points, 0U);
    }
    EXPECT_TRUE(edp.functions.empty() || edp.functions.size() == edp.capacity.size());
    for (const auto& curve : edp.functions) expect_whole(curve);
    const std::size_t edges = edp.distribution.ln_edge.size();
    EXPECT_EQ(edp.distribution.count.size(), edges == 0 ? 0 : bins * (edges - 1));
    for (const fragility::AxisSurface& axis : edp.axes) {
      EXPECT_EQ(axis.edge.size(), axis.centre.size() + 1);
      EXPECT_EQ(axis.n.size(), bins * axis.centre.size());
      for (const auto* values : {&axis.probability, &axis.lower, &axis.upper})
        expect_size(*values, points * axis.centre.size(), "axis");
    }
  }
  expect_whole(result.overturning);
  const std::size_t edps = result.covariance.edps.size();
  expect_size(result.covariance.ln_covariance, bins * edps * edps, "covariance");
  EXPECT_EQ(result.covariance.n.size(), bins * edps * edps);
}

TEST(SpoiltStructure, OfFragility) {
  const test::Scratch scratch("spoilt_fragility");
  fragility::Result result = test::example();
  result.covariance = {{"delta", "slid"}, std::vector<double>(12, 0.5), std::vector<std::int64_t>(12, 9)};
  write_fragility(scratch / "fragility.h5", test::small_header().provenance, result);
  expect_whole(read_fragility(scratch / "fragility.h5").result);
  expect_read_or_refused(scratch / "fragility.h5", scratch, 17,
                         [](const fs::path& file) { expect_whole(read_fragility(file).result); });
}

TEST(SpoiltStructure, OfSamples) {
  const test::Scratch scratch("spoilt_samples");
  SamplesHeader header = test::small_header();
  header.provenance.samples = 10;
  write_samples({}, scratch / "samples.h5", header, {10, 4}, test::small_blocks({10, 4}));
  expect_read_or_refused(scratch / "samples.h5", scratch, 5, [](const fs::path& file) {
    const SampleReader reader(file);
    EXPECT_EQ(reader.read(0, reader.rows()).rows(), static_cast<std::size_t>(reader.rows()));
    const MotionRows& motions = reader.motions();
    EXPECT_EQ(motions.group.size(), motions.names.size());
    EXPECT_EQ(motions.sa_mps2.size(), motions.names.size() * motions.sa_period_s.size());
  });
}

TEST(SpoiltStructure, OfATally) {
  const test::Scratch scratch("spoilt_tally");
  write_tally(scratch / "tally.h5", {test::small_header().provenance, "0123abcd", {0, -1, 7}});
  expect_read_or_refused(scratch / "tally.h5", scratch, 5, [](const fs::path& file) { read_tally(file); });
}

TEST(SpoiltStructure, OfADatabase) {
  const test::Scratch scratch("spoilt_database");
  write_database(scratch / "database.h5", database::test::made_database());
  expect_read_or_refused(scratch / "database.h5", scratch, 11, [](const fs::path& file) {
    const database::Database db = read_database(file);
    for (const database::Curve& curve : db.curves) EXPECT_LT(curve.entry, db.entries.size());
  });
}

}  // namespace
}  // namespace freestand::io
