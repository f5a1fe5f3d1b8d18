// The sweep: all samples of a study, on all ranks, into samples.h5.
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "parallel/communicator.hpp"
#include "study/run_folder.hpp"
#include "study/study.hpp"

namespace freestand::study {

struct SweepOptions {
  bool quiet = false;
  std::string command;                           // for the provenance
  bool fit_follows = false;                      // which tells whether `until` was reached; else the sweep does
  std::set<std::string>* doubts_told = nullptr;  // by sweeps before this one: these are not told again
};

// Where a sweep's files lie inside its folder.
std::filesystem::path samples_path(const std::filesystem::path& folder);
std::filesystem::path blocks_path(const std::filesystem::path& folder);
std::filesystem::path tally_path(const std::filesystem::path& folder);  // only where not all samples are kept
std::filesystem::path study_path(const std::filesystem::path& folder);  // the expanded study

struct SweepSummary {
  std::int64_t samples = 0;
  std::int64_t computed = 0;     // by this run; the others were there
  std::int64_t passed_over = 0;  // by this run, without being integrated (rounds.hpp)
  // From the start to the end, and what of it went into reading motions with their spectra, into integrating samples, into
  // checking their accuracy and into writing samples.h5.
  double wall_s = 0, motions_s = 0, compute_s = 0, accuracy_s = 0, write_s = 0;
  double samples_per_s = 0;  // while integrating, all ranks together
};

// Computes the blocks that are not there yet and writes samples.h5; nothing, if that is there with as many samples. Where
// it holds fewer of the same study, these are taken over. With `until`, goes on in rounds (rounds.hpp), each twice as long as all
// before, until every wanted point of the surface is known well enough, or would hardly be known better by more samples. The same
// numbers, to the bit, on any number of ranks and after any restart. Collective. Throws Error: another study's results (Exit::usage; the folder is then as it
// was), full disk (Exit::cure), stopped on request (as RunFolder::leave).
SweepSummary sweep(const parallel::Communicator&, const Study&, const SweepOptions&, RunFolder&);

}  // namespace freestand::study
