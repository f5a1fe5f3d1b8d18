// Which intensity foretells a demand best. Of several intensities, over the same samples:
//   efficiency: how far ln(demand) of those that moved and stood scatters about a line over ln(IM) (standard deviation;
//     Luco & Cornell, Earthquake Spectra 23, 2007). Where IM is not above 0 it has no logarithm, and the demand scatters about
//     its mean over those samples: whatever an intensity is 0 for is held against it, and all are judged on the same samples;
//   sufficiency: does what is left still depend on the period of the pulse, on magnitude, on distance? A line of the mean
//     remainder of each motion over the property, with Student's p value of its slope: motions are the unit, not samples;
//   for what happens or not: the share of the deviance that a lognormal curve over IM explains (a share of its own where IM is not above
//     0), and the probability that of
//     two samples the one to which it happened had the higher IM.
// Standard errors by leaving out one of 20 folds of motions in turn (jackknife).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/exact_sum.hpp"
#include "fragility/result.hpp"

namespace freestand::fragility {

// A property of motions that a demand may depend on beside the intensity.
struct MotionProperty {
  std::string name;                // with unit suffix
  bool of_pulses = false;          // each sample has its own, as the period of a pulse; else each record
  std::vector<double> value = {};  // [motion], NaN: not known; empty where of_pulses
  bool logarithm = true;           // of its logarithm
};

struct RankedEdp {
  std::string name;
  bool binary = false;
  double still_threshold = 0;
  bool censored = true;
};

struct RankingOptions {
  std::vector<std::string> ims;
  std::vector<RankedEdp> edps;
  std::vector<int> motion_group;  // as Options::motion_group
  std::vector<MotionProperty> properties;
};

struct RankedSample {
  std::uint64_t index = 0;
  int motion = 0;
  bool overturned = false;      // only sound samples are ranked
  double pulse_period_s = 0;    // NaN for records
  std::span<const double> im;   // in the order of the options
  std::span<const double> edp;  // the same; NaN: not known
};

// Counts and exact sums, the same for any order of samples and any split of them over ranks. Its size depends on the
// numbers of intensities, demands and motions.
class RankingTally {
 public:
  static constexpr std::size_t folds = 20;
  static constexpr std::size_t cells = 400;  // of ln IM, each a ratio of 1.04

  explicit RankingTally(RankingOptions options);
  void add(const RankedSample& sample);

  std::vector<std::int64_t> words() const;  // may be added element by element
  static RankingTally from_words(RankingOptions options, std::span<const std::int64_t> words);

  const RankingOptions& options() const { return options_; }
  std::size_t units() const { return units_; }  // groups of records, then the folds of pulses
  std::size_t fold_of_unit(std::size_t unit) const { return unit < records_ ? unit % folds : unit - records_; }
  std::size_t record_units() const { return records_; }
  std::size_t unit_of_motion(std::size_t motion) const;  // of a record

  // Sums over the samples of a unit or a fold that moved and stood and have IM > 0: x = ln IM, y = ln EDP. Of `any_im` over all that moved
  // and stood, with x = 0.
  struct First {
    std::int64_t n = 0;
    ExactSum x, y;
  };
  struct Second {
    ExactSum xx, xy, yy;
  };
  // With z, the logarithm of the pulse's period, over all samples of pulses.
  struct WithPeriod {
    std::int64_t n = 0;
    ExactSum x, y, z, xz, yz, zz, xx, xy, yy;
  };
  struct Cell {
    std::int64_t n = 0, hits = 0;
  };
  std::size_t any_im() const { return options_.ims.size(); }
  const First& first(std::size_t edp, std::size_t im, std::size_t unit) const;
  const Second& second(std::size_t edp, std::size_t im, std::size_t fold) const;
  const WithPeriod& with_period(std::size_t edp, std::size_t im) const;
  const Cell& cell(std::size_t edp, std::size_t im, std::size_t fold, std::size_t i) const;
  static double im_of_cell(std::size_t i);  // 0 of the first, which holds those that are not above it

 private:
  std::size_t pair_of(std::size_t edp, std::size_t im) const { return edp * (options_.ims.size() + 1) + im; }
  void add_edp(std::size_t edp, std::size_t unit, bool of_pulse, const RankedSample& sample);

  RankingOptions options_;
  std::vector<int> unit_;  // [motion] of a record; -1 a family of pulses
  std::size_t records_ = 0, units_ = 0;
  std::vector<First> first_;
  std::vector<Second> second_;
  std::vector<WithPeriod> with_period_;
  std::vector<std::size_t> binary_;  // [edp] its number among the binary ones, which alone have cells
  std::vector<Cell> cell_;
};

struct Sufficiency {
  std::string property;
  int motions = 0;                                          // motions, or groups of them, that it was seen on
  double slope = unknown, slope_se = unknown, p = unknown;  // of ln(EDP) over the property or its logarithm
};

struct RankedIm {
  std::string im;
  std::int64_t samples = 0;  // that moved and stood; for what happens or not all sound ones
  std::int64_t with_im = 0;  // of them, those with IM > 0
  // Scatter of ln(EDP), or the share of deviance explained. Its standard error; how far it is behind the best one, and that
  // difference's own standard error. NaN with fewer than 5 folds that hold
  // samples.
  double value = unknown, value_se = unknown, behind = unknown, behind_se = unknown;
  double slope = unknown;  // of ln(EDP) over ln(IM)
  // Of what happens or not: probability that IM puts a pair in order. Between intensities at or below 0 the tally knows no order: half.
  double parts = unknown;
  std::vector<Sufficiency> sufficiency = {};
};

struct RankedDemand {
  std::string edp;
  bool binary = false;
  std::vector<RankedIm> ims;  // the best first
};

// One entry a demand of which some figure has a standard error: samples that moved in 5 folds or more; of what happens or not, 10
// to which it happened and 10 to which not as well.
std::vector<RankedDemand> rank(const RankingTally& tally);

}  // namespace freestand::fragility
