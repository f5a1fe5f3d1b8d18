// Demand as a function of intensity over the whole range: the report's straight lines through the origin, and the ln-ln
// cloud.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fragility/result.hpp"
#include "fragility/tally.hpp"

namespace freestand::fragility {

// EDP = slope IM by least squares through the origin [KM05 5.17-5.20, 8.1-8.2]:
//   slope = sum(x y)/sum(x^2),
//   sd_slope = sqrt(sum((y - slope x)^2)/sum(x^2)), so that the standard deviation of the demand is sd_slope IM,
//   r2 = squared correlation of x and y.
// With the best-fit friction of the report's Table 5.1 this gives 0.672, 0.413 and 0.196. Equal lengths, at least two,
// not all x zero; otherwise throws Error.
struct LinearDemand {
  double slope, sd_slope, r2;
};
LinearDemand fit_linear_demand(std::span<const double> im, std::span<const double> edp);

// The lognormal distribution of the demand at one intensity (> 0) under that model, mean slope IM and standard
// deviation sd_slope IM: P(EDP <= x) and P(EDP > C) [KM05 5.24, 5.33].
double linear_demand_cdf(const LinearDemand& model, double im, double edp);
double linear_demand_exceedance(const LinearDemand& model, double im, double capacity);

// F(edp_i | im_i) of each pair, increasing: what the report's goodness-of-fit test is made on [KM05 5.28-5.30].
std::vector<double> linear_demand_transform(const LinearDemand& model, std::span<const double> im,
                                            std::span<const double> edp);

// S of `repeats` simulated data sets with the intensities given: demands drawn from the model, slope and sd_slope
// fitted anew, S measured with these; increasing. The null distribution of S for a line whose slopes come from the same
// data.
std::vector<double> linear_demand_null(const LinearDemand& model, std::span<const double> im, int repeats,
                                       std::uint64_t seed);

// ln EDP = intercept + slope ln IM, with residual standard deviation sd (divisor n - 2) and r2. All values > 0, at
// least three.
struct Cloud {
  double intercept, slope, sd, r2;
};
Cloud fit_cloud(std::span<const double> im, std::span<const double> edp);

// All of them from the sums of a tally, and the lines through the origin over the bins that were fitted (mean and
// standard deviation of a bin against its mean IM, bins of equal weight).
Regressions regressions(const RegressionSums& sums, std::span<const BinFit> bins);

// The same of a tally, with standard errors from resampled motions.
Regressions regressions(const Tally& tally, std::size_t edp, const Resampling& resampling,
                        std::span<const BinFit> bins);

}  // namespace freestand::fragility
