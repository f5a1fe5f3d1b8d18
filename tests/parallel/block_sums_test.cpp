#include "parallel/block_sums.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <freestand/error.hpp>
#include <fstream>
#include <thread>

#include "base/durable_file.hpp"
#include "parallel/finished_blocks.hpp"
#include "support/error_text.hpp"
#include "support/scratch.hpp"

namespace freestand::parallel {
namespace {

namespace fs = std::filesystem;
using test::error_text;
using testing::HasSubstr;

constexpr std::int64_t blocks = 130;

class BlockSumsTest : public testing::Test {
 protected:
  BlockSums sums(const std::string& fingerprint = "abc", std::uint32_t kernel = 0) const {
    return {scratch_.folder(), fingerprint, kernel, blocks, 3};
  }
  BlockSums begun() const {
    BlockSums one = sums();
    one.find();
    one.begin({});
    return one;
  }
  std::vector<std::int64_t> found() const {
    const BlockSums next = begun();
    std::vector<std::int64_t> there;
    for (std::int64_t block = 0; block < blocks; ++block)
      if (next.has(block)) there.push_back(block);
    return there;
  }
  std::vector<RunFile> files() const { return run_files(scratch_.folder(), "sums"); }

  test::Scratch scratch_;
};

void add(BlockSums& sums, const Words& of_blocks, const Words& words) { sums.add(of_blocks, words); }

TEST_F(BlockSumsTest, BeginEmpty) {
  BlockSums one = begun();
  EXPECT_FALSE(one.has(0));
  EXPECT_EQ(one.total({}), (Words{0, 0, 0}));
}

TEST_F(BlockSumsTest, BlocksAndSumsOfAllRunsBelongTogether) {
  BlockSums one = begun();
  add(one, {0, 64}, {1, -2, 3});
  add(one, {129}, {10, 20, 30});
  one.write({});
  EXPECT_EQ(one.total({}), (Words{11, 18, 33}));

  BlockSums two = begun();
  EXPECT_TRUE(two.has(0) && two.has(64) && two.has(129));
  EXPECT_FALSE(two.has(1) || two.has(128));
  add(two, {1}, {100, 0, 0});
  two.write({});
  EXPECT_EQ(begun().total({}), (Words{111, 18, 33}));
  EXPECT_EQ(files().size(), 1U);  // of the last run alone
  EXPECT_EQ(count_summed_blocks(scratch_.folder()), 4);
}

// What was not written yet is gone with the program, blocks and sums together.
TEST_F(BlockSumsTest, WhatWasAddedSinceTheLastWritingIsLostAsAWhole) {
  {
    BlockSums one = begun();
    add(one, {5}, {1, 1, 1});
    one.write({});
    add(one, {6}, {1, 1, 1});
  }
  EXPECT_EQ(found(), (std::vector<std::int64_t>{5}));
  EXPECT_EQ(begun().total({}), (Words{1, 1, 1}));
}

// A run that died before it had taken over what was there leaves the files of the run before, which count; later their
// leftovers count no more.
TEST_F(BlockSumsTest, OfTwoRunsOnlyOneCounts) {
  BlockSums one = begun();
  add(one, {5}, {1, 1, 1});
  one.write({});
  const fs::path old = files().front().path;
  const std::string content = read_whole(old);
  BlockSums two = begun();                          // has taken over
  std::ofstream(old, std::ios::binary) << content;  // and died before it removed this
  EXPECT_EQ(begun().total({}), (Words{1, 1, 1}));
  EXPECT_EQ(count_summed_blocks(scratch_.folder()), 1);
}

TEST_F(BlockSumsTest, WhatDeathLeftOfAFileGoesWithTheNextRun) {
  const fs::path aside = aside_name(run_file(scratch_.folder() / "blocks", 1, 0, "sums"));
  for (const bool at_the_end : {false, true}) {
    BlockSums one(scratch_.folder() / "blocks", "abc", 0, blocks, 3);
    std::ofstream(aside) << "torn";
    if (at_the_end)
      remove_finished_blocks(scratch_.folder() / "blocks");
    else
      one.find();
    EXPECT_FALSE(fs::exists(aside)) << at_the_end;
  }
  EXPECT_FALSE(fs::exists(scratch_.folder() / "blocks"));
}

TEST_F(BlockSumsTest, OtherNodesOfTheLastRunCount) {
  BlockSums one = begun();
  add(one, {5}, {1, 1, 1});
  one.write({});
  BlockSums other(scratch_.folder() / "elsewhere", "abc", 0, blocks, 3);
  other.find();
  other.begin({});
  add(other, {7}, {10, 10, 10});
  other.write({});
  fs::copy_file(run_files(scratch_.folder() / "elsewhere", "sums").front().path,
                run_file(scratch_.folder(), files().front().run, 4, "sums"));
  EXPECT_EQ(found(), (std::vector<std::int64_t>{5, 7}));
  EXPECT_EQ(begun().total({}), (Words{11, 11, 11}));
}

TEST_F(BlockSumsTest, ADamagedFileCountsForNothing) {
  BlockSums one = begun();
  add(one, {5}, {1, 1, 1});
  one.write({});
  const fs::path path = files().front().path;
  const std::string whole = read_whole(path);
  for (std::size_t at = 0; at < whole.size(); at += 7) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    remove_finished_blocks(scratch_.folder());
    fs::create_directories(scratch_.folder());
    std::ofstream(path, std::ios::binary) << damaged;
    EXPECT_EQ(count_summed_blocks(scratch_.folder()), 0) << at;
    EXPECT_TRUE(found().empty()) << at;
  }
  for (const std::size_t length : {std::size_t{0}, std::size_t{50}, whole.size() - 1}) {
    remove_finished_blocks(scratch_.folder());
    fs::create_directories(scratch_.folder());
    std::ofstream(path, std::ios::binary) << whole.substr(0, length);
    EXPECT_TRUE(found().empty()) << length;
  }
}

TEST_F(BlockSumsTest, AnotherStudyOrProgramIsRefused) {
  BlockSums one = begun();
  add(one, {5}, {1, 1, 1});
  one.write({});
  EXPECT_THROW(sums("other").find(), OtherBlocks);
  BlockSums program = sums("abc", 7);
  EXPECT_THAT(error_text(Exit::usage, [&] { program.find(); }), HasSubstr("another version of freestand"));
}

TEST_F(BlockSumsTest, AFileIsWrittenWithoutBeingAskedFor) {
  BlockSums one = begun();
  add(one, {1}, {1, 0, 0});
  EXPECT_EQ(count_summed_blocks(scratch_.folder()), 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  add(one, {2}, {1, 0, 0});
  EXPECT_EQ(count_summed_blocks(scratch_.folder()), 2);
}

}  // namespace
}  // namespace freestand::parallel
