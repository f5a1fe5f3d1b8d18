// Which of several numbers is another's: the one that lies furthest from their mean, if further than chance would put the furthest of so many
// that scatter alike about it (F. E. Grubbs, Ann. Math. Stat. 21, 1950).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace freestand::measurement {

struct OddOne {
  std::size_t which = 0;
  double off = 0;                // from the mean of the others
  double scatter_of_others = 0;  // standard deviation
  double p = 1;
};
// None: all scatter alike (at chance_level), or they are fewer than three.
std::optional<OddOne> odd_one(const std::vector<double>& numbers);

}  // namespace freestand::measurement
