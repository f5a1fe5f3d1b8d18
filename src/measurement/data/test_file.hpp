// The csv file of one measured test: time_s, floor_acceleration_mps2 [, floor_vertical_acceleration_mps2], slip_m or
// rotation_rad or both [, block_acceleration_mps2]; constant step.
#pragma once

#include "measurement/data/dataset.hpp"

namespace freestand::measurement {

// Fills motion, dt_s and the histories of the test; time starts at 0 whatever the file starts at. dt_s: the step that
// the data set states, 0: not stated. Throws Error (Exit::data) that names file and line: a channel missing, a value
// that is not a finite number, steps that are unequal or not as stated, gaps, fewer than 10 rows.
void read_test_file(const std::filesystem::path& path, double dt_s, Test& test);

}  // namespace freestand::measurement
