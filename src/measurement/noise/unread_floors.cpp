#include "measurement/noise/unread_floors.hpp"

#include <fmt/format.h>

#include "measurement/data/floor_readings.hpp"

namespace freestand::measurement {

std::string told_of_unread(const std::vector<UnreadFloor>& floors) {
  const UnreadFloor* worst = nullptr;
  for (const UnreadFloor& floor : floors)
    if (floor.unread > floor.noise && (!worst || floor.unread > worst->unread)) worst = &floor;
  if (!worst) return "";
  return fmt::format(
      "the floor of test {} was read every {:.3g} s: what it did between its readings may change the history by {:.2g} "
      "times the noise, which bands and chances allow for; read it more often",
      worst->test->id, readings_of(*worst->test).step_s, worst->unread);
}

}  // namespace freestand::measurement
