// How large a sweep is, before it begins: its files, and what it holds in memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "parallel/node_size.hpp"
#include "study/evaluator.hpp"
#include "study/study.hpp"
#include "study/target.hpp"

namespace freestand::study {

struct SweepSize {
  std::int64_t samples = 0, kept = 0;
  double samples_bytes = 0;  // of samples.h5, where nothing in it can be packed [B]
  double blocks_bytes = 0;   // of the kept samples in blocks/ while it runs [B]
  double counts_bytes = 0;   // of what is counted: of tally.h5, and of a node's file while it runs [B]
  double results_bytes = 0;  // of fragility.h5 and the tables that a fit writes, at most [B]
  double memory_bytes = 0;   // of the counts in each rank, at most [B]
  double motion_bytes = 0;   // of the floor motions in each node [B]
};

// Throws Error where the bins cannot be laid.
SweepSize size_of(const Study&, const Target&, const Evaluator&);

// One sentence.
std::string told(const SweepSize&);

// Throws Error (Exit::usage) where the counts of all ranks of a node do not fit into its memory.
void refuse_too_large(const SweepSize&, const parallel::NodeSize&);

// What is to be told where the file system of the folder has less room than the sweep will take; empty where it has.
std::string room_told(const SweepSize&, const std::filesystem::path& folder);

}  // namespace freestand::study
