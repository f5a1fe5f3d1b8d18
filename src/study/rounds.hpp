// The rounds of a sweep with `until`: how far each goes, and the bins of intensity from which it takes samples.
//
// All samples of a round are drawn, and from the second one on those are passed over, without being integrated, that fall into bins
// which are known well enough, or in which more samples would hardly help (fragility::bins_that_want). Whether a sample is taken depends
// on its intensity alone, so that in each bin the samples are those that the study draws there, and all that is told of a bin is as without
// rounds. What is told of all intensities together is not: it comes from the rounds before the first one that leaves a bin out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/table.hpp"
#include "parallel/communicator.hpp"
#include "study/evaluator.hpp"
#include "study/intensities.hpp"
#include "study/study.hpp"
#include "study/target.hpp"

namespace freestand::study {

struct Round {
  std::int64_t end = 0;         // it goes up to this sample
  std::vector<bool> bins = {};  // from which it takes samples; empty: all, and what lies in none
};

// A list of rounds that survives the end of the program: what a round has taken is never decided anew.
class Rounds {
 public:
  // folder: of the unfinished work. fingerprint: of all that rounds follow from; those of another one are not known.
  Rounds(const parallel::Communicator&, const std::filesystem::path& folder, std::string fingerprint);

  void read();                                              // what earlier runs have stored. Collective.
  void only(Round round) { rounds_ = {std::move(round)}; }  // of a sweep that has one, which is stored nowhere
  void add(Round);  // stored before it begins. Collective. Throws Error: a full disk is Exit::cure.
  std::int64_t count() const { return static_cast<std::int64_t>(rounds_.size()); }
  const Round& operator[](std::int64_t i) const { return rounds_[static_cast<std::size_t>(i)]; }
  const Round& of(std::int64_t sample) const;  // the last one, of samples behind it

  // How many of the first samples were taken whatever their intensity.
  std::int64_t alike() const;

 private:
  parallel::Words stored() const;

  const parallel::Communicator& world_;
  std::filesystem::path file_;
  std::string fingerprint_;
  std::vector<Round> rounds_;
};

// Which samples a round takes.
class RoundBins {
 public:
  // Bins as the fit will lay them, over the draws of the first samples.
  RoundBins(const Study&, const Target&, const Evaluator&);

  // draws: rows with the columns that an intensity follows from.
  std::vector<bool> taken(const Round&, const Table& draws) const;

 private:
  SampleIntensity intensity_;
  std::vector<double> edge_;
  bool open_ends_;
};

}  // namespace freestand::study
