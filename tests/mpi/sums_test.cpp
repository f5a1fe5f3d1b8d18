#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mpi/mpi_main.hpp"
#include "parallel/block_sums.hpp"
#include "parallel/finished_blocks.hpp"
#include "parallel/node_memory.hpp"
#include "parallel/schedule.hpp"

namespace freestand::parallel {
namespace {

namespace fs = std::filesystem;
using test::world;

// Between the reading and the writing of a number no other rank comes, though both take long.
TEST(NodeMemory, TheLockLetsOneRankInAtATime) {
  NodeMemory memory(world(), 2);
  constexpr std::int64_t times = 2000;
  for (std::int64_t i = 0; i < times; ++i) {
    const NodeMemory::Lock lock(memory);
    volatile std::int64_t* const number = memory.numbers().data();
    const std::int64_t before = number[0];
    for (int wait = 0; wait < 100; ++wait) number[1] = wait;
    number[0] = before + 1;
  }
  world().barrier();
  Words all{world().rank() == memory.node() ? memory.numbers()[0] : 0};
  world().sum_in_place(all);
  EXPECT_EQ(all, Words{times * world().size()});
}

// Whoever counts a block, and in however many runs: the sums are those of all blocks, each once.
TEST(BlockSums, OfAllRanksAndRunsAreThoseOfAllBlocks) {
  const fs::path folder = fmt::format("sums_of_{}_ranks", world().size());
  world().on_root([&] { fs::remove_all(folder); });
  constexpr std::int64_t blocks = 3000;
  const auto words_of = [](std::int64_t block) { return Words{1, block, block * block, -block}; };
  Words expected(4);
  for (std::int64_t run = 1; run <= 3; ++run) {
    BlockSums sums(folder, "abc", 0, blocks, 4);
    world().on_root([&] { sums.find(); });
    sums.begin(world());
    Words todo;
    for (std::int64_t block = 0; block < run * blocks / 3; ++block)
      if (!sums.has(block)) todo.push_back(block);
    EXPECT_EQ(todo.size(), static_cast<std::size_t>(blocks / 3));
    ASSERT_TRUE(for_each_block(world(), todo, [&](std::int64_t block, const Beat&) {
      sums.add(Words{block}, words_of(block));
      return Counts{};
    }));
    for (const std::int64_t block : todo)
      for (std::size_t i = 0; i < 4; ++i) expected[i] += words_of(block)[i];
    EXPECT_EQ(sums.total(world()), expected);
    sums.write(world());
    EXPECT_EQ(count_finished_blocks(folder), run * blocks / 3);
    world().barrier();
  }
  world().on_root([&] { remove_finished_blocks(folder); });
  EXPECT_FALSE(fs::exists(folder));
}

}  // namespace
}  // namespace freestand::parallel
