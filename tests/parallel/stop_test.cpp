#include "parallel/stop.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

namespace freestand::parallel {
namespace {

// A batch system that sees one rank end early tells the others to end while they are on their way out: their exit code must
// still say that the run can go on.
TEST(StopOnSignal, ARunThatIsLeavingIsNotEndedByTheNextSignal) {
  const auto leave = [] {
    {
      const StopOnSignal stop_on_signal;
      std::raise(SIGTERM);
    }
    std::raise(SIGTERM);
    std::raise(SIGUSR1);
    _exit(75);
  };
  EXPECT_EXIT(leave(), testing::ExitedWithCode(75), "");
}

TEST(StopOnSignal, WithoutARequestSignalsMeanWhatTheyMeantBefore) {
  const auto ends = [] {
    { const StopOnSignal stop_on_signal; }
    std::raise(SIGTERM);
    _exit(75);
  };
  EXPECT_EXIT(ends(), testing::KilledBySignal(SIGTERM), "");
}

}  // namespace
}  // namespace freestand::parallel
