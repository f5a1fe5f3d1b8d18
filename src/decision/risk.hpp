// From a fragility result and a hazard curve to annual rates: by the fitted function and by the binned counts, each with its band, and
// which of the two to use.
#pragma once

#include <string>
#include <vector>

#include "decision/hazard.hpp"
#include "fragility/result.hpp"

namespace freestand::decision {

// A rate and its band from resampled motions: the curve of each resample is integrated by itself, since a band of a sum is no sum of
// bands. NaN: not known.
struct Rate {
  double value = fragility::unknown, lower = fragility::unknown, upper = fragility::unknown;
};

enum class By { function, counts };

struct RiskRow {
  std::string edp, unit;
  double capacity = fragility::unknown;  // NaN: the demand is yes or no
  Rate by_function, by_counts;
  By recommended = By::function;
  std::string why;  // the recommended one is
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

// Every demand and capacity of the result. The fitted function is recommended where it is adequate (FragilityFunction), the counts
// elsewhere. The hazard must be over the result's intensity. Throws Error (Exit::usage) where sweep and hazard curve share no intensity.
Risk risk(const fragility::Result&, const HazardCurve&);

// "peak_slip_m > 0.1 m", "overturned"
std::string title(const RiskRow&);

}  // namespace freestand::decision
