// From a fragility result and a hazard curve to annual rates: by the fitted function and by the binned counts, each with its band, and
// which of the two to use.
#pragma once

#include <string>
#include <vector>

#include "decision/hazard.hpp"
#include "fragility/result.hpp"

namespace freestand::decision {

// A rate and its band, by leaving out groups of motions: the curve without each is integrated by itself, since a band of a sum is no sum
// of bands. A rate scatters askew and the fewer motions make it the worse its error is known, so the interval is laid in ln rate with
// Student's t and as many degrees of freedom as the left out rates show (jackknife_of_positive). Where one group makes all of the rate
// the percentiles of resampled motions stand in. NaN: not known.
//
// By counts the exact binomial limits of bins in which nothing was counted come on top. There the least upper limit of the bin and of
// those at higher intensities is taken: P is taken not to fall as the intensity rises. That holds here, where the intensity is one of
// the floor's motion (PGA, PGV, Sa) and the specimens and motions are the same at each; over the report's PTA/(mu g) - 1 it need not,
// and surfaces keep each bin's own limits.
//
// Measured by simulation, bands of nominal 90 %, 25 samples a record, half to two thirds of the variance between records, hazard slopes 1.5
// and 2.5, 1500 repeats each (error 0.008; tests/decision/risk_test.cpp): by the function they hold the truth in 0.90 to 0.91 of the cases
// with 40 records and in 0.86 to 0.88 with 14, where too few are left to show how askew the rate scatters; by counts in 0.93 to 0.97
// with 40 and 0.90 to 0.95 with 14, never with the truth above the band: limits of bins in which nothing was counted are one-sided, and
// where such intensities come often they alone make the upper limit.
struct Rate {
  double value = fragility::unknown, lower = fragility::unknown, upper = fragility::unknown;
};

enum class By { function, counts };

struct RiskRow {
  std::string edp, unit;
  double capacity = fragility::unknown;  // NaN: the demand is yes or no
  Rate by_function, by_counts;
  By recommended = By::function;
  std::string why;            // the recommended one is
  bool rates_differ = false;  // the function is adequate in probability, but its rate is not that of the counts
  // Of the rate: what extrapolated fragility gives for intensities outside of the sweep; what may come from intensities outside of the
  // hazard curve (above its end at most as many events as it has there; below its start by its slope there).
  double outside_sweep = fragility::unknown, outside_hazard = fragility::unknown;
  std::string refused;                    // why no rate is told; empty: one is
  std::vector<double> share;              // [interval of intensity], of the recommended rate
  double median_im = fragility::unknown;  // half of the rate comes from larger intensities

  const Rate& rate() const { return recommended == By::function ? by_function : by_counts; }
};

struct Risk {
  std::string im, im_unit;
  double confidence = 0.95;
  double im_least = 0, im_most = 0;  // swept
  std::vector<double> edge;          // of the intervals of intensity; what comes from beyond the last is in the last
  std::vector<RiskRow> rows;
  std::vector<std::string> warnings;
};

// A rate is told in two digits, so that a change of less than a twentieth does not reach the first of them: if more may come from where
// nothing was computed, it is warned of. If more than half may, most of the number would be a guess: it is refused.
inline constexpr double outside_to_warn_of = 0.05, outside_to_refuse = 0.5;

// Every demand and capacity of the result. The fitted function is recommended where it is adequate (FragilityFunction) and its rate is that
// of the counts, as far as leaving motions out of both can tell; the counts elsewhere. "Adequate" is a difference of probabilities: where
// these stay small it says nothing of a rate. The hazard must be over the result's intensity. Throws Error (Exit::usage) where sweep and hazard
// curve share no intensity.
Risk risk(const fragility::Result&, const HazardCurve&);

// "peak_slip_m > 0.1 m", "overturned"
std::string title(const RiskRow&);

}  // namespace freestand::decision
