// Made-up studies whose demand is lognormal, with samples that share records.
#pragma once

#include <cmath>

#include "fragility/draws.hpp"
#include "fragility/fit.hpp"
#include "fragility/tally.hpp"

namespace freestand::fragility::test {

using namespace freestand::test;

// One bin or more of a lognormal demand with median 1; `records` motions of `each` samples; the logarithm varies by
// `between` from record to record and by `within` from sample to sample.
struct Study {
  int records, each;
  double between, within;
  double overturned = 0;  // chance that a record overturns all of its samples
};

inline Options options(int records, bool group_by_record = true) {
  Options o;
  o.im_name = "pga";
  o.im_edge = {0, 1};
  o.edps = {{"delta", "1", "Delta", false, 0, {0.5, 1, 2}}};
  o.resamples = 200;
  for (int i = 0; group_by_record && i < records; ++i) o.motion_group.push_back(i);
  return o;
}

inline Tally counted(const Options& options, const Study& study, std::uint64_t stream) {
  Tally tally(options);
  std::uint64_t i = 0;
  for (int r = 0; r < study.records; ++r)
    for (int k = 0; k < study.each; ++k, ++i) {
      const double shift = study.between * normal(static_cast<std::uint64_t>(r), stream + 1000000);
      const double value = std::exp(shift + study.within * normal(i, stream));
      const bool over = uniform(static_cast<std::uint64_t>(r), stream + 3000000) < study.overturned;
      tally.add({i, uniform(i, stream + 2000000), r, over ? Outcome::overturned : Outcome::moved, {&value, 1}, {}});
    }
  return tally;
}

}  // namespace freestand::fragility::test
