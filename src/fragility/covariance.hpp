// How demands vary together: covariances of ln EDP in each bin, about their lines over ln IM.
#pragma once

#include "fragility/result.hpp"
#include "fragility/tally.hpp"

namespace freestand::fragility {

// Of every two demands that take capacities, over the samples of a bin that moved by both and stood, and have IM > 0:
// cov(a, b) - cov(a, m) cov(b, m) / var(m), m = ln IM, with n - 2 in place of n (n - 1 where IM does not vary). NaN where
// fewer than Options::minimum_samples did.
Covariance covariance(const Tally& tally);

}  // namespace freestand::fragility
