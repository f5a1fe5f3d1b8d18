// From a tally to everything that is reported: fits per bin, goodness of fit, surfaces with bands, overturning curve.
#pragma once

#include <string>

#include "base/jobs.hpp"
#include "fragility/goodness.hpp"
#include "fragility/result.hpp"
#include "fragility/tally.hpp"

namespace freestand::fragility {

// A pure function of the tally and its options (seed, resamples ...): the same bits every time. `null` only saves the
// time of simulating the same test statistics again when fits are repeated; it must carry the seed of the options to
// give the same. jobs: demands and curves are fitted by whoever they are given to.
Result fit(const Tally& tally, const Jobs& jobs = run_here);
Result fit(const Tally& tally, EstimatedNull& null, const Jobs& jobs = run_here);

// How well the surfaces IM x C are known, for `until: {half_width: ...}`: the largest (upper - lower)/2 over all points. A
// point without a band (too few samples, or too few motions) in a bin that the sweep does reach counts as unknown, which
// is a half width of 0.5; bins without a single sample are not wanted. 0.5 too if nothing has a band yet.
struct HalfWidth {
  double largest = 0.5;
  std::string edp;  // where that is
  double im = unknown, capacity = unknown;
  int points = 0;        // that have a band
  int empty_points = 0;  // that have none
};
HalfWidth half_width(const Result& result);

}  // namespace freestand::fragility
