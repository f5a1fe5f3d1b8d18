#include "parallel/communicator.hpp"

#include <gtest/gtest.h>

#include "base/exact_sum.hpp"
#include "mpi/mpi_main.hpp"
#include "parallel/node_size.hpp"

namespace freestand::parallel {
namespace {

using test::world;

TEST(Communicator, BroadcastBringsTheRootsValue) {
  const bool root = world().is_root();
  EXPECT_EQ(world().broadcast(std::string(root ? "études\n" : "other")), "études\n");
  EXPECT_EQ(world().broadcast(root ? Words{1, -2, INT64_MAX} : Words{}), (Words{1, -2, INT64_MAX}));
  EXPECT_EQ(world().broadcast(root ? std::vector<double>{0.1, -1e300} : std::vector<double>(9)),
            (std::vector<double>{0.1, -1e300}));
  EXPECT_EQ(world().broadcast(root ? Words{} : Words{7}), Words{});
}

TEST(Communicator, GatherKeepsRankOrderAndLengths) {
  const auto n = static_cast<std::size_t>(world().rank());
  const auto all = world().gather(Words(n, world().rank()));
  if (!world().is_root()) {
    EXPECT_TRUE(all.empty());
    return;
  }
  ASSERT_EQ(all.size(), static_cast<std::size_t>(world().size()));
  for (std::size_t rank = 0; rank < all.size(); ++rank) EXPECT_EQ(all[rank], Words(rank, std::int64_t(rank)));
}

TEST(Communicator, CountsTheRanksOfTheNode) { EXPECT_EQ(narrowest_node(world()).ranks, world().size()); }

TEST(Communicator, SumsAreExact) {
  Words values{std::int64_t{1} << 60, world().rank(), 1};
  const std::int64_t n = world().size();
  world().sum_in_place(values);
  EXPECT_EQ(values, (Words{(std::int64_t{1} << 60) * n, n * (n - 1) / 2, n}));
}

TEST(Communicator, AnyIsTrueIfOneIs) {
  EXPECT_FALSE(world().any(false));
  EXPECT_TRUE(world().any(world().rank() == world().size() - 1));
}

// A 128-bit sum carries from its low word into its high one: a sum by position would lose that.
TEST(Communicator, MergeAddsExactSumsOfAllRanks) {
  ExactSum mine, expected;
  for (int rank = 0; rank < world().size(); ++rank) {
    for (const double value : {1e20 * (rank + 1), -0.3 * rank, 1234.5}) {
      expected.add(value);
      if (rank == world().rank()) mine.add(value);
    }
  }
  const auto words = [](const ExactSum& sum) { return Words{sum.high(), static_cast<std::int64_t>(sum.low())}; };
  const auto sum = [](const Words& w) { return ExactSum::from_words(w[0], static_cast<std::uint64_t>(w[1])); };
  const Words merged = world().merge(words(mine), [&](Words& into, const Words& from) {
    ExactSum total = sum(into);
    total.add(sum(from));
    into = words(total);
  });
  if (world().is_root()) {
    EXPECT_EQ(sum(merged), expected);
  } else {
    EXPECT_TRUE(merged.empty());
  }
}

// Lower ranks come first, so even a merge whose order matters is the same from run to run.
TEST(Communicator, MergeIsInRankOrder) {
  const Words merged = world().merge(
      Words{world().rank()}, [](Words& into, const Words& from) { into.insert(into.end(), from.begin(), from.end()); });
  for (std::size_t i = 0; i < merged.size(); ++i) EXPECT_EQ(merged[i], static_cast<std::int64_t>(i));
  EXPECT_EQ(merged.size(), world().is_root() ? static_cast<std::size_t>(world().size()) : 0u);
}

TEST(Communicator, LongMessagesArriveWhole) {
  Words mine(3'000'000);
  for (std::size_t i = 0; i < mine.size(); ++i) mine[i] = static_cast<std::int64_t>(i) * (world().rank() + 1);
  const auto all = world().gather(mine);
  for (std::size_t rank = 0; rank < all.size(); ++rank)
    EXPECT_EQ(all[rank].back(), 2'999'999 * static_cast<std::int64_t>(rank + 1));
}

TEST(Communicator, AnErrorOfTheRootIsThrownOnEveryRank) {
  int done = 0;
  world().on_root([&] { ++done; });
  EXPECT_EQ(done, world().is_root() ? 1 : 0);
  try {
    world().on_root([] { throw Error("the root's trouble", Exit::data); });
    FAIL() << "nothing was thrown";
  } catch (const SharedError& error) {
    EXPECT_STREQ(error.what(), "the root's trouble");
    EXPECT_EQ(error.exit(), Exit::data);
  }
}

}  // namespace
}  // namespace freestand::parallel
