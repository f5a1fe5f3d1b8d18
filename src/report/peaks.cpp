#include "report/peaks.hpp"

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <limits>
#include <numeric>
#include <set>

#include "base/units.hpp"
#include "fragility/goodness.hpp"
#include "fragility/intervals.hpp"
#include "fragility/jackknife.hpp"
#include "fragility/lognormal.hpp"

namespace freestand::report {
namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double determination(const Peaks& peaks, double slope) {
  const double middle = mean(peaks.delta);
  double residual = 0, total = 0;
  for (std::size_t i = 0; i < peaks.im.size(); ++i) {
    residual += std::pow(peaks.delta[i] - slope * peaks.im[i], 2);
    total += std::pow(peaks.delta[i] - middle, 2);
  }
  return 1 - residual / total;
}

// Points under one motion share what that motion does.
double slope_error(const Peaks& peaks) {
  const std::set<std::string> motions(peaks.motion.begin(), peaks.motion.end());
  if (motions.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> left_out;
  for (const std::string& motion : motions) {
    std::vector<double> im, delta;
    for (std::size_t i = 0; i < peaks.im.size(); ++i)
      if (peaks.motion[i] != motion) {
        im.push_back(peaks.im[i]);
        delta.push_back(peaks.delta[i]);
      }
    if (im.size() < 2) return std::numeric_limits<double>::quiet_NaN();
    left_out.push_back(fragility::fit_linear_demand(im, delta).slope);
  }
  return std::sqrt(fragility::jackknife_variance(left_out));
}

PeakBin bin_of(const std::vector<double>& im, const std::vector<double>& delta) {
  const fragility::LognormalFit lognormal = fragility::fit_lognormal(delta);
  return {.im_low = im.front(),
          .im_high = im.back(),
          .im = mean(im),
          .n = im.size(),
          .mean = mean(delta),
          .standard_deviation = fragility::standard_deviation(delta),
          .lambda = lognormal.lambda,
          .omega = lognormal.omega};
}

std::vector<PeakBin> bins_of(const Peaks& peaks) {
  std::vector<std::size_t> order(peaks.im.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return peaks.im[a] < peaks.im[b]; });
  const std::size_t count = order.size() / points_per_bin;
  std::vector<PeakBin> bins;
  for (std::size_t bin = 0; bin < count; ++bin) {
    std::vector<double> im, delta;
    for (std::size_t k = bin * order.size() / count; k < (bin + 1) * order.size() / count; ++k) {
      im.push_back(peaks.im[order[k]]);
      delta.push_back(peaks.delta[order[k]]);
    }
    bins.push_back(bin_of(im, delta));
  }
  return bins;
}

void through_bins(PeaksFit& fit) {
  std::vector<double> im, means, deviations;
  for (const PeakBin& bin : fit.bins) {
    im.push_back(bin.im);
    means.push_back(bin.mean);
    deviations.push_back(bin.standard_deviation);
  }
  const fragility::LinearDemand of_mean = fragility::fit_linear_demand(im, means),
                                of_sd = fragility::fit_linear_demand(im, deviations);
  fit.bin_slope = of_mean.slope;
  fit.bin_r2 = of_mean.r2;
  fit.bin_sd_slope = of_sd.slope;
  fit.bin_sd_r2 = of_sd.r2;
}

Sheet points_sheet(const std::string& name, const Peaks& peaks, const PeaksFit& fit) {
  Sheet sheet{
      name + "_points", {"specimen_and_motion", "im", "delta", "line", "standard_deviation", "probability_below"}, {}};
  for (std::size_t i = 0; i < peaks.im.size(); ++i)
    sheet.rows.push_back({name, peaks.label[i], peaks.im[i], peaks.delta[i], fit.line.slope * peaks.im[i],
                          fit.line.sd_slope * peaks.im[i],
                          fragility::linear_demand_cdf(fit.line, peaks.im[i], peaks.delta[i])});
  return sheet;
}

// The line, one standard deviation to either side, and the quantiles of the lognormal with these moments.
Sheet line_sheet(const std::string& name, const PeaksFit& fit, double im_most) {
  Sheet sheet{
      name + "_line", {"im", "mean", "mean_less_sigma", "mean_plus_sigma", "median", "fractile_16", "fractile_84"}, {}};
  constexpr int steps = 60;
  for (int i = 1; i <= steps; ++i) {
    const double im = 1.15 * im_most * i / steps, m = fit.line.slope * im, s = fit.line.sd_slope * im;
    const auto [lambda, omega] = fragility::lognormal_from_moments(m, s);
    sheet.rows.push_back(
        {name, im, m, m - s, m + s, std::exp(lambda), std::exp(lambda - omega), std::exp(lambda + omega)});
  }
  return sheet;
}

Sheet bins_sheet(const std::string& name, const PeaksFit& fit) {
  Sheet sheet{name + "_bins", {"im_low", "im_high", "im", "n", "mean", "standard_deviation", "lambda", "omega"}, {}};
  for (const PeakBin& b : fit.bins)
    sheet.rows.push_back(
        {name, b.im_low, b.im_high, b.im, static_cast<double>(b.n), b.mean, b.standard_deviation, b.lambda, b.omega});
  return sheet;
}

// The steps of the points' own distribution beside the line's, and S where both are farthest apart.
Sheet ks_sheet(const std::string& name, const Peaks& peaks, const PeaksFit& fit) {
  Sheet sheet{name + "_ks", {"probability_below", "share_before", "share_after"}, {}};
  const std::vector<double> u = fragility::linear_demand_transform(fit.line, peaks.im, peaks.delta);
  const double n = static_cast<double>(u.size());
  for (std::size_t i = 0; i < u.size(); ++i)
    sheet.rows.push_back({name, u[i], static_cast<double>(i) / n, static_cast<double>(i + 1) / n});
  return sheet;
}

Sheet surface_sheet(const std::string& name, const PeaksFit& fit, double im_most) {
  Sheet sheet{name + "_surface", {"im", "capacity", "probability"}, {}};
  constexpr int steps = 40;
  const double reach = std::ceil(1.1 * im_most), deepest = std::ceil(2 * fit.line.slope * im_most);
  for (int i = 1; i <= steps; ++i)
    for (int k = 1; k <= steps; ++k) {
      const double im = reach * i / steps, capacity = deepest * k / steps;
      sheet.rows.push_back({name, im, capacity, fragility::linear_demand_exceedance(fit.line, im, capacity)});
    }
  return sheet;
}

}  // namespace

double intensity(double pta_g, double mu) { return pta_g / mu - 1; }

double demand(double peak_slip_m, double period_s, double pta_g) {
  const double w = 2 * pi / period_s;
  return peak_slip_m * w * w / (pta_g * standard_gravity_mps2);
}

PeaksFit fit_peaks(const Peaks& peaks, const Jobs& jobs) {
  const std::size_t n = peaks.im.size();
  if (n < least_peaks)
    throw Error("a line and its bins need " + std::to_string(least_peaks) + " measured peaks (there are " +
                    std::to_string(n) + "): give more tests in one table",
                Exit::data);
  PeaksFit fit;
  fit.line = fragility::fit_linear_demand(peaks.im, peaks.delta);
  fit.slope_se = slope_error(peaks);
  fit.determination = determination(peaks, fit.line.slope);
  fit.bins = bins_of(peaks);
  through_bins(fit);
  fit.ks = fragility::ks_statistic(fragility::linear_demand_transform(fit.line, peaks.im, peaks.delta));
  fit.ks_critical_textbook = fragility::kolmogorov_critical(fragility::test_level, static_cast<double>(n));
  const std::vector<double> null = jobs("goodness of fit", 1, [&](std::size_t) {
    return fragility::linear_demand_null(fit.line, peaks.im, null_repeats, 1);
  })[0];
  fit.ks_critical = null[static_cast<std::size_t>((1 - fragility::test_level) * null_repeats)];
  const auto above = null.end() - std::lower_bound(null.begin(), null.end(), fit.ks);
  fit.ks_p = (1 + static_cast<double>(above)) / (1 + null_repeats);
  return fit;
}

std::vector<Sheet> sheets(const std::string& name, const Peaks& peaks, const PeaksFit& fit) {
  const double im_most = *std::max_element(peaks.im.begin(), peaks.im.end());
  return {points_sheet(name, peaks, fit), line_sheet(name, fit, im_most), bins_sheet(name, fit),
          ks_sheet(name, peaks, fit), surface_sheet(name, fit, im_most)};
}

}  // namespace freestand::report
