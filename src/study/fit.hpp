// The reducer: samples.h5 -> fragility.h5, bins.csv, surface.csv, summary.json.
#pragma once

#include <filesystem>
#include <string>

#include "parallel/communicator.hpp"
#include "study/sweep.hpp"

namespace freestand::study {

// Reads DIR/samples.h5 and writes the other files beside it. The study is the one stored in samples.h5. sweep: what the
// run that made them took, for the summary; null: not known. Collective. Throws Error (Exit::data) if samples.h5 cannot
// be used.
void fit(const parallel::Communicator&, const std::filesystem::path& folder, const std::string& command,
         const SweepSummary* sweep = nullptr);

}  // namespace freestand::study
