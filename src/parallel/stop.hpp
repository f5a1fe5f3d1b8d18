// Stopping on request: batch systems send SIGTERM before the time limit, people press Ctrl-C.
#pragma once

#include <array>
#include <atomic>
#include <csignal>
#include <functional>
#include <thread>

namespace freestand::parallel {

// While it lives, SIGTERM, SIGINT, SIGUSR1 and SIGUSR2 (which mpirun passes on) ask the run to stop after the open blocks
// instead of ending the process; a second SIGINT ends it. One may live within another: what was before is put back. A run that was asked
// to stop is on its way out: from then on only SIGINT ends it, since batch systems, where they see one rank gone, tell the others to
// end, and their exit code must still be that of a run that can go on.
class StopOnSignal {
 public:
  // What to do, from another thread, when the run still goes on `patience_s` after it was asked to stop: it is in the
  // middle of something long. It should end the process. Nothing, once another one has lived within this one: what
  // that one was for tells how it ends.
  struct Overdue {
    double patience_s;
    std::function<void()> act;
  };

  StopOnSignal();
  explicit StopOnSignal(Overdue);
  ~StopOnSignal();
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;

 private:
  std::array<struct sigaction, 4> before_;
  StopOnSignal* around_;  // the one within which this one lives
  std::atomic<bool> handed_over_ = false;
  std::atomic<bool> over_ = false;
  std::thread watch_;
};

// Has this process been asked to stop? Safe and cheap anywhere.
bool stop_requested();

// Ask it from within (tests, time limits).
void request_stop();

// Forget it (tests).
void clear_stop();

}  // namespace freestand::parallel
