// What a sweep that does not keep all of its samples counts of them: for the surfaces, and for the ranking of intensities.
#pragma once

#include <cstdint>
#include <string>

#include "base/table.hpp"
#include "parallel/communicator.hpp"
#include "study/analysis.hpp"
#include "study/ranking.hpp"

namespace freestand::study {

// How many of the first samples of a sweep of `samples` are kept: at least those over which the bins are laid.
std::int64_t kept_samples(const Study&, std::int64_t samples);

// Of all in the study that decides what is counted.
std::string counts_fingerprint(const Study&);

class SampleCounts {
 public:
  // first: the first samples' rows, over which the bins are laid. study and target outlive it.
  SampleCounts(const Study&, const Target&, const std::vector<int>& motion_group, const MotionSummaries&, Table first);

  // Row i is sample first + i. alike: of a round that takes samples of all intensities; others are not ranked by.
  void add(Table rows, std::int64_t first, bool alike);

  // What was added since the last time, as words that may be added element by element.
  parallel::Words take();
  std::size_t size() const { return size_; }  // words

  // The same sums, written in the one way that does not depend on who added what.
  parallel::Words normal(const parallel::Words&) const;

  // Of words that were added up.
  fragility::Result result(const parallel::Words&, const Jobs&) const;
  Ranking ranking(const parallel::Words&, std::int64_t alike, std::int64_t swept) const;

 private:
  SampleIntensity intensity_;
  DemandCounts demands_;
  RankingCounts ranking_;
  std::size_t demand_words_, size_;
};

}  // namespace freestand::study
