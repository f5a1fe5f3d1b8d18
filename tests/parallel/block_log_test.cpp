#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <freestand/error.hpp>
#include <fstream>

#include "base/durable_file.hpp"
#include "parallel/finished_blocks.hpp"
#include "support/error_text.hpp"
#include "support/scratch.hpp"
#include "support/trouble.hpp"

namespace freestand::parallel {
namespace {

namespace fs = std::filesystem;
using Blocks = std::vector<std::int64_t>;
using test::error_text;
using testing::HasSubstr;

BlockRows rows_of(std::int64_t columns, std::vector<double> values) { return {columns, std::move(values)}; }

std::vector<fs::path> logs(const fs::path& folder) {
  std::vector<fs::path> logs;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".log") logs.push_back(entry.path());
  std::sort(logs.begin(), logs.end());
  return logs;
}

class BlockLogTest : public testing::Test {
 protected:
  static BlockLog log(const fs::path& folder, std::uint32_t kernel = 0) { return {folder, "abc", kernel}; }

  // What a run finds that begins now.
  Blocks found() const { return found(scratch_.folder()); }
  static Blocks found(const fs::path& folder) {
    BlockLog next = log(folder);
    next.find();
    return next.begin({});
  }

  // A run that writes these blocks, each with its number as the only value.
  void run(const Blocks& blocks) const {
    BlockLog one = begun();
    for (const std::int64_t block : blocks) one.write(block, rows_of(1, {static_cast<double>(block)}));
  }
  BlockLog begun() const {
    BlockLog one = log(scratch_.folder());
    one.find();
    one.begin({});
    return one;
  }

  void replace(const fs::path& path, const std::string& bytes) const { std::ofstream(path, std::ios::binary) << bytes; }

  test::Scratch scratch_{"log"};
};

// Blocks of many pages, of one and of a part: a header is found from any place of the log, once.
TEST_F(BlockLogTest, IsLookedThroughInPartsOfAnySize) {
  BlockLog one = begun();
  const std::vector<std::size_t> lengths{1, 3000, 497, 498, 20000, 2, 511};  // 497 values and their header fill a page
  for (std::size_t i = 0; i < lengths.size(); ++i)
    one.write(static_cast<std::int64_t>(i), rows_of(1, std::vector<double>(lengths[i], 0.1)));
  one.share({});
  for (const std::int64_t part : {1, 4096, 8192, 40960, 1 << 28}) {
    BlockLog next(scratch_.folder(), "abc", 0, part);
    next.find();
    EXPECT_EQ(next.begin({}), (Blocks{0, 1, 2, 3, 4, 5, 6})) << part;
    for (std::size_t i = 0; i < lengths.size(); ++i)
      EXPECT_EQ(next.read(static_cast<std::int64_t>(i)).values.size(), lengths[i]) << part;
  }
}

TEST_F(BlockLogTest, ABlockComesBackToTheBit) {
  BlockLog store = log(scratch_ / "deep" / "blocks");
  store.begin({});
  const BlockRows rows = rows_of(3, {0.1, -0.0, 1e-310, NAN, INFINITY, -1e308});
  store.write(7, rows);
  store.share({});
  const BlockRows back = store.read(7);
  EXPECT_EQ(back.columns, 3);
  EXPECT_EQ(back.rows(), 2);
  ASSERT_EQ(back.values.size(), rows.values.size());
  EXPECT_EQ(std::memcmp(back.values.data(), rows.values.data(), rows.values.size() * sizeof(double)), 0);
}

TEST_F(BlockLogTest, OneFileARunHoweverManyBlocks) {
  Blocks many(300);
  for (std::size_t i = 0; i < many.size(); ++i) many[i] = static_cast<std::int64_t>(many.size() - i);
  run(many);
  run({1000, 2000});
  run({});
  std::reverse(many.begin(), many.end());
  many.insert(many.end(), {1000, 2000});
  EXPECT_EQ(found(), many);
  EXPECT_EQ(logs(scratch_.folder()).size(), 2u);
  EXPECT_EQ(count_blocks(scratch_.folder()), 302);
}

TEST_F(BlockLogTest, FilesOfOthersAreLeftAlone) {
  run({12, 3, 100000000, 0});
  replace(scratch_ / "notes.txt", "mine");
  replace(scratch_ / "run-0009.node-000000.log.bak", "mine too");
  EXPECT_EQ(found(), (Blocks{0, 3, 12, 100000000}));
  remove_finished_blocks(scratch_.folder());
  EXPECT_TRUE(logs(scratch_.folder()).empty());
  EXPECT_TRUE(fs::exists(scratch_ / "notes.txt") && fs::exists(scratch_ / "run-0009.node-000000.log.bak"));
}

TEST_F(BlockLogTest, OfABlockThatIsWrittenAgainTheLastCounts) {
  for (const double value : {1.0, 2.0, 3.0}) {
    BlockLog store = begun();
    store.write(1, rows_of(1, {-value}));
    store.write(1, rows_of(1, {value}));
    store.share({});
    EXPECT_EQ(store.read(1).values, std::vector<double>{value});
  }
  BlockLog last = begun();
  EXPECT_EQ(last.read(1).values, std::vector<double>{3});
}

// The end of the machine may leave any part of what was written last.
TEST_F(BlockLogTest, ALogThatIsTornAnywhereKeepsWhatLiesBefore) {
  run({5, 6});
  const fs::path path = logs(scratch_.folder()).front();
  const std::string whole = read_whole(path);
  ASSERT_EQ(whole.size(), 4096u + 128u);
  for (std::size_t length = 0; length < whole.size(); length += length < 200 || length > 4000 ? 1 : 100) {
    replace(path, whole.substr(0, length));
    EXPECT_EQ(found(), length < 128 ? Blocks{} : Blocks{5}) << length;
  }
}

TEST_F(BlockLogTest, AnyChangedByteCostsThatBlockOnly) {
  run({5, 6, 7});
  const fs::path path = logs(scratch_.folder()).front();
  const std::string whole = read_whole(path);
  for (std::size_t i = 4096; i < 4096 + 128; ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    replace(path, damaged);
    EXPECT_EQ(found(), (Blocks{5, 7})) << i;
  }
}

// A rank that was killed has taken its place and not filled it.
TEST_F(BlockLogTest, AGapIsSteppedOver) {
  run({5, 6});
  const fs::path path = logs(scratch_.folder()).front();
  const std::string whole = read_whole(path);
  std::string gap(5 * 4096, '\0');
  replace(path, whole.substr(0, 4096) + gap + whole.substr(4096));
  EXPECT_EQ(found(), (Blocks{5, 6}));
  gap.replace(0, 60, whole, 0, 60);  // half a header
  replace(path, gap + whole);
  EXPECT_EQ(found(), (Blocks{5, 6}));
}

// A header that was damaged, and a block that was cut short: what was there is computed again, and that is told.
TEST_F(BlockLogTest, WhatIsTornIsTold) {
  run({5, 6, 7});
  const fs::path path = logs(scratch_.folder()).front();
  const std::string whole = read_whole(path);
  const auto told = [&](const std::string& bytes) {
    replace(path, bytes);
    testing::internal::CaptureStderr();
    begun();
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(told(whole), "");
  std::string damaged = whole;
  damaged[4096 + 24] ^= 0x10;
  EXPECT_NE(told(damaged).find("1 place in the logs of"), std::string::npos);
  EXPECT_NE(told(whole.substr(0, 2 * 4096 + 20)).find("holds no whole block"), std::string::npos);
}

TEST_F(BlockLogTest, ABlockThatIsDamagedBehindOursIsToldWhenItIsRead) {
  BlockLog store = begun();
  store.write(2, rows_of(1, {1, 2}));
  store.share({});
  const fs::path path = logs(scratch_.folder()).front();
  std::string bytes = read_whole(path);
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  replace(path, bytes);
  EXPECT_THAT(error_text(Exit::data, [&] { store.read(2); }),
              testing::AllOf(HasSubstr("block 2 of"), HasSubstr(path.string()), HasSubstr("torn or damaged")));
  fs::remove(path);
  EXPECT_THAT(error_text(Exit::data, [&] { store.read(2); }), HasSubstr("the file cannot be read"));
  EXPECT_THAT(error_text(Exit::data, [&] { store.read(4); }),
              testing::AllOf(HasSubstr("block 4"), HasSubstr("it is not there")));
}

TEST_F(BlockLogTest, AnotherStudysBlocksAreRefused) {
  run({0});
  BlockLog second(scratch_.folder(), "second");
  EXPECT_THAT(error_text(Exit::usage, [&] { second.find(); }),
              testing::AllOf(HasSubstr("another study"), HasSubstr("abc"), HasSubstr("choose another output folder")));
}

TEST_F(BlockLogTest, AnotherKernelsBlocksAreRefused) {
  BlockLog first = log(scratch_.folder(), 7);
  first.begin({});
  first.write(0, rows_of(1, {1}));
  EXPECT_THAT(error_text(Exit::usage, [&] { log(scratch_.folder(), 8).find(); }),
              testing::AllOf(HasSubstr("another version of freestand"), HasSubstr("00000007"), HasSubstr("00000008")));
}

// A link to itself cannot be read, not even by root.
TEST_F(BlockLogTest, ALogThatCannotBeReadDoesNotCount) {
  run({0, 1});
  fs::create_symlink("run-0004.node-000000.log", scratch_ / "run-0004.node-000000.log");
  EXPECT_EQ(found(), (Blocks{0, 1}));
  run({2});  // into a log behind it
  EXPECT_EQ(found(), (Blocks{0, 1, 2}));
}

TEST_F(BlockLogTest, FingerprintsOfUnusableLengthAreRefused) {
  EXPECT_THROW(BlockLog(scratch_.folder(), ""), Error);
  EXPECT_THROW(BlockLog(scratch_.folder(), std::string(65, 'x')), Error);
  BlockLog longest(scratch_.folder(), std::string(64, 'x'));
  longest.begin({});
  longest.write(0, rows_of(1, {1}));
  longest.find();
  EXPECT_EQ(longest.begin({}), Blocks{0});
}

TEST_F(BlockLogTest, AWriteThatStopsInTheMiddleCostsItsBlockOnly) {
  BlockLog store = begun();
  store.write(0, rows_of(1, {1}));
  const auto told =
      test::with_file_size_limit(10000, [&] { store.write(1, rows_of(1, std::vector<double>(5000, 2.0))); });
  EXPECT_EQ(told.exit, 74);
  EXPECT_THAT(told.text, testing::AllOf(HasSubstr("cannot write"), HasSubstr(".log"), HasSubstr("ulimit")));
  EXPECT_EQ(found(), Blocks{0});
}

TEST_F(BlockLogTest, AFullDiskHasToBeCured) {
  const test::SmallDisk disk(scratch_ / "disk", "64k");
  if (!disk.mounted()) GTEST_SKIP() << "no right to mount a small file system here";
  BlockLog store = log(disk.folder());
  store.begin({});
  store.write(0, rows_of(1, std::vector<double>(1000, 1.0)));
  const std::string text = error_text(Exit::cure, [&] { store.write(1, rows_of(1, std::vector<double>(20000, 1.0))); });
  EXPECT_THAT(text, testing::AllOf(HasSubstr("No space left"), HasSubstr("free some space")));
  EXPECT_EQ(found(disk.folder()), Blocks{0});
}

TEST_F(BlockLogTest, NoWritePermissionSaysWhatToDo) {
  BlockLog store = log(scratch_ / "blocks");
  const auto told = test::without_rights(store.folder(), [&] { store.write(0, rows_of(1, {1})); });
  EXPECT_EQ(told.exit, 2);
  EXPECT_THAT(told.text, testing::AllOf(HasSubstr("Permission denied"), HasSubstr("choose a folder")));
  const auto folder = test::without_rights(scratch_.folder(), [&] { log(scratch_ / "new"); });
  EXPECT_EQ(folder.exit, 2);
  EXPECT_THAT(folder.text, HasSubstr("cannot make folder"));
}

// The process is killed at random moments while it writes; what is found is whole, and no run loses what another has finished.
TEST_F(BlockLogTest, KilledAtAnyMomentLosesTheOpenBlockOnly) {
  Blocks before;
  for (int round = 0; round < 12; ++round) {
    const pid_t child = ::fork();
    if (child == 0) {
      BlockLog store = begun();
      for (std::int64_t block = 100 * round;; ++block) store.write(block, rows_of(4, std::vector<double>(8000, 0.5)));
    }
    ::usleep(static_cast<useconds_t>(3000 + 1700 * round));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const Blocks now = found();
    EXPECT_TRUE(std::includes(now.begin(), now.end(), before.begin(), before.end()));
    before = now;
  }
  EXPECT_FALSE(before.empty());
}

}  // namespace
}  // namespace freestand::parallel
