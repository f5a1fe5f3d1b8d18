// Blocks of samples by the time that they take.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <thread>

#include "base/durable_file.hpp"
#include "io/samples_file.hpp"
#include "parallel/finished_blocks.hpp"
#include "parallel/stop.hpp"
#include "study/block_size.hpp"
#include "study/evaluator.hpp"
#include "study/known.hpp"
#include "study/run_folder.hpp"
#include "study/study_text.hpp"
#include "study/sweep.hpp"
#include "support/error_text.hpp"
#include "support/scratch.hpp"

namespace freestand::study::block_time_test {
namespace {

namespace fs = std::filesystem;
using freestand::test::error_text;
using freestand::test::Scratch;

constexpr double no_time = 1e-9, for_ever = 1e9;  // s

Study study_of(const std::string& more) {
  return parse_study(test::block + test::friction + test::motions + test::fragility + more, "some.yaml", registries());
}

std::int64_t size_in(const fs::path& folder, const Study& study, double block_s) {
  fs::create_directories(blocks_path(folder));
  return samples_in_a_block({}, study, Evaluator(study, load_motions(study)), folder, block_s);
}

TEST(BlockTime, HalvesBlocksThatTakeLonger) {
  const std::string small = "samples: 1000\n";
  EXPECT_EQ(size_in(Scratch("long") / "a", study_of(small), for_ever), 256);
  EXPECT_EQ(size_in(Scratch("short") / "a", study_of(small), no_time), 8);
  EXPECT_EQ(size_in(Scratch("odd") / "a", study_of(small + "block_size: 100\n"), no_time), 25);
  EXPECT_EQ(size_in(Scratch("one") / "a", study_of(small + "block_size: 1\n"), no_time), 1);
}

// A sweep of dear samples can be stopped whatever its size: blocks are as small as the memory of their number allows, and what is too long is told.
TEST(BlockTime, IsBoundedByTheNumberOfBlocks) {
  EXPECT_EQ(size_in(Scratch("many") / "a", study_of("samples: 100000000\nkeep: none\n"), no_time), 8);
  EXPECT_EQ(size_in(Scratch("kept") / "a", study_of("samples: 100000000\nkeep: all\n"), no_time), 32);
  EXPECT_EQ(size_in(Scratch("most") / "a", study_of("samples: 10000000000\n"), no_time), 512);
  EXPECT_TRUE(few_enough_blocks(study_of("samples: 10000000000\nblock_size: 512\n"), 512));
}

TEST(BlockTime, IsDecidedOnceForAStudy) {
  const Scratch scratch("decided");
  const Study study = study_of("samples: 1000\n"), other = study_of("samples: 1000\nseed: 5\n");
  EXPECT_EQ(size_in(scratch.folder(), study, no_time), 8);
  EXPECT_EQ(size_in(scratch.folder(), study, for_ever), 8);
  EXPECT_EQ(size_in(scratch.folder(), other, for_ever), 256);
  parallel::remove_finished_blocks(blocks_path(scratch.folder()));
  EXPECT_FALSE(fs::exists(blocks_path(scratch.folder())));
}

// With blocks of 8 a sweep is stopped, and goes on with them; the samples are those of blocks of 256.
TEST(BlockTime, AStoppedSweepGoesOnWithItsBlocks) {
  const Scratch scratch("gone_on");
  const Study study = study_of("samples: 20000\n");
  const auto sweep_in = [&](const fs::path& path) {
    RunFolder folder({}, path, io::Existing::resume, "go on with --resume");
    sweep({}, study, {.quiet = true, .command = ""}, folder);
  };
  sweep_in(scratch / "whole");
  const fs::path parts = scratch / "parts", blocks = blocks_path(parts);
  EXPECT_EQ(size_in(parts, study, no_time), 8);
  {
    const std::jthread stops([&](const std::stop_token& over) {
      while (!over.stop_requested() && parallel::count_blocks(blocks) < 3) std::this_thread::yield();
      parallel::request_stop();
    });
    EXPECT_THAT(error_text(Exit::resumable, [&] { sweep_in(parts); }), testing::HasSubstr("go on with --resume"));
  }
  parallel::clear_stop();
  const std::string size = (blocks / "run-0000.node-000000.size").string(), decided = read_whole(size),
                    second = (blocks / "run-0000.node-000001.size").string();
  ASSERT_EQ(read_whole(second), decided);
  for (const std::string& copy : {size, second}) write_durably(copy, decided.substr(0, decided.size() / 2));
  EXPECT_THAT(error_text(Exit::usage, [&] { sweep_in(parts); }), testing::HasSubstr("--overwrite"));
  write_durably(second, decided);  // one copy stays damaged
  EXPECT_EQ(size_in(parts, study, no_time), 8);
  EXPECT_EQ(read_whole(size), decided);
  write_durably(size, "");
  sweep_in(parts);
  EXPECT_FALSE(fs::exists(blocks));
  const io::SampleReader one(samples_path(scratch / "whole")), other(samples_path(parts));
  const std::vector<double> a = one.read(0, one.rows()).values, b = other.read(0, other.rows()).values;
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)), 0);
}

}  // namespace
}  // namespace freestand::study::block_time_test
