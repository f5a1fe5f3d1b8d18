// What a fragility analysis found: plain values, ready to be written to files. Everything that is not known is NaN.
// Shapes are given as [rows, columns], stored row by row.
#pragma once

#include <array>
#include <cstdint>
#include <freestand/response.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace freestand::fragility {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

enum class BinStatus : int {
  fitted = 0,   // lognormal fit that is off by at most Options::adequate, and half of Options::half_width
  too_few = 1,  // fewer samples than the minimum: the row of the surface is empty
  // The row of the surface is the empirical one where the fit may be off by more and fails goodness of fit,
  rejected = 2,
  // where too few moved and stood for a fit, or no lognormal has so heavy a tail (or the EDP is binary),
  counts_only = 3,
  // and where the fit may be off by more and passes.
  not_refuted = 4
};

// One IM bin of one EDP. Samples that failed numerically (painleve, step_limit, not_finite) are in none of the counts but
// n_failed.
struct BinFit {
  std::int64_t n = 0;        // samples in the bin = n_still + n_over + n_moved
  std::int64_t n_still = 0;  // EDP at or below its threshold (binary EDP: 0)
  std::int64_t n_over = 0;   // overturned: EDP censored
  std::int64_t n_moved = 0;  // moved and stood (binary EDP: 1 without overturning)
  std::int64_t n_failed = 0;
  int motions = 0;           // groups of motions that have samples here
  double im_mean = unknown;  // of the n samples

  // Intervals with motions as the unit (share_interval.hpp).
  double p_still = unknown, p_still_lower = unknown,
         p_still_upper = unknown;                                           // n_still/(n - n_over), given that it stood
  double p_over = unknown, p_over_lower = unknown, p_over_upper = unknown;  // n_over/n

  // Lognormal by maximum likelihood on the n_moved samples [KM05 5.21-5.25], the still ones known to lie at or below the
  // threshold (threshold_fit.hpp), at im_mean, about a line of that slope in ln EDP over ln IM; errors from resampled
  // motions.
  double lambda = unknown, lambda_se = unknown;
  double omega = unknown, omega_se = unknown;
  double slope = unknown;
  double p_never =
      unknown;  // of those that stood: share without any demand, beyond the lognormal's below the threshold
  double mean = unknown, standard_deviation = unknown;  // [KM05 5.24], unit of the EDP

  double ks_statistic = unknown;          // S [KM05 5.28-5.30]
  double ks_resolution = unknown;         // what the histogram may have made of S; granted to the fit, added to off_by
  double correlation = unknown;           // of ln EDP of two samples of one record
  double ks_p_textbook = unknown;         // as if lambda and omega were known beforehand: far too lax
  double ks_critical_textbook = unknown;  // at 5 %
  double ks_p_estimated = unknown;  // lambda and omega estimated from the same, correlated samples: the one to believe
  double ks_critical_estimated = unknown;
  double ad_statistic = unknown;    // Anderson-Darling A^2
  double ad_p_estimated = unknown;  // NaN where samples are correlated or cut off: then S alone is judged
  double off_by =
      unknown;  // upper 95 % bound of the misfit: the truth's largest difference in P from the nearest lognormal
  int fdr_rejected = 0;  // 1: rejected by ks_p_estimated with false discovery controlled over the bins
  BinStatus status = BinStatus::too_few;
};

// P(EDP > C), [im, capacity]. `probability` is the one to use (fit or empirical by BinStatus), lower and upper its band
// from resampled motions, `empirical` the plain fraction of samples above C, overturned ones included: of the whole bin, where the fit is
// of the IM at which the bin stands.
struct Surface {
  std::vector<double> probability, lower, upper, empirical;
  std::vector<double> least, most;  // of `empirical`, had every sample that failed stayed below, or lain above
  std::vector<double> empirical_lower, empirical_upper;  // its interval (share_interval.hpp)
  // `empirical` from resampled motions [resample, im, capacity], and without a group of motions [left out, im, capacity]: for bands of
  // what is computed from several points.
  std::vector<double> resampled, left_out;
};

// P(EDP > C) over IM x a second axis, from counts, with band from resampled motions. All [im, axis, capacity] but n
// [im, axis]. A cell stands at `centre`, the mean of its samples of all bins (its middle where it has none).
struct AxisSurface {
  std::string name, unit;
  std::vector<double> edge, centre;
  std::vector<double> probability, lower, upper;
  std::vector<std::int64_t> n;
};

// Histogram of ln(EDP) of the samples that moved and stood, coarsened for pictures: count [im, cell], cell i between
// ln_edge[i] and ln_edge[i + 1].
// Demands are those at the mean IM of the bin.
struct Distribution {
  std::vector<double> ln_edge;
  std::vector<std::int64_t> count;
};

// Regressions of one EDP on IM over the samples that moved and stood and have IM > 0; errors from resampled motions.
struct Regressions {
  std::int64_t n = 0;
  double slope = unknown, slope_se = unknown,
         slope_r2 = unknown;  // EDP = slope IM, least squares through the origin [KM05 5.17-5.20]
  double sd_slope = unknown, sd_slope_se = unknown;  // standard deviation = sd_slope IM [KM05 5.20, 8.2]
  double bin_mean_slope = unknown,
         bin_sd_slope = unknown;  // the same two through the mean and standard deviation of the fitted bins
  double cloud_intercept = unknown, cloud_slope = unknown, cloud_sd = unknown,
         cloud_r2 = unknown;  // ln EDP = a + b ln IM +- sd
  double cloud_intercept_se = unknown, cloud_slope_se = unknown, cloud_sd_se = unknown;
};

// One curve over all intensities, of overturning or of P(EDP > C): Phi(ln(IM/median)/dispersion), maximum likelihood,
// penalised (Firth/Jeffreys) where the outcomes separate. NaN where no sample or every sample lies above, or where the
// share above does not grow with IM.
struct FragilityFunction {
  double median = unknown, dispersion = unknown;        // unit of IM, 1
  double median_se = unknown, dispersion_se = unknown;  // from resampled motions
  bool penalised = false;
  // The intensities swept: mean IM of the lowest and of the highest fine cell that holds samples. A median outside of
  // them is an extrapolation.
  double im_least = unknown, im_most = unknown;
  bool extrapolated = false;
  // Largest |curve - counted share| over the bins with enough samples, or over parts of them where these refute it, in which of them (its
  // mean IM), and the chance of a larger one if the curve were true, from resampled motions.
  double misfit = unknown, misfit_im = unknown, misfit_p = unknown;
  // The true shares of bins are off the curve by no more, with Options::confidence: the misfit, and as much as resampled misfits scatter
  // about it. Within a bin, where samples are too few to show it, or in a step narrower than an eighth of it, it may be more. NaN where two
  // bins or less have shares: a lognormal meets any two.
  double off_by = unknown;
  // The chance of annual rates as far from those of the counts if the curve were true (small_shares.hpp).
  double rate_p = unknown;
  // It may stand for the counts: off_by is at most Options::adequate, and rates do not refute it (rate_p).
  bool adequate = false;
  // Where the curve is not adequate: the shares of fine cells of IM, their samples, and the mean IM of each. Else none, as where no cell has
  // enough samples.
  std::vector<double> cell_im, cell_n, cell_share;
  std::vector<double> grid;                       // IM, from the first positive edge to the last
  std::vector<double> probability, lower, upper;  // [grid], band from resampled motions
  std::vector<double> resampled_median,
      resampled_dispersion;                                  // [resample], of the same resampled motions for each curve
  std::vector<double> left_out_median, left_out_dispersion;  // [left out], without a group of motions
  std::vector<double> resampled_cell_share,
      left_out_cell_share;  // [resample or left out, cell], the same of cell_share
};

struct EdpResult {
  std::string name, unit, symbol;
  bool binary = false;
  std::vector<BinFit> bins;      // one per IM bin
  std::vector<double> capacity;  // unit of the EDP
  Surface surface;
  std::vector<FragilityFunction> functions;  // [capacity], over IM
  Distribution distribution;                 // empty for a binary EDP
  std::vector<AxisSurface> axes;
  Regressions regressions;  // NaN for a binary EDP
};

// Of ln EDP of every two demands that take capacities, in each bin (covariance.hpp): [im, edp, edp].
struct Covariance {
  std::vector<std::string> edps;
  std::vector<double> ln_covariance;
  std::vector<std::int64_t> n;  // samples that moved by both, and stood
};

struct Result {
  std::string im_name, im_unit;
  std::optional<double> im_period_s = {}, im_damping = {};  // of the oscillator of a spectral intensity
  std::vector<double> im_edge;                              // n + 1
  std::vector<double> im;  // n: where a bin stands, the mean IM of its samples (its middle where it has none)
  // How the intensities of a bin are spread: as many fine cells a bin, bin by bin, each with the mean IM of its samples (its middle where it has
  // none).
  std::vector<double> cell_im;
  std::vector<std::int64_t> cell_n;
  double confidence = 0.95;
  int resamples = 0;                                         // of the motions
  std::array<std::int64_t, outcome_count> outcome_counts{};  // in the order of Outcome
  std::int64_t samples = 0;                                  // all, = sum of outcome_counts
  std::int64_t outside_im = 0;                               // sound samples whose IM is in no bin (or not a number)
  int motions = 0;                                           // groups of motions that have samples
  int left_out_records = 0;  // of the groups that are left out in turn the first ones, which are of records
  std::vector<EdpResult> edps;
  FragilityFunction overturning;
  Covariance covariance;
  std::vector<std::string> warnings;  // plain sentences
};

}  // namespace freestand::fragility
