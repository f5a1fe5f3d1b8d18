#include "study/run_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include "parallel/block_log.hpp"
#include "study/sweep.hpp"
#include "support/error_text.hpp"
#include "support/scratch.hpp"

namespace freestand::study {
namespace {

namespace fs = std::filesystem;
using freestand::test::error_text;
using testing::AllOf;
using testing::HasSubstr;

// Asked to stop while `work` is done; forgotten at the end.
class RunFolderTest : public testing::Test {
 protected:
  void TearDown() override { parallel::clear_stop(); }

  // A run that is asked to stop after it has finished these blocks. What it says.
  std::string stopped_run(Exit expected, const std::vector<std::int64_t>& blocks) {
    parallel::clear_stop();
    RunFolder folder({}, scratch_.folder(), io::Existing::resume, "go on with --resume");
    folder.begin();
    parallel::BlockLog log(blocks_path(scratch_.folder()), "study");
    log.find();
    log.begin({});
    for (const std::int64_t block : blocks) log.write(block, {1, {0.5}});
    folder.leave_if_asked();
    parallel::request_stop();
    return error_text(expected, [&] { folder.leave_if_asked(); });
  }

  // A run that is asked to stop while it starts: before it begins. What it says.
  std::string stopped_start(Exit expected) {
    parallel::clear_stop();
    RunFolder folder({}, scratch_.folder(), io::Existing::resume, "go on with --resume");
    parallel::request_stop();
    return error_text(expected, [&] { folder.leave_if_asked(); });
  }

  freestand::test::Scratch scratch_{"run"};
};

TEST_F(RunFolderTest, AStopIsResumable) {
  EXPECT_THAT(stopped_run(Exit::resumable, {1}), AllOf(HasSubstr("stopped early"), HasSubstr("go on with --resume")));
  EXPECT_FALSE(fs::exists(scratch_ / io::lock_name));
}

// Where another rank was asked to stop, this one leaves with it; the signal that comes to it on its way out must not end it.
TEST_F(RunFolderTest, ARankThatLeavesWithOthersCountsAsAsked) {
  const auto leaves = [&] {
    std::signal(SIGTERM, SIG_DFL);  // whatever the tests before left
    {
      RunFolder folder({}, scratch_.folder(), io::Existing::resume, "go on with --resume");
      folder.begin();
      error_text(Exit::resumable, [&] { folder.leave(); });
    }
    std::raise(SIGTERM);
    _exit(75);
  };
  EXPECT_EXIT(leaves(), testing::ExitedWithCode(75), "");
}

TEST_F(RunFolderTest, TwoStopsInARowWithoutProgressAskForACure) {
  stopped_run(Exit::resumable, {1});
  stopped_run(Exit::resumable, {});
  EXPECT_THAT(stopped_run(Exit::cure, {}), AllOf(HasSubstr("more time"), HasSubstr("go on with --resume")));
  stopped_run(Exit::cure, {});
  stopped_run(Exit::resumable, {2});
  stopped_run(Exit::resumable, {});
  stopped_run(Exit::cure, {});
}

TEST_F(RunFolderTest, TwoStopsInARowWhileItStartsAskForACure) {
  EXPECT_THAT(stopped_start(Exit::resumable), HasSubstr("nothing was finished"));
  EXPECT_THAT(stopped_start(Exit::cure), HasSubstr("more time"));
  stopped_run(Exit::resumable, {1});
  stopped_start(Exit::resumable);
  stopped_run(Exit::cure, {});
  stopped_start(Exit::cure);
}

// One that hangs while it starts is ended from another thread; the next one must not wait for its lock.
TEST_F(RunFolderTest, AnOverdueStartGivesItsLockBackAndCounts) {
  const auto hangs = [&] {
    RunFolder folder({}, scratch_.folder(), io::Existing::resume, "go on with --resume");
    parallel::request_stop();
    std::this_thread::sleep_for(std::chrono::minutes(1));
  };
  EXPECT_EXIT(hangs(), testing::ExitedWithCode(75), "nothing was finished");
  EXPECT_FALSE(fs::exists(scratch_ / io::lock_name));
  stopped_start(Exit::cure);
}

TEST_F(RunFolderTest, AStopInTheFitKeepsTheSamples) {
  std::ofstream(samples_path(scratch_.folder())) << "x";
  EXPECT_THAT(stopped_run(Exit::resumable, {}), HasSubstr("what is finished is kept"));
}

TEST_F(RunFolderTest, AStartThatIsNotStoppedNotesNothing) {
  { const RunFolder folder({}, scratch_.folder(), io::Existing::resume, "go on with --resume"); }
  EXPECT_FALSE(fs::exists(scratch_ / io::begun_name));
}

TEST_F(RunFolderTest, SamplesThatAreCompleteAreProgress) {
  stopped_run(Exit::resumable, {});
  std::ofstream(samples_path(scratch_.folder())) << "x";
  stopped_run(Exit::resumable, {});
  stopped_run(Exit::cure, {});
}

TEST_F(RunFolderTest, WhatEndedDoesNotCountAsStopped) {
  stopped_run(Exit::resumable, {});
  parallel::clear_stop();
  {
    RunFolder folder({}, scratch_.folder(), io::Existing::resume, "start again");
    folder.begin();
    folder.end();
  }
  EXPECT_FALSE(fs::exists(scratch_ / io::begun_name));
  stopped_run(Exit::resumable, {});
}

TEST_F(RunFolderTest, KeepsOthersOut) {
  const RunFolder first({}, scratch_ / "new", io::Existing::refuse, "");
  for (const auto existing : {io::Existing::refuse, io::Existing::overwrite, io::Existing::resume})
    EXPECT_THAT(error_text(Exit::usage, [&] { RunFolder({}, scratch_ / "new", existing, ""); }), HasSubstr("in use"));
}

TEST_F(RunFolderTest, ARefusalLeavesTheFolderAsItWas) {
  std::ofstream(scratch_ / "thesis.txt") << "mine";
  const auto before = fs::last_write_time(scratch_.folder());
  EXPECT_THAT(error_text(Exit::usage, [&] { RunFolder({}, scratch_.folder(), io::Existing::refuse, ""); }),
              HasSubstr("not empty"));
  EXPECT_EQ(fs::last_write_time(scratch_.folder()), before);
}

}  // namespace
}  // namespace freestand::study
