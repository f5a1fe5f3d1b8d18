// Table 7.1: quarter-scale wooden blocks on the shake table, overturned or not. The 18 rows of the two sound blocks, 16 of
// them under motions whose records may be there; the motion of a 6th floor is not.
//
// The motions of the table itself are not published, so an ensemble stands for what the print does not tell:
//   motion     the record, its times halved, scaled to the printed peak table acceleration (PTA) within 3 %
//   component  printed for one motion only (FP): fault-normal or fault-parallel with equal chance; or, "after the
//              others", with the chance that the other rows under the same motion leave to either
//   friction   0.68 within 10 %;  impact: 0.9 to 1 of Housner's rate
//   block      a uniform box of the prototype's size / 4, turning about its narrower side
// A peak says little of what overturns a block, and a table does not follow a record's high frequencies. So the same records
// are also taken smoothed (half power at 20 Hz and 10 Hz of the table's time), then scaled to the same PTA. The band of the
// table is not known: the three answers stand side by side, none of them is fitted.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "report/item.hpp"
#include "report/station_motions.hpp"

namespace freestand::report {

struct BlockTest {
  std::string block, motion;
  double pta_g, mu;
  bool overturned, working_model_overturned;  // in the experiment, by the report's own model
};
std::vector<BlockTest> sound_tests(const Sources&);

struct Sides {
  double height_m, narrow_m, wide_m;
};
std::map<std::string, Sides> quarter_scale_blocks(const Sources&);

struct Prediction {
  BlockTest test;
  const Station* station;
  bool parallel_only;
  double normal, parallel;  // shares of the ensemble that overturn under either component

  double likelihood(bool along) const;
  double mixed(double parallel_weight) const;
};
inline constexpr std::size_t ensemble_members = 400;  // under each component

// Of the tests that have a station. Throws Error (Exit::data) where a record is missing.
std::vector<Prediction> predict(const Sources&, const std::filesystem::path& records, double half_power_hz,
                                double Sides::*width);

// Weight of the fault-parallel component after the other tests under that motion.
double weight_after_others(const std::vector<Prediction>& all, const Prediction& one);

// Means of (probability - outcome)^2 (a coin gets 0.25), how many are on the right side of one half, and mean probabilities.
struct Score {
  double brier = 0, brier_after_others = 0;
  double forma = 0, kelvinator = 0;
  int agree = 0, agree_after_others = 0, working_model_agrees = 0;
};
Score score(const std::vector<Prediction>&);

}  // namespace freestand::report
