// Floor and response of a test on one clock and one grid of times. Internal to src/study.
#pragma once

#include <optional>

#include "study/import_file.hpp"
#include "study/import_text.hpp"

namespace freestand::study {

// That of the finer one of the two files, or the one that was asked for.
double step_of(const Laboratory&, const File& floor, const File& response);

// clock_s: by how much the response is stamped late. Throws Error (Exit::data) where the two have no time in common.
TestOfLab on_one_clock(const Laboratory&, const LabTest&, const File& floor, const File& response, double clock_s);

// As given, or of the quiet parts of the samples as they were written: those between them hide half of it.
double noise_of(const File&, const std::optional<LabColumn>&, double given);

}  // namespace freestand::study
