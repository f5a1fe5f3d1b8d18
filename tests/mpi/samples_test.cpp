#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <numeric>

#include "base/durable_file.hpp"
#include "io/samples_file.hpp"
#include "mpi/mpi_main.hpp"
#include "parallel/finished_blocks.hpp"
#include "parallel/schedule.hpp"
#include "support/sample_blocks.hpp"

namespace freestand::io {
namespace {

namespace fs = std::filesystem;
using test::small_header;
using test::small_rows;
using test::world;

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

// Files stay where FREESTAND_KEPT_SAMPLES says, so that runs with other numbers of ranks can be compared; else in the folder
// for temporary files, whatever folder the program is started in.
fs::path place(const std::string& name) {
  const char* kept = std::getenv("FREESTAND_KEPT_SAMPLES");
  return (kept ? fs::path(kept) : fs::temp_directory_path()) / name;
}

fs::path folder() {
  const fs::path path = place(fmt::format("samples_of_{}_ranks", world().size()));
  world().on_root([&] {
    fs::remove_all(path);
    fs::create_directories(path);
  });
  return path;
}

// Each rank reads parts of the logs, here of two pages; where one is of another study, all know.
TEST(Samples, LogsOfManyRunsAreFoundByAllRanksTogether) {
  const fs::path path = folder() / "logs";
  world().on_root([&] {
    for (std::int64_t run = 0; run < 7; ++run) {
      parallel::BlockLog one(path, "small");
      one.look({});
      one.begin({});
      for (std::int64_t block = 10 * run; block < 10 * run + 12; ++block)  // two of them again in the next run
        one.write(block, {1, {static_cast<double>(run)}});
    }
  });
  const auto looked = [&](const std::string& fingerprint) {
    parallel::BlockLog next(path, fingerprint, 0, 8192);
    next.look(world());
    world().on_root([&] { next.find(); });
    return next;
  };
  parallel::BlockLog next = looked("small");
  std::vector<std::int64_t> all(72);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(next.begin(world()), all);
  EXPECT_EQ(next.read(10).values, std::vector<double>{1});
  EXPECT_EQ(next.read(71).values, std::vector<double>{6});
  EXPECT_THROW(looked("other"), Error);
  world().barrier();
  world().on_root([&] { parallel::remove_finished_blocks(path); });
}

// The way of a sweep: blocks by whoever is free, each into the log of its node, then all into samples.h5.
TEST(Samples, FromBlocksToTheFileTheBitsAreKept) {
  const fs::path path = folder();
  const BlockLayout layout{123457, 1000};
  parallel::BlockLog store(path / "blocks", "small");
  store.begin(world());
  std::vector<std::int64_t> todo(static_cast<std::size_t>(layout.blocks()));
  std::iota(todo.begin(), todo.end(), 0);
  ASSERT_TRUE(parallel::for_each_block(world(), todo, [&](std::int64_t block, const parallel::Beat&) {
    store.write(block, {6, small_rows(block * layout.block_size, layout.rows(block))});
    return parallel::Counts{};
  }));
  store.share(world());
  parallel::BlockLog next(path / "blocks", "small");  // what another run finds
  next.look(world());
  world().on_root([&] { next.find(); });
  EXPECT_EQ(next.begin(world()), todo);
  EXPECT_EQ(std::distance(fs::directory_iterator(path / "blocks"), {}), 1);

  SamplesHeader header = small_header();
  header.provenance.samples = layout.samples;
  write_samples(world(), path / "samples.h5", header, layout,
                [&](std::int64_t block) { return store.read(block).values; });
  EXPECT_FALSE(fs::exists(path / ".samples.h5.part"));

  const SampleReader reader(path / "samples.h5");
  EXPECT_EQ(reader.rows(), layout.samples);
  const std::int64_t first = 997 * world().rank();
  EXPECT_TRUE(same_bits(reader.read(first, 5000).values, small_rows(first, 5000)));
  EXPECT_TRUE(same_bits(reader.read(120000, 3457).values, small_rows(120000, 3457)));
  world().barrier();
  world().on_root([&] { parallel::remove_finished_blocks(store.folder()); });
}

TEST(Samples, FewerBlocksThanRanksAreWrittenToo) {
  const fs::path path = place(fmt::format("few_of_{}_ranks.h5", world().size()));
  const BlockLayout layout{3, 2};
  write_samples(world(), path, small_header(), layout, test::small_blocks(layout));
  EXPECT_TRUE(same_bits(SampleReader(path).read(0, 3).values, small_rows(0, 3)));
  world().barrier();
  world().on_root([&] { fs::remove(path); });
}

}  // namespace
}  // namespace freestand::io
