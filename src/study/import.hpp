// Files of a laboratory -> a measurement set: dataset.yaml and one csv per test, in freestand's names, units and signs, floor
// and response on one clock.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/read_laboratory.hpp"

namespace freestand::study {

struct Imported {
  std::vector<std::pair<std::string, std::string>> files;  // name and text, dataset.yaml first
  std::vector<std::string> sentences;                      // what was changed, and what was left out
};

// Floor and response are interpolated linearly to the same times, from the later start to the earlier end, in steps of
// sampling_dt_s. Where the clock of the response is not given, its offset is that in which floor and slip go together
// (measurement/laboratory/timing.hpp), looked for within half a second, and known to about a step. Noise that is not given is taken from the quiet parts.
// Throws Error (Exit::data): a file that cannot be read, a column that is not there, times that do not rise, no common time.
Imported import_laboratory(const Laboratory&);

}  // namespace freestand::study
