// Channels in another unit than their name says.
#pragma once

#include <string>
#include <vector>

#include "measurement/fit/model_fit.hpp"

namespace freestand::measurement {

// Units that stand for one another by mistake, over each other: of lengths (m, cm, mm, in, ft), and of angles.
bool is_ratio_of_units(double factor);
bool is_in_a_unit(double factor);  // one of these, or 1

struct OtherUnit {
  std::size_t test = 0;
  std::string sentence;
};

// Channels of single tests that are the model's, but for a factor between two units: as measured far from it, and near to noise where they are
// read in the other. Only where the model is right for most of the tests: what it lacks may make ten times the slip as well. told: of each
// test, is its slip known to be in another unit already?
std::vector<OtherUnit> other_units(const Bench&, const ModelFit&, const std::vector<bool>& told);

// Peaks of a whole set in another unit: does the base, refitted to slips or to rotations read in the other, miss tests left out by less than
// whatever was fitted to them as they stand (least_left_out, the mean score)? It has no more numbers than the base, and fewer than any effect.
// And by more than chance: were that as good, the ratio of their mean squares would be Fisher's F, and so many readings are tried.
struct UnitOfPeaks {
  std::string told;  // empty: no
  double factor = 1;
  bool may_be_physical() const;  // what holds a specimen back makes as much
};
UnitOfPeaks peaks_in_another_unit(const Bench&, const ModelFit& base, double least_left_out, const Effort&,
                                  const Jobs&);

}  // namespace freestand::measurement
