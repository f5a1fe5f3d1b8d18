// Exceedance surfaces of one demand parameter, with bands from resampled motions.
#pragma once

#include <span>
#include <vector>

#include "fragility/result.hpp"
#include "fragility/tally.hpp"

namespace freestand::fragility {

// IM x C. A row is the three-part fit of its bin, or the plain fraction of samples above C where the bin has no fit or
// (with Options::empirical_fallback) none that is known to be adequate, or empty where it has too few samples. Also sets the
// standard errors of the bins by resampling.
//
// A row of plain fractions has the interval of a share with motions as the unit (share_interval.hpp). A fitted row in which nothing overturned
// (or nothing stood still) also holds what may have gone unseen (largest_beside_nothing), where overturning censors the demand; what of
// its tail that limit does not need is the other's (unused_tail). By simulation, nominal 90 %, 40 records of 25 samples, half of the
// variance between records, 300 repeats (error 0.017): a fitted row of P = 0.16 holds the truth in 0.90 of the cases where nothing can
// overturn, in 0.91, 0.87 and 0.90 where half a record, one and two are expected to; of P = 0.06, below what 40 records of which none
// overturned allow, in 0.90, 0.96, 0.97 and 0.92. There one record more or less moves P by as much as the fit's error, and the band of
// none holds each P up to the limit, so that no interval comes nearer (tests/fragility/bands_test.cpp). Counted rows hold it in 0.90
// to 0.91, lambda in 0.88 (1500 repeats, error 0.008); a counted row with nothing in it, [0, 1 - tail^(1/motions)], always where P is within: no other interval that is right
// at the limit is shorter.
Surface surface(const Tally& tally, std::size_t edp, const Resampling& resampling, std::vector<BinFit>& bins);

// IM x axis x C, plain fractions.
AxisSurface axis_surface(const Tally& tally, std::size_t edp, std::size_t axis);

// Limits at capacities that increase: what exceeds one has exceeded those before, so that no upper limit lies above an earlier one and no
// lower one below a later one. (The fewer records exceed, the less their own count says: one of 20 has a higher limit than two.)
void nest(std::span<double> lower, std::span<double> upper);

}  // namespace freestand::fragility
