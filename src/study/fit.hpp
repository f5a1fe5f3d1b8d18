// The reducer: samples.h5 -> fragility.h5, bins.csv, surface.csv, ranking.csv, summary.json.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "parallel/communicator.hpp"
#include "study/fragility_changes.hpp"
#include "study/run_folder.hpp"
#include "study/sweep.hpp"

namespace freestand::study {

struct FitOptions {
  std::filesystem::path from;           // the folder that samples.h5 and study.yaml lie in
  FragilityChanges changes = {};        // of the command line
  std::string command = {};             // for the provenance
  bool quiet = false;                   // no progress
  bool whole_ranking = false;           // FitSummary::ranking is the whole table
  const SweepSummary* sweep = nullptr;  // what the run that made the samples took, for the summary; null: not known
};

struct FitSummary {
  std::int64_t samples = 0;
  double wall_s = 0;
  std::string intensity = {};              // "sa_g at 0.5 s"
  std::vector<std::string> changed = {};   // keys of the fragility block that the sweep had otherwise
  std::vector<std::string> notes = {};     // what a user should be told
  std::vector<std::string> warnings = {};  // of the statistics and their accuracy; on the root
  std::string ranking = {};                // of the intensities: a line a demand, or the whole table; on the root
};

// Throws what fit would throw of its samples, its study and the changes. By one process.
void check_fit(const FitOptions&);

// Reads the samples and writes the other files into `into`, which may be another folder than theirs: then study.yaml is
// written too, and theirs is left as it is. The study is the one stored in samples.h5, with the fragility block of the
// study.yaml beside it where that is there (edited_study.hpp) and the changes of the command line. Collective. Throws Error:
// samples.h5 cannot be used (Exit::data), study.yaml is not the study that was swept or the changes make no sense
// (Exit::usage), stopped on request (as RunFolder::leave).
FitSummary fit(const parallel::Communicator&, RunFolder& into, const FitOptions&);

}  // namespace freestand::study
