#include "parallel/schedule.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <thread>

#include "mpi/mpi_main.hpp"
#include "parallel/stop.hpp"

namespace freestand::parallel {
namespace {

using std::chrono::milliseconds;
using test::world;

// What each rank did, on every rank: times[block] = how often, by_rank[rank] = how many blocks.
struct Shares {
  Words times, by_rank;
};

Shares shares(const Words& mine, std::int64_t blocks) {
  Shares all{Words(static_cast<std::size_t>(blocks)), Words(static_cast<std::size_t>(world().size()))};
  for (const std::int64_t block : mine) ++all.times[static_cast<std::size_t>(block)];
  all.by_rank[static_cast<std::size_t>(world().rank())] = static_cast<std::int64_t>(mine.size());
  world().sum_in_place(all.times);
  world().sum_in_place(all.by_rank);
  return all;
}

TEST(Schedule, EachBlockOfTheListIsDoneExactlyOnce) {
  for (const std::int64_t blocks : {0, 1, 7, 1000}) {
    Words todo;
    for (std::int64_t block = 0; block < blocks; ++block)
      if (block % 3 != 1) todo.push_back(block);
    Words mine;
    const bool complete = for_each_block(world(), todo, [&](std::int64_t block, const Beat& beat) {
      mine.push_back(block);
      beat();
      return Counts{10, 1, 0};
    });
    EXPECT_TRUE(complete);
    EXPECT_TRUE(std::is_sorted(mine.begin(), mine.end()));
    const Shares all = shares(mine, blocks);
    for (std::int64_t block = 0; block < blocks; ++block)
      EXPECT_EQ(all.times[static_cast<std::size_t>(block)], block % 3 != 1 ? 1 : 0) << block;
  }
}

// Rank 0 is lost in one long block that never calls the beat; the others do all the rest in the meantime.
TEST(Schedule, OthersGoOnWhileTheRootComputes) {
  if (world().size() == 1) GTEST_SKIP() << "needs more than one rank";
  Words todo(61);
  std::iota(todo.begin(), todo.end(), 0);
  std::int64_t mine = 0;
  world().barrier();
  const auto start = std::chrono::steady_clock::now();
  auto last = start;
  for_each_block(world(), todo, [&](std::int64_t, const Beat&) {
    std::this_thread::sleep_for(milliseconds(world().is_root() ? 4000 : 1));
    ++mine;
    last = std::chrono::steady_clock::now();
    return Counts{1, 0, 0};
  });
  Words by_rank(static_cast<std::size_t>(world().size()));
  by_rank[static_cast<std::size_t>(world().rank())] = mine;
  world().sum_in_place(by_rank);
  EXPECT_LE(by_rank[0], 1);
  EXPECT_EQ(std::accumulate(by_rank.begin(), by_rank.end(), std::int64_t{0}), 61);
  if (!world().is_root()) {
    EXPECT_LT(last - start, milliseconds(3900));
  }
}

// The same where the window needs the root's help: it calls the beat.
TEST(Schedule, OthersGoOnWhileTheRootBeats) {
  if (world().size() == 1) GTEST_SKIP() << "needs more than one rank";
  Words todo(61);
  std::iota(todo.begin(), todo.end(), 0);
  Words mine;
  for_each_block(world(), todo, [&](std::int64_t block, const Beat& beat) {
    for (int i = 0; i < (world().is_root() ? 800 : 1); ++i) {
      std::this_thread::sleep_for(milliseconds(1));
      beat();
    }
    mine.push_back(block);
    return Counts{1, 0, 0};
  });
  const Shares all = shares(mine, 61);
  EXPECT_LE(all.by_rank.front(), 2);
  EXPECT_EQ(std::count(all.times.begin(), all.times.end(), 1), 61);
}

TEST(Schedule, AFasterRankTakesMoreBlocks) {
  if (world().size() == 1) GTEST_SKIP() << "needs more than one rank";
  Words todo(60);
  std::iota(todo.begin(), todo.end(), 0);
  const bool slow = world().rank() == world().size() - 1;
  Words mine;
  for_each_block(world(), todo, [&](std::int64_t block, const Beat& beat) {
    for (int i = 0; i < (slow ? 60 : 3); ++i) {
      std::this_thread::sleep_for(milliseconds(1));
      beat();
    }
    mine.push_back(block);
    return Counts{1, 0, 0};
  });
  const Shares all = shares(mine, 60);
  EXPECT_LT(all.by_rank.back(), all.by_rank.front() / 2);
}

TEST(Schedule, AStopOnOneRankStopsAllAfterTheirOpenBlocks) {
  Words todo(10000);
  std::iota(todo.begin(), todo.end(), 0);
  Words mine;
  const bool complete = for_each_block(world(), todo, [&](std::int64_t block, const Beat&) {
    std::this_thread::sleep_for(milliseconds(1));
    mine.push_back(block);
    if (world().rank() == world().size() - 1 && mine.size() == 5) request_stop();
    return Counts{1, 0, 0};
  });
  clear_stop();
  EXPECT_FALSE(complete);
  const Shares all = shares(mine, 10000);
  const std::int64_t done = std::accumulate(all.times.begin(), all.times.end(), std::int64_t{0});
  EXPECT_GE(done, 5);
  EXPECT_LT(done, 5000);
  // What was handed out was done: the finished blocks are the first ones of the list.
  for (std::int64_t block = 0; block < done; ++block) EXPECT_EQ(all.times[static_cast<std::size_t>(block)], 1);
}

TEST(Schedule, ProgressSeesTheCountsOfAllRanks) {
  std::FILE* stream = std::tmpfile();
  Progress::Settings settings;
  settings.stream = stream;
  settings.terminal = false;
  Progress progress(3000, 1000, settings);
  Words todo(200);
  std::iota(todo.begin(), todo.end(), 0);
  for_each_block(
      world(), todo,
      [](std::int64_t, const Beat&) {
        return Counts{10, 2, 1};
      },
      &progress);
  if (world().is_root()) {
    std::rewind(stream);
    char line[300] = {};
    ASSERT_NE(std::fgets(line, sizeof line, stream), nullptr);
    EXPECT_NE(std::string(line).find("3,000/3,000 samples (100.0 %)"), std::string::npos) << line;
    EXPECT_NE(std::string(line).find("20.0 % overturned, 200 failed"), std::string::npos) << line;
  }
  std::fclose(stream);
}

}  // namespace
}  // namespace freestand::parallel
