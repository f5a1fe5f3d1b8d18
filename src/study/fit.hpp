// The reducer: samples.h5 -> fragility.h5, bins.csv, surface.csv, summary.json.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "parallel/communicator.hpp"
#include "study/run_folder.hpp"
#include "study/sweep.hpp"

namespace freestand::study {

struct FitSummary {
  std::int64_t samples = 0;
  double wall_s = 0;
  std::vector<std::string> changed;  // keys of study.yaml that were used otherwise than the sweep had them
};

// Reads DIR/samples.h5 and writes the other files beside it. The study is the one stored in samples.h5, with the fragility
// block of DIR/study.yaml where that is there (edited_study.hpp). quiet: no progress. sweep: what the run that made the
// samples took, for the summary; null: not known. Collective. Throws Error: samples.h5 cannot be used (Exit::data),
// study.yaml is not the study that was swept (Exit::usage), stopped on request (as RunFolder::leave).
FitSummary fit(const parallel::Communicator&, RunFolder& folder, const std::string& command, bool quiet = false,
               const SweepSummary* sweep = nullptr);

}  // namespace freestand::study
