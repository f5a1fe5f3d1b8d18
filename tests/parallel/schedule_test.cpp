// Without mpirun: one rank. tests/mpi holds the same for several.
#include "parallel/schedule.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

#include "parallel/stop.hpp"

namespace freestand::parallel {
namespace {

TEST(Schedule, OneRankDoesAllBlocksInTheOrderOfTheList) {
  Words done;
  EXPECT_TRUE(for_each_block(Communicator(), {4, 0, 9}, [&](std::int64_t block, const Beat& beat) {
    beat();
    done.push_back(block);
    return Counts{};
  }));
  EXPECT_EQ(done, (Words{4, 0, 9}));
}

TEST(Schedule, AListOfBlocksIsWhatWasPutIntoIt) {
  const Words blocks{7, 8, 9, 2, 3, 5, 5, 6, 100, 0};
  const BlockList list(blocks);
  ASSERT_EQ(list.size(), 10);
  for (std::int64_t place = 0; place < list.size(); ++place)
    EXPECT_EQ(list[place], blocks[static_cast<std::size_t>(place)]) << place;
  EXPECT_TRUE(BlockList().empty());
}

TEST(Schedule, NothingToDoIsDone) {
  EXPECT_TRUE(for_each_block(Communicator(), {}, [](std::int64_t, const Beat&) -> Counts { throw 1; }));
}

TEST(Schedule, AnErrorInABlockComesOut) {
  EXPECT_THROW(for_each_block(Communicator(), {0}, [](std::int64_t, const Beat&) -> Counts { throw Error("x"); }),
               Error);
}

// Rank 0 answers others a hundred times a second, however dear a sample is: a block of samples of a millisecond each had one beat, at its end.
TEST(Schedule, DearSamplesWaitForNoBlock) {
  EXPECT_EQ(samples_to_beat(32, 32 * 1e-6, 1024), 1024);
  EXPECT_EQ(samples_to_beat(1024, 1024 * 1e-4, 1024), 100);
  EXPECT_EQ(samples_to_beat(32, 32 * 1e-2, 1024), 32);
  EXPECT_EQ(samples_to_beat(7, 0, 1024), 1024);
}

TEST(Stop, ASignalStopsAfterTheOpenBlock) {
  for (const int signal_number : {SIGTERM, SIGINT, SIGUSR1}) {
    const StopOnSignal stop_on_signal;
    Words done;
    const bool complete = for_each_block(Communicator(), {0, 1, 2, 3}, [&](std::int64_t block, const Beat&) {
      if (block == 1) std::raise(signal_number);
      done.push_back(block);
      return Counts{};
    });
    EXPECT_TRUE(stop_requested());
    clear_stop();
    EXPECT_FALSE(complete);
    EXPECT_EQ(done, (Words{0, 1}));
  }
}

TEST(Stop, ASignalInTheLastBlockChangesNothing) {
  const StopOnSignal stop_on_signal;
  EXPECT_TRUE(for_each_block(Communicator(), {0}, [](std::int64_t, const Beat&) {
    std::raise(SIGTERM);
    return Counts{};
  }));
  clear_stop();
}

TEST(StopDeathTest, ASecondInterruptEndsTheProcess) {
  EXPECT_EXIT(
      {
        const StopOnSignal stop_on_signal;
        std::raise(SIGINT);
        std::raise(SIGINT);
        std::raise(SIGINT);
      },
      testing::KilledBySignal(SIGINT), "");
}

TEST(Session, WithoutALauncherThereIsOneRank) {
  const Session session(nullptr, nullptr);
  EXPECT_EQ(session.world().size(), 1);
}

TEST(Session, ProcessesThatMpiDoesNotBringTogetherAreRefused) {
  ::setenv("SLURM_STEP_NUM_TASKS", "4", 1);
  EXPECT_THROW(Session(nullptr, nullptr), Error);
  ::setenv("SLURM_STEP_NUM_TASKS", "1", 1);
  EXPECT_NO_THROW(Session(nullptr, nullptr));
  ::unsetenv("SLURM_STEP_NUM_TASKS");
}

TEST(Communicator, OneRankTalksToItself) {
  const Communicator alone;
  alone.barrier();
  Words values{1, 2};
  alone.sum_in_place(values);
  EXPECT_EQ(values, (Words{1, 2}));
  EXPECT_EQ(alone.broadcast(std::string("x")), "x");
  EXPECT_EQ(alone.gather({3}), (std::vector<Words>{{3}}));
  EXPECT_EQ(alone.merge({4}, [](Words&, const Words&) { FAIL(); }), Words{4});
  EXPECT_TRUE(alone.any(true));
  EXPECT_FALSE(alone.any(false));
  EXPECT_THROW(alone.on_root([] { throw Error("x"); }), SharedError);
  EXPECT_EQ(end_run(alone, Error("told once", Exit::data)), 3);
}

}  // namespace
}  // namespace freestand::parallel
