// Which of the intensities that a sweep can answer for foretells its demands best (fragility/ranking.hpp).
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "fragility/ranking.hpp"
#include "io/samples_file.hpp"
#include "parallel/communicator.hpp"
#include "study/intensities.hpp"
#include "study/motion_summaries.hpp"
#include "study/study.hpp"
#include "study/target.hpp"

namespace freestand::study {

// As many samples are ranked, the first of the sweep, and what is told says so. Of records the motions are the unit: a hundred samples tell
// the mean of each to a tenth of what samples scatter about it, and then more samples of the same motions tell nothing. Of pulses each
// sample is a motion: the scatter of ln demand is known to 1 % by the jackknife of configs/quickstart.yaml, and two scatters are parted
// that differ by 0.6 % of it (0.0023 +- 0.0022 of 0.81 between PGV and Housner's intensity is not): nobody chooses by less. What happened
// to fewer than 10 of them is not ranked. The tally has the same size for any number, but takes 10 us a sample, a third of a sweep.
inline constexpr std::int64_t most_ranked_samples = 65536;

struct Ranking {
  std::int64_t samples = 0, swept = 0;           // that were ranked, that the sweep has
  std::vector<fragility::RankedDemand> demands;  // of the study
};

// What is counted of samples for it, of every intensity of the catalogue once, spectral accelerations at usual periods and at
// the study's.
class RankingCounts {
 public:
  // motion_group: one entry a motion (fragility::Options). target outlives it.
  RankingCounts(const Study&, const Target&, const std::vector<int>& motion_group, const MotionSummaries&);

  // Of a row it reads these columns.
  std::vector<std::string> columns() const;

  // Row i is sample first + i; those from most_ranked_samples on are left out.
  void add(const Table& rows, std::int64_t first);

  // Words of several may be added element by element.
  parallel::Words words() const { return tally_.words(); }
  void clear() { tally_ = fragility::RankingTally(tally_.options()); }
  parallel::Words normal(std::span<const std::int64_t> added) const {
    return fragility::RankingTally::from_words(tally_.options(), added).words();
  }

  // alike: so many of the first samples could be added.
  Ranking ranking(std::span<const std::int64_t> words, std::int64_t alike, std::int64_t swept) const;

 private:
  const Target& target_;
  std::vector<SampleIntensity> intensities_;
  fragility::RankingTally tally_;
};

// Of the samples that are kept and were taken whatever their intensity. On the root, the others get an empty one; the same to the bit on
// any number of ranks. Collective.
Ranking rank_intensities(const parallel::Communicator&, const Study&, const Target&, const io::SampleReader&);

nlohmann::ordered_json ranking_json(const Ranking&);
std::string ranking_csv(const Ranking&);

// A line a demand: the best, and how the study's own does beside it. `all`: the whole table.
std::string ranking_text(const Ranking&, const Study&, bool all);

}  // namespace freestand::study
