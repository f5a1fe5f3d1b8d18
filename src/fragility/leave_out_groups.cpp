#include "fragility/leave_out_groups.hpp"

#include <algorithm>

namespace freestand::fragility {

LeaveOutGroups::LeaveOutGroups(const MotionGroups& motions)
    : record_groups_(motions.record_groups()),
      records_(std::min(motions.record_groups(), most_of_a_stratum)),
      others_(std::min(motions.count() - motions.record_groups(), most_of_a_stratum)) {}

int LeaveOutGroups::of(int motion_group) const {
  return motion_group < record_groups_ ? motion_group % records_ : records_ + (motion_group - record_groups_) % others_;
}

}  // namespace freestand::fragility
