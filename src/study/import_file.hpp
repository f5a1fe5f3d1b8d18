// A file of a laboratory: its table, its times, and channels at other times. Internal to src/study.
#pragma once

#include <vector>

#include "base/lab_table.hpp"
#include "study/import.hpp"

namespace freestand::study {

using Series = std::vector<double>;

struct Clock {
  double step_s = 0;   // the usual one
  double digit_s = 0;  // the last one of its readings; 0: it jitters by more
};

struct File : Clock {
  LabTable table;
  Series time;
};

// Throws Error (Exit::data): too few rows, times that do not rise, or two rows and more that are missing in a row.
File read_file(const LabFile&);

// A channel, in SI, at the file's own times. Throws Error (Exit::data) where there is none of that name, or two.
Series channel(const LabTable&, const LabColumn&);

// Is a row missing before this one?
bool is_behind_gap(const File&, std::size_t row);

// A channel at start, start + step, ...: as it was read where it was read then; between its samples on straight lines, or of a floor as it is
// taken between its readings, but for files that lack rows, which straight lines fill.
Series at_times(const File&, const Series& time, const LabColumn&, double start, double step_s, std::size_t count);
Series floor_at_times(const File& floor, const LabColumn&, double start, double step_s, std::size_t count);

}  // namespace freestand::study
