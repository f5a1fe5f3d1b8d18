// Groups that are left out in turn.
#pragma once

#include <vector>

#include "fragility/groups.hpp"

namespace freestand::fragility {

// The groups of motions of a fragility analysis, at most 64 a stratum (records, whole ones to a group; pulses): from as many
// an error is known to 9 % (1/sqrt(2 * 63)), and Student's t makes a 95 % interval 2 % wider than the normal one. A curve is fitted for
// each, which is as much time as 64 more resamples take, and fragility.h5 holds them all.
class LeaveOutGroups {
 public:
  static constexpr int most_of_a_stratum = 64;

  explicit LeaveOutGroups(const MotionGroups& motions);

  int count() const { return records_ + others_; }
  int of(int motion_group) const;  // of a group of MotionGroups
  int stratum(int group) const { return group < records_ ? 0 : 1; }

 private:
  int record_groups_, records_, others_;
};

}  // namespace freestand::fragility
