// What is finished of a sweep, in its folder: rows of the samples that are kept in a log of blocks, and, where not all are
// kept, what is counted of all of them, with the set of blocks that are in it.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "io/samples_file.hpp"
#include "parallel/block_log.hpp"
#include "parallel/block_sums.hpp"
#include "parallel/communicator.hpp"
#include "study/evaluator.hpp"
#include "study/sample_counts.hpp"
#include "study/target.hpp"

namespace freestand::study {

class Checkpoint {
 public:
  // The study, its target and the evaluator outlive it. Where not all samples are kept, the ranks integrate the first ones
  // together, over which the bins are laid. Collective. Throws Error if the folder cannot be made.
  Checkpoint(const parallel::Communicator&, const Study&, const Target&, const Evaluator&,
             const std::filesystem::path& folder);

  // Looks where rows lie that earlier runs have finished. Collective.
  void look();

  // Takes what earlier runs have finished for this study's; on the root. Throws Error (Exit::usage): blocks of another study
  // (parallel::OtherBlocks) or program.
  void find();

  // Takes over what the root has found. Collective.
  void begin();

  std::int64_t block_size() const { return layout_.block_size; }

  // Was all of this block finished by earlier runs?
  bool has(std::int64_t block) const { return has_rows(block) && has_counts(block); }

  // A block that is finished, all its rows; alike: of a round that takes samples of all intensities. Throws Error: a full disk is
  // Exit::cure.
  void add(std::int64_t block, const Table& rows, bool alike);

  // From here on every rank can read what any has added, and what was counted is in files. Collective.
  void share();

  // How many samples of a block are kept, and their rows. Throws Error (Exit::data) where these cannot be read any more.
  std::int64_t kept(std::int64_t block) const;
  std::int64_t kept() const { return kept_; }
  std::vector<double> rows(std::int64_t block) const { return log_.read(block).values; }

  // Where not all samples are kept; else null.
  const SampleCounts* counts() const { return counted_ ? &counted_->counts : nullptr; }
  parallel::Words counted();  // what was counted so far. Collective.

  // How many of the first samples hold all that earlier runs have counted: no answer about fewer can be given any more.
  std::int64_t least_counted() const;

 private:
  struct Counted {
    SampleCounts counts;
    parallel::BlockSums sums;
    std::vector<std::int64_t> waiting = {};            // blocks that are counted, and not yet in the sums
    std::chrono::steady_clock::time_point since = {};  // when the first of them came
    std::chrono::duration<double> pause{1};            // until they are added
  };
  bool has_rows(std::int64_t block) const;
  bool has_counts(std::int64_t block) const { return !counted_ || counted_->sums.has(block); }
  void add_to_sums();

  const parallel::Communicator world_;
  const std::int64_t kept_;
  parallel::BlockLog log_;
  const io::BlockLayout layout_;      // of all samples of the study
  std::vector<std::int64_t> logged_;  // blocks whose rows are in the log, ascending
  std::unique_ptr<Counted> counted_;
};

}  // namespace freestand::study
