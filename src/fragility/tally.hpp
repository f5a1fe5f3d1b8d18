// What is kept of the samples: counts and exact sums, by bin and by motion. A tally is a pure function of the set of
// samples: any split over ranks and blocks, added and merged in any order, gives the same bits. Its size is fixed by
// the options.
#pragma once

#include <cstdint>
#include <freestand/response.hpp>
#include <functional>
#include <span>
#include <vector>

#include "base/exact_sum.hpp"
#include "base/table.hpp"
#include "fragility/groups.hpp"
#include "fragility/options.hpp"
#include "fragility/tally_layout.hpp"

namespace freestand::fragility {

struct Sample {
  std::uint64_t index = 0;  // number of the sample in the study
  double im = 0;
  int motion = 0;  // index of the motion in the study
  Outcome outcome = Outcome::at_rest;
  std::span<const double> edp;  // one a demand parameter, in the order of Options::edps; NaN: not known for this sample
  std::span<const double> axis;  // one an axis, in the order of Options::axes
};

// Samples of one EDP, one bin and one group of motions.
struct Counts {
  std::int64_t n = 0, still = 0, over = 0, moved = 0;
  std::int64_t without_ln_im = 0;                                // moved ones at an IM that is not above 0
  double sum_ln = 0, sum_ln2 = 0;                                // of the moved ones
  double sum_ln_im = 0, sum_ln_im2 = 0, sum_ln_times_ln_im = 0;  // of those of them whose IM is above 0
};

// Fine IM cell of the curves over IM and of the mean IM of a bin.
struct ImCell {
  std::int64_t n = 0;
  double im_sum = 0;
};

// Sums over the samples of one EDP that moved and stood and have IM > 0: x = IM, y = EDP.
struct RegressionSums {
  std::int64_t n = 0;
  double x = 0, y = 0, xx = 0, xy = 0, yy = 0, lx = 0, ly = 0, lxlx = 0, lxly = 0, lyly = 0;
  double unit = 1;  // y is in this many units of the EDP
};

// Sums over the samples of a bin that moved by both of two EDPs and stood, and have IM > 0: m = ln IM, a, b = ln EDP.
struct PairSums {
  std::int64_t n = 0;
  double m = 0, mm = 0, a = 0, b = 0, ab = 0, am = 0, bm = 0;
};

class Tally {
 public:
  // Throws Error listing everything that is wrong with the options.
  explicit Tally(Options options);

  // An intensity of 1e12 and more is outside, an EDP of 1e12 times its first capacity and more is not known. Samples that failed numerically are
  // counted by outcome and by bin, and enter nothing else. Overturned ones have no EDP, where it
  // is censored, and count as above every capacity; others (did the connection break?) they have.
  void add(const Sample& sample);

  // Every row of a table with the columns im_<name>, edp_<name>, outcome, those of the axes, and motion where
  // Options::motion_group is not empty. Row i is sample first_sample + i; those that were passed over are left out. Throws Error if a
  // column is missing.
  // `keeps`: which samples count; without it all.
  void add(const Table& table, std::uint64_t first_sample, const std::function<bool(std::uint64_t)>& keeps = {});

  // Throws Error if the other tally has another shape.
  void merge(const Tally& other);

  // The whole tally as words, for messages. Words of tallies with the same options may be added element by element (by
  // MPI_SUM, say, up to 2^30 of them), which is the same as merging.
  std::vector<std::int64_t> words() const;
  static Tally from_words(Options options, std::span<const std::int64_t> words);

  const Options& options() const { return options_; }
  const MotionGroups& groups() const { return groups_; }
  const TallyLayout& layout() const { return layout_; }

  std::int64_t count_of(Outcome outcome) const;
  std::int64_t outside_im() const;              // sound samples whose IM is in no bin
  std::int64_t failed(std::size_t bin) const;   // samples that failed, by their IM
  std::int64_t missing(std::size_t edp) const;  // sound samples, in a bin, that have no value of this EDP
  std::int64_t samples() const;                 // all
  std::vector<bool> groups_with_samples() const;

  Counts counts(std::size_t edp, std::size_t bin, std::size_t group) const;
  std::int64_t exceeding(std::size_t edp, std::size_t bin, std::size_t group, std::size_t capacity) const;
  std::span<const std::int64_t> histogram(
      std::size_t edp,
      std::size_t bin) const;  // of ln(EDP) less the pilot's line, moved ones; histogram.hpp
  std::int64_t axis_n(std::size_t edp, std::size_t axis, std::size_t bin, std::size_t cell, std::size_t group) const;
  std::int64_t axis_exceeding(std::size_t edp, std::size_t axis, std::size_t bin, std::size_t cell, std::size_t group,
                              std::size_t capacity) const;
  double mean_on_axis(std::size_t axis, std::size_t cell) const;  // of all sound samples in it and in a bin; else NaN
  ImCell im_cell(std::size_t cell) const;
  double mean_im(std::size_t bin) const;  // of all sound samples in it; NaN where there is none
  std::int64_t im_cell_n(std::size_t cell, std::size_t group) const;
  std::int64_t im_cell_over(std::size_t cell, std::size_t group) const;
  // Of an EDP that takes capacities: moved and stood; and stood still.
  std::int64_t moved_in_cell(std::size_t edp, std::size_t cell, std::size_t group) const;
  std::int64_t still_in_cell(std::size_t edp, std::size_t cell, std::size_t group) const;
  // Of one EDP: samples, then those above each capacity.
  std::span<const std::int64_t> im_cell_of(std::size_t edp, std::size_t cell, std::size_t group) const;
  PairSums pair(std::size_t bin, std::size_t i, std::size_t j) const;  // of TallyLayout::paired, i <= j
  RegressionSums regression(std::size_t edp) const;
  RegressionSums regression(std::size_t edp, std::size_t group) const;

  bool operator==(const Tally& other) const { return count_ == other.count_ && sum_ == other.sum_; }

 private:
  struct Place {  // of a sample; ln_im only where IM lies above 0
    std::size_t bin, cell, group;
    double ln_im;
  };
  void add_pairs(const Place&, const Sample& sample);
  void add_edp(std::size_t edp, const Place&, const Sample& sample);
  void add_regression(std::size_t edp, const Place&, double im, double value);
  double residual(std::size_t edp, std::size_t bin, double im, double ln_value) const;

  Options options_;
  MotionGroups groups_;
  TallyLayout layout_;
  std::vector<std::vector<double>> capacity_;  // [edp]
  std::vector<std::int64_t> count_;
  std::vector<ExactSum> sum_;
};

}  // namespace freestand::fragility
