// The clocks of floor and response, as the slips tell them. Internal to src/study.
#pragma once

#include <string>
#include <vector>

#include "study/import_grid.hpp"

namespace freestand::study {

inline constexpr double longest_offset_s = 0.5;

struct Clocks {
  std::vector<double> late_s;  // of each test, by how much the response is stamped late
  std::vector<std::string> sentences;
};

// As given, or as slips go with the floor. Tests that agree to two steps were read by one clock: its offset is the middle one, and holds for
// those, too, whose motion tells nothing. A slip that goes with the floor turned round, or in another unit, sets no clock.
Clocks clocks(const Laboratory&, const std::vector<File>& floors, const std::vector<File>& responses);

}  // namespace freestand::study
