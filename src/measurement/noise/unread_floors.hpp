// Of floors that were read so seldom that what they did between their readings tells more of a history's error than the noise of sensors
// and floor together.
#pragma once

#include <string>
#include <vector>

#include "measurement/data/dataset.hpp"

namespace freestand::measurement {

struct UnreadFloor {
  const Test* test;
  double unread, noise;  // what the one and the other may change of the history [noise units], root mean square
};

// A sentence about the worst of them; empty: there is none.
std::string told_of_unread(const std::vector<UnreadFloor>&);

}  // namespace freestand::measurement
