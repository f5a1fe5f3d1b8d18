// Steps that come no further: before a place where a law has no value, or under one that is too stiff to be followed.
#pragma once

namespace freestand::dynamics {

struct StepWatch {
  // After so many steps within one segment of the motion it is looked whether they come any further.
  static constexpr int watched = 10000;

  int steps = 0;  // within this segment
  double from_s = 0;

  // One more begins at that time: true where the last ten thousand came no further than this.
  bool stalls(double time_s, double least_progress_s) {
    if (steps++ % watched != 0) return false;
    const bool stalled = steps > 1 && time_s - from_s < least_progress_s;
    from_s = time_s;
    return stalled;
  }
};

}  // namespace freestand::dynamics
