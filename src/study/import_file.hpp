// A file of a laboratory: its table, its times, and channels at other times. Internal to src/study.
#pragma once

#include <vector>

#include "base/lab_table.hpp"
#include "study/import.hpp"

namespace freestand::study {

using Series = std::vector<double>;

struct File {
  LabTable table;
  Series time;
  double step_s = 0;  // the middle one
};

// Throws Error (Exit::data): too few rows, or times that do not rise.
File read_file(const LabFile&);

// A channel, in SI, at the file's own times. Throws Error (Exit::data) where there is none of that name, or two.
Series channel(const LabTable&, const LabColumn&);

// Are rows missing before this one? Its step is more than one and a half of the usual one.
bool is_behind_gap(const File&, std::size_t row);

// A channel at start, start + step, ...: between its samples on straight lines; of a floor as it is taken between its readings, but for
// files with gaps, which straight lines fill.
Series at_times(const File&, const Series& time, const LabColumn&, double start, double step_s, std::size_t count);
Series floor_at_times(const File& floor, const LabColumn&, double start, double step_s, std::size_t count);

}  // namespace freestand::study
