// Groups of samples that share a motion. Samples that share a record are not independent, so intervals come from
// resampling the motions, and everything they need is counted by group.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "fragility/options.hpp"

namespace freestand::fragility {

// The samples of a group of records are one group (beyond 256 of them they are joined, whole ones to a group). A pulse
// sample is a motion of its own: a hash of its index puts it in one of 128 groups, which resample like the samples
// themselves and keep memory bounded; with scrambles, each of these designs is a group, since samples of one design are
// spread evenly, and so more alike to those of another than independent ones. Where all records are one group they are treated in the same
// way: the bands then say how well the answer for these records is known, and nothing about others.
class MotionGroups {
 public:
  explicit MotionGroups(const Options& options);

  int count() const { return record_groups_ + hashed_groups_; }
  int record_groups() const { return record_groups_; }  // groups 0 ... record_groups() - 1 are records, the rest hashed
  bool designs() const { return scrambles_ > 1; }       // each hashed group is a design by itself
  int records() const { return records_; }              // groups of records that the study has

  // motion: index of the motion in the study (ignored where Options::motion_group is empty); sample: its number.
  // Throws Error for a motion that the options do not know.
  int group(int motion, std::uint64_t sample) const;

 private:
  std::vector<int> record_group_;  // by motion; -1: hashed
  int records_ = 0, record_groups_ = 0, hashed_groups_ = 0;
  std::uint64_t scrambles_;
};

// Bootstrap weights: how often each group is drawn in each resample. Groups are drawn with replacement among the groups
// that have samples, records among records and hashed groups among hashed ones, so that the mix of the study is kept.
class Resampling {
 public:
  Resampling(const MotionGroups& groups, const std::vector<bool>& has_samples, int resamples, std::uint64_t seed);

  int resamples() const { return static_cast<int>(weight_.rows()); }

  // Quantities counted by group, [group, quantity] -> their totals in each resample, [resample, quantity].
  Eigen::MatrixXd totals(const Eigen::MatrixXd& by_group) const { return weight_ * by_group; }

  // The same with groups left out in turn (LeaveOutGroups, those that have samples), [left out, quantity]; the others of its stratum
  // count more instead, so that the mix of the study is kept. The first left_out_records() of them are records.
  Eigen::MatrixXd totals_left_out(const Eigen::MatrixXd& by_group) const { return left_out_ * by_group; }
  int left_out() const { return static_cast<int>(left_out_.rows()); }
  int left_out_records() const { return left_out_records_; }

 private:
  void leave_out(const MotionGroups& groups, const std::vector<bool>& has_samples);

  Eigen::MatrixXd weight_;    // [resample, group]
  Eigen::MatrixXd left_out_;  // [left out, group]
  int left_out_records_ = 0;
};

}  // namespace freestand::fragility
