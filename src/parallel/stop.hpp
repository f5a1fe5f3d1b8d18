// Stopping on request: batch systems send SIGTERM before the time limit, people press Ctrl-C.
#pragma once

namespace freestand::parallel {

// While it lives, SIGTERM, SIGINT and SIGUSR1 (which mpirun passes on) ask the run to stop after the open blocks
// instead of ending the process; a second SIGINT ends it. One at a time.
class StopOnSignal {
 public:
  StopOnSignal();
  ~StopOnSignal();
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;
};

// Has this process been asked to stop? Safe and cheap anywhere.
bool stop_requested();

// Ask it from within (tests, time limits).
void request_stop();

// Forget it (tests).
void clear_stop();

}  // namespace freestand::parallel
