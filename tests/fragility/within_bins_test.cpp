// Curves that bend within a bin in another way than a lognormal through the bins' shares.
#include <gtest/gtest.h>

#include <cmath>

#include "fragility/draws.hpp"
#include "fragility/fragility_function.hpp"

namespace freestand::fragility {
namespace {

// Samples of pga from 0.1 to 2 in eight bins, of which so many are above at each: `share`.
template <class Share>
FragilityFunction of_eight_bins(const Share& share, std::uint64_t samples, std::uint64_t stream = 620) {
  Options options;
  options.im_name = "pga";
  options.edps = {{"overturned", "1", "", true, 0, {}}};
  options.resamples = 200;
  for (int k = 0; k <= 8; ++k) options.im_edge.push_back(0.1 + 1.9 * k / 8);
  Tally tally(options);
  for (std::uint64_t i = 0; i < samples; ++i) {
    const double im = 0.1 + 1.9 * test::uniform(i, stream), above = test::uniform(i, stream + 1) < share(im);
    tally.add({i, im, 0, above > 0 ? Outcome::overturned : Outcome::moved, {&above, 1}, {}});
  }
  return overturning_function(tally, Resampling(tally.groups(), tally.groups_with_samples(), options.resamples, 1));
}

// None at all below 0.225 and two thirds at 0.28, both in the lowest bin: a lognormal through the shares of the bins is within 0.03 of all of
// them, and off by 0.15 and more within the lowest.
TEST(WithinBins, WhatBendsWithinABinIsNoLognormal) {
  const auto share = [](double im) {
    const double at[] = {0, 0.225, 0.28, 0.3375, 0.4, 0.6, 0.9, 2.1}, known[] = {0, 0, 0.65, 0.74, 0.79, 0.88, 0.95, 1};
    int k = 1;
    while (at[k] < im) ++k;
    return std::lerp(known[k - 1], known[k], (im - at[k - 1]) / (at[k] - at[k - 1]));
  };
  for (const std::uint64_t samples : {2048u, 8192u, 131072u}) {
    const FragilityFunction curve = of_eight_bins(share, samples);
    EXPECT_FALSE(curve.adequate) << samples << ' ' << curve.off_by;
    EXPECT_FALSE(not_refuted(curve)) << samples;
    EXPECT_GT(curve.off_by, 0.09) << samples;
    EXPECT_GT(curve.misfit_im, 0.2) << samples;
    EXPECT_LT(curve.misfit_im, 0.34) << samples;
  }
}

// A true lognormal of which half is above at 0.3 rises as steeply there, and is rarely taken for anything else.
TEST(WithinBins, ALognormalThatRisesWithinABinIsOne) {
  constexpr int repeats = 60;
  int refuted = 0;
  for (std::uint64_t r = 0; r < repeats; ++r) {
    const FragilityFunction curve = of_eight_bins(
        [](double im) { return 0.5 * std::erfc(-std::log(im / 0.3) / 0.25 / std::sqrt(2.0)); }, 2048, 700 + 2 * r);
    refuted += !curve.adequate && !not_refuted(curve);
  }
  RecordProperty("refuted", refuted);
  EXPECT_LE(refuted, 14);  // by bins, by parts of bins or by rates, of 5 % each: 9 + 2 sqrt(9 * 0.85)
}

}  // namespace
}  // namespace freestand::fragility
