// From rows of samples to the fragility of a study: bins, tally on all ranks, fits.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/jobs.hpp"
#include "base/table.hpp"
#include "fragility/options.hpp"
#include "fragility/result.hpp"
#include "fragility/tally.hpp"
#include "parallel/communicator.hpp"
#include "parallel/step_display.hpp"
#include "study/damage_states.hpp"
#include "study/study.hpp"
#include "study/target.hpp"

namespace freestand::study {

// Bins that are not given by edges are laid over the intensities of this many first samples, so that they depend
// neither on the number of ranks nor, beyond that, on the number of samples.
inline constexpr std::int64_t bin_layout_samples = 4096;

// What the study asks of the statistics. The target is the study's, whose tables are large: it is built once for all that needs it.
// first: the first samples' rows, at least bin_layout_samples or all there are.
// motion_group: one entry a motion (fragility::Options). Throws Error when no intensity lies above zero.
fragility::Options fragility_options(const Study&, const Target&, Table first, const std::vector<int>& motion_group);

// The same before anything has responded: of `first` the draws and the intensity are read alone.
fragility::Options laid_out(const Study&, const Target&, const Table& first, const std::vector<int>& motion_group);

// Rows of one block, with the column im_NAME beside them (intensities.hpp).
using ReadTable = std::function<Table(std::int64_t block)>;

// Tallies the blocks, of block_size samples each but the last, dealt to the ranks, and analyses them. The result stands
// on the root, the others get an empty one. The same to the bit on any number of ranks. jobs: spreads the fits over the
// ranks. display: of the root, told how far the reading is; null: none. Collective.
fragility::Result analyse(const parallel::Communicator&, const Study&, const Target&,
                          const std::vector<int>& motion_group, std::int64_t blocks, std::int64_t block_size,
                          const ReadTable&, const Jobs&, parallel::StepDisplay* display = nullptr);

// What is counted of samples for the fragility of a study.
class DemandCounts {
 public:
  // study and target outlive it.
  DemandCounts(const Study&, const Target&, fragility::Options);

  // Row i is sample first + i; with the column im_NAME.
  void add(Table rows, std::uint64_t first);

  // Words of several may be added element by element.
  parallel::Words words() const { return tally_.words(); }
  void clear() { tally_ = fragility::Tally(tally_.options()); }
  parallel::Words normal(std::span<const std::int64_t> added) const {
    return fragility::Tally::from_words(tally_.options(), added).words();
  }

  fragility::Result result(std::span<const std::int64_t> words, const Jobs&) const;

 private:
  const Target& target_;
  DamageStates damage_;
  fragility::Tally tally_;
};

// Names of the columns of samples.h5 that it and the intensity read.
std::vector<std::string> analysed_columns(const FragilityPart&);

}  // namespace freestand::study
