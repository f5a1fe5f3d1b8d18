// From a fragility result and a hazard curve to annual rates: by the fitted function and by the binned counts, each with its band, and
// which of the two to use.
#pragma once

#include <string>
#include <vector>

#include "decision/hazard.hpp"
#include "fragility/result.hpp"

namespace freestand::decision {

// A rate and its band, by leaving out groups of motions: the curve without each is integrated by itself, since a band of a sum is no sum
// of bands. A rate scatters askew and the fewer motions make it the worse its error is known: so the curve's median and dispersion have
// their own limits, joined in ln rate (CurveReach). Where there is no curve the interval is laid in ln rate with Student's t and as many
// degrees of freedom as the left out rates show (PositiveLimits), where one group makes all of the rate by resampled motions. NaN: not
// known.
//
// By counts the exact binomial limits of bins in which nothing was counted come in beside (largest_beside_nothing). There the least upper
// limit of the bin and of those at higher intensities is taken: P is taken not to fall as the intensity rises. That holds here, where the
// intensity is one of the floor's motion (PGA, PGV, Sa) and the specimens and motions are the same at each; over the report's PTA/(mu g) -
// 1 it need not, and surfaces keep each bin's own limits.
//
// By simulation, bands of nominal 90 %, ten bins, 25 samples a record, a tenth to six sevenths of the variance between records
// (dispersions 0.15 and 0.4, 0.25 and 0.35, 0.35 and 0.25, 0.5 and 0.2), medians 0.25, 0.6, 1.5, hazard slopes 1.5 and 2.5; 4000 repeats
// with 14 records, 2500 with 40, 1500 with 100 (error 0.005 to 0.008), errors of median and dispersion taken as independent: by the function
// they hold the truth in 0.885 to 0.907 of the cases with 14 records, in 0.897 to 0.924 with 40, in 0.901 to 0.919 with 100. With what groups
// tell of errors that go together (CurveReach; dispersions 0.35 and 0.25, medians 0.6 and 1.5, 500 repeats, error 0.014) in 0.874 to 0.898 with
// 14 and 0.890 to 0.904 with 40, and where a sweep of pulses begins near the median in 0.88 of 120 for 0.82. By
// counts with dispersions 0.35 and 0.25 and medians 0.6 and 1.5 (2000 repeats, error 0.006) in 0.918 to 0.929 with 14, 0.913 to 0.925 with
// 40. The exact upper limit of bins in which nothing was counted is never crossed while P is small there, at whatever confidence (each
// P from 0 to it leaves a count of nothing likely), so all misses are below.
//
// That limit is wide where events are rare, and is no artefact of its making: it is the lowest intensity's alone, 1 - tail^(1/motions) of
// hundreds of times as many events as at the median. More motions lower it, more samples do not. A shape of P would: if it falls below the
// lowest intensity at which any exceeded as the fitted curve does, the limit is upper_if_falling. But no count tells that it does: where one
// record in twenty has 0.3 of the others' median it misses the truth far too often. So it is told beside the limit, not in its place. By
// simulation (tests/decision/upper_limit_test.cpp, ten bins from 0.05, hazard slope 2.5, tail 0.05, 300 repeats) both over the true rate:
//
//   records  median  weak records  upper limit  missed  if P falls  missed
//   14       0.6     none          49           0.00    1.8         0.12
//   14       1.5     none          490          0.00    1.8         0.09
//   14       0.6     one in 20     25           0.00    1.8         0.31
//   40       0.6     none          19           0.00    1.4         0.09
//   40       1.5     none          190          0.00    1.4         0.06
//   40       1.5     one in 20     96           0.00    1.8         0.25
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
  // By counts: the upper limit if P falls as the fitted curve does where nothing was counted; NaN where it is not half of the other.
  double upper_if_falling = fragility::unknown;
  bool rates_differ =
      false;  // by the function and by the counts, more than chance explains (FragilityFunction::rate_p)
  // What extrapolated fragility gives for intensities outside of the sweep: by the function a share of the rate, by counts what is missing
  // from it, as its lowest shares fall and at most above it, as a share of both together. Of the rate: what may come from intensities outside of the
  // hazard curve (above its end at most as many events as it has there; below its start by its slope there).
  double outside_sweep = fragility::unknown, outside_hazard = fragility::unknown;
  std::string refused;        // why no rate is told; empty: one is
  std::vector<double> share;  // [interval of intensity], of the recommended rate
  double median_im =
      fragility::unknown;  // half of the rate comes from larger intensities; infinite: than the hazard curve's last

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

// Every demand and capacity of the result. The fitted function is recommended where it is adequate (FragilityFunction: near the counts in
// probability, and not refuted by their rates), the counts elsewhere: so do exports and databases. The hazard must be over the result's
// intensity. Throws Error (Exit::usage) where sweep and hazard curve share no intensity.
//
// An event that happens whenever another one does has at least its rate, so the upper limit of the inner one is at most that of the outer
// one, and the lower limit of the outer one at least that of the inner one: of capacities of one demand, and of overturning within the
// demands `with_overturned`, beyond every capacity of which a block that overturned is.
Risk risk(const fragility::Result&, const HazardCurve&, const std::vector<std::string>& with_overturned = {});

// "peak_slip_m > 0.1 m", "overturned"
std::string title(const RiskRow&);

}  // namespace freestand::decision
