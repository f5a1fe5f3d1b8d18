#include "parallel/checkpoint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <freestand/error.hpp>
#include <fstream>

#include "base/durable_file.hpp"
#include "support/error_text.hpp"
#include "support/scratch.hpp"
#include "support/trouble.hpp"

namespace freestand::parallel {
namespace {

namespace fs = std::filesystem;
using Blocks = std::vector<std::int64_t>;
using test::error_text;
using testing::HasSubstr;
using testing::Not;

BlockRows rows_of(std::int64_t columns, std::vector<double> values) { return {columns, std::move(values)}; }

std::vector<std::string> file_names(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

TEST(BlockStore, ABlockComesBackToTheBit) {
  const test::Scratch scratch("store");
  const BlockStore store(scratch / "deep" / "blocks", "abc");
  const BlockRows rows = rows_of(3, {0.1, -0.0, 1e-310, NAN, INFINITY, -1e308});
  store.write(7, rows);
  const BlockRows back = store.read(7);
  EXPECT_EQ(back.columns, 3);
  EXPECT_EQ(back.rows(), 2);
  ASSERT_EQ(back.values.size(), rows.values.size());
  EXPECT_EQ(std::memcmp(back.values.data(), rows.values.data(), rows.values.size() * sizeof(double)), 0);
}

TEST(BlockStore, ListsWhatIsFinishedAndNothingElse) {
  const test::Scratch scratch("store");
  const BlockStore store(scratch.folder(), "abc");
  EXPECT_EQ(store.finished(), Blocks{});
  for (const std::int64_t block : {12, 3, 100000000, 0}) store.write(block, rows_of(1, {1}));
  std::ofstream(scratch / "notes.txt") << "mine";
  std::ofstream(scratch / "block-00000005.bin") << "torn";
  std::ofstream(scratch / ".block-00000006.bin.host.1.part") << "half";
  EXPECT_EQ(store.finished(), (Blocks{0, 3, 12, 100000000}));
}

TEST(BlockStore, ABlockWrittenAgainIsReplaced) {
  const test::Scratch scratch("store");
  const BlockStore store(scratch.folder(), "abc");
  store.write(1, rows_of(1, {1, 2}));
  store.write(1, rows_of(1, {3}));
  EXPECT_EQ(store.read(1).values, std::vector<double>{3});
  EXPECT_EQ(file_names(scratch.folder()).size(), 1u);
}

TEST(BlockStore, ATornFileAtAnyLengthDoesNotCount) {
  const test::Scratch scratch("store");
  const BlockStore store(scratch.folder(), "abc");
  store.write(0, rows_of(2, {1, 2, 3, 4}));
  const std::string whole = read_whole(store.file(0));
  for (std::size_t length = 0; length < whole.size(); ++length) {
    std::ofstream(store.file(0), std::ios::binary) << whole.substr(0, length);
    EXPECT_EQ(store.finished(), Blocks{}) << length;
  }
  std::ofstream(store.file(0), std::ios::binary) << whole << "x";
  EXPECT_EQ(store.finished(), Blocks{});
  EXPECT_THAT(error_text(Exit::data, [&] { store.read(0); }), HasSubstr("torn or damaged"));
}

TEST(BlockStore, AnyChangedByteIsNoticed) {
  const test::Scratch scratch("store");
  const BlockStore store(scratch.folder(), "abc");
  store.write(0, rows_of(2, {1, 2, 3, 4}));
  const std::string whole = read_whole(store.file(0));
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    std::ofstream(store.file(0), std::ios::binary) << damaged;
    EXPECT_EQ(store.finished(), Blocks{}) << i;
  }
}

TEST(BlockStore, AFileUnderAnotherBlocksNameDoesNotCount) {
  const test::Scratch scratch("store");
  const BlockStore store(scratch.folder(), "abc");
  store.write(0, rows_of(1, {1}));
  fs::rename(store.file(0), store.file(1));
  EXPECT_EQ(store.finished(), Blocks{});
  EXPECT_THROW(store.read(1), Error);
}

TEST(BlockStore, AnotherStudysBlocksAreRefused) {
  const test::Scratch scratch("store");
  BlockStore(scratch.folder(), "first").write(0, rows_of(1, {1}));
  const BlockStore second(scratch.folder(), "second");
  EXPECT_THAT(
      error_text(Exit::usage, [&] { second.finished(); }),
      testing::AllOf(HasSubstr("another study"), HasSubstr("first"), HasSubstr("choose another output folder")));
  EXPECT_THAT(error_text(Exit::data, [&] { second.read(0); }), HasSubstr("another study"));
}

TEST(BlockStore, AnotherKernelsBlocksAreRefused) {
  const test::Scratch scratch("store");
  BlockStore(scratch.folder(), "abc", 7).write(0, rows_of(1, {1}));
  const BlockStore second(scratch.folder(), "abc", 8);
  EXPECT_THAT(error_text(Exit::usage, [&] { second.finished(); }),
              testing::AllOf(HasSubstr("another version of freestand"), HasSubstr("00000007"), HasSubstr("00000008")));
  EXPECT_THAT(error_text(Exit::data, [&] { second.read(0); }), HasSubstr("another version"));
  EXPECT_EQ(BlockStore(scratch.folder(), "abc", 7).finished(), Blocks{0});
}

// A link to itself cannot be read, not even by root.
TEST(BlockStore, AFileThatCannotBeReadDoesNotCountAndIsReplaced) {
  const test::Scratch scratch("store");
  const BlockStore store(scratch.folder(), "abc");
  store.write(0, rows_of(1, {1}));
  fs::create_symlink(store.file(1).filename(), store.file(1));
  EXPECT_EQ(store.finished(), Blocks{0});
  EXPECT_THAT(error_text(Exit::data, [&] { store.read(1); }), HasSubstr("block-00000001.bin"));
  store.write(1, rows_of(1, {2}));
  EXPECT_EQ(store.finished(), (Blocks{0, 1}));
}

TEST(BlockStore, AMissingBlockNamesItsFile) {
  const test::Scratch scratch("store");
  const BlockStore store(scratch.folder(), "abc");
  EXPECT_THAT(error_text(Exit::data, [&] { store.read(4); }), HasSubstr("block-00000004.bin"));
}

TEST(BlockStore, FingerprintsOfUnusableLengthAreRefused) {
  const test::Scratch scratch("store");
  EXPECT_THROW(BlockStore(scratch.folder(), ""), Error);
  EXPECT_THROW(BlockStore(scratch.folder(), std::string(65, 'x')), Error);
  const BlockStore longest(scratch.folder(), std::string(64, 'x'));
  longest.write(0, rows_of(1, {1}));
  EXPECT_EQ(longest.finished(), Blocks{0});
}

TEST(BlockStore, LeftoversAndBlocksCanBeRemovedButNothingElse) {
  const test::Scratch scratch("store");
  const BlockStore store(scratch.folder(), "abc");
  store.write(0, rows_of(1, {1}));
  std::ofstream(scratch / ".block-00000006.bin.host.1.part") << "half";
  std::ofstream(scratch / "notes.txt") << "mine";
  store.remove_leftovers();
  EXPECT_EQ(file_names(scratch.folder()), (std::vector<std::string>{"block-00000000.bin", "notes.txt"}));
  store.clear();
  EXPECT_EQ(file_names(scratch.folder()), std::vector<std::string>{"notes.txt"});
}

TEST(BlockStore, AWriteThatStopsInTheMiddleLeavesNothing) {
  const test::Scratch scratch("store");
  const BlockStore store(scratch.folder(), "abc");
  store.write(0, rows_of(1, {1}));
  const auto told =
      test::with_file_size_limit(10000, [&] { store.write(0, rows_of(1, std::vector<double>(5000, 2.0))); });
  EXPECT_EQ(told.exit, 74);
  EXPECT_THAT(told.text,
              testing::AllOf(HasSubstr("cannot write"), HasSubstr("block-00000000.bin"), HasSubstr("ulimit")));
  EXPECT_EQ(store.read(0).values, std::vector<double>{1});
  EXPECT_EQ(file_names(scratch.folder()).size(), 1u);
}

TEST(BlockStore, AFullDiskHasToBeCured) {
  const test::Scratch scratch("store");
  const test::SmallDisk disk(scratch / "disk", "64k");
  if (!disk.mounted()) GTEST_SKIP() << "no right to mount a small file system here";
  const BlockStore store(disk.folder(), "abc");
  store.write(0, rows_of(1, std::vector<double>(1000, 1.0)));
  const std::string text =
      error_text(Exit::cure, [&] { store.write(1, rows_of(1, std::vector<double>(20000, 1.0))); });
  EXPECT_THAT(text, testing::AllOf(HasSubstr("No space left"), HasSubstr("free some space")));
  EXPECT_EQ(store.finished(), Blocks{0});
  EXPECT_EQ(file_names(disk.folder()).size(), 1u);
}

TEST(BlockStore, NoWritePermissionSaysWhatToDo) {
  const test::Scratch scratch("store");
  const BlockStore store(scratch / "blocks", "abc");
  const auto told = test::without_rights(store.folder(), [&] { store.write(0, rows_of(1, {1})); });
  EXPECT_EQ(told.exit, 2);
  EXPECT_THAT(told.text, testing::AllOf(HasSubstr("Permission denied"), HasSubstr("choose a folder")));
  const auto folder = test::without_rights(scratch.folder(), [&] { BlockStore(scratch / "new", "abc"); });
  EXPECT_EQ(folder.exit, 2);
  EXPECT_THAT(folder.text, HasSubstr("cannot make folder"));
}

// The process is killed at random moments while it writes; what has its name is whole.
TEST(BlockStore, KilledAtAnyMomentLeavesOnlyWholeBlocks) {
  const test::Scratch scratch("store");
  const BlockStore store(scratch.folder(), "abc");
  for (int round = 0; round < 12; ++round) {
    const pid_t child = ::fork();
    if (child == 0) {
      for (std::int64_t block = 0;; ++block) store.write(block % 8, rows_of(4, std::vector<double>(8000, 0.5)));
    }
    ::usleep(static_cast<useconds_t>(3000 + 1700 * round));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const Blocks blocks = store.finished();
    std::size_t under_its_name = 0;
    for (const std::string& name : file_names(scratch.folder())) under_its_name += name.starts_with("block-");
    EXPECT_EQ(blocks.size(), under_its_name);
    store.remove_leftovers();
    EXPECT_EQ(file_names(scratch.folder()).size(), blocks.size());
  }
  EXPECT_FALSE(store.finished().empty());
}

}  // namespace
}  // namespace freestand::parallel
