#include "fragility/regression.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>

#include "base/random.hpp"
#include "fragility/goodness.hpp"
#include "fragility/intervals.hpp"
#include "fragility/lognormal.hpp"

namespace freestand::fragility {
namespace {

using Vector = Eigen::Map<const Eigen::VectorXd>;

Vector vector(std::span<const double> values) { return {values.data(), static_cast<Eigen::Index>(values.size())}; }

double squared_correlation(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  const Eigen::VectorXd dx = x.array() - x.mean(), dy = y.array() - y.mean();
  return dx.dot(dy) * dx.dot(dy) / (dx.squaredNorm() * dy.squaredNorm());
}

// Squared correlation from sums.
double squared_correlation(double n, double x, double y, double xx, double xy, double yy) {
  const double cov = n * xy - x * y;
  return cov * cov / ((n * xx - x * x) * (n * yy - y * y));
}

void check(std::span<const double> im, std::span<const double> edp, std::size_t least) {
  if (im.size() != edp.size() || im.size() < least)
    throw Error(
        "regression is impossible (too few pairs, or as many intensities as demands are not there): check the data",
        Exit::data);
}

void through_bins(std::span<const BinFit> bins, Regressions& result) {
  double xx = 0, mean = 0, sd = 0;
  for (const BinFit& bin : bins) {
    if (std::isnan(bin.mean) || !(bin.im_mean > 0)) continue;
    xx += bin.im_mean * bin.im_mean;
    mean += bin.im_mean * bin.mean;
    sd += bin.im_mean * bin.standard_deviation;
  }
  if (xx > 0) {
    result.bin_mean_slope = mean / xx;
    result.bin_sd_slope = sd / xx;
  }
}

}  // namespace

LinearDemand fit_linear_demand(std::span<const double> im, std::span<const double> edp) {
  check(im, edp, 2);
  const Vector x = vector(im), y = vector(edp);
  const double xx = x.squaredNorm();
  if (!(xx > 0)) throw Error("regression is impossible (every intensity is 0): check the data", Exit::data);
  const double slope = x.dot(y) / xx;
  return {slope, std::sqrt((y - slope * x).squaredNorm() / xx), squared_correlation(x, y)};
}

double linear_demand_cdf(const LinearDemand& model, double im, double edp) {
  const auto [lambda, omega] = lognormal_from_moments(model.slope * im, model.sd_slope * im);
  return lognormal_cdf(edp, lambda, omega);
}

double linear_demand_exceedance(const LinearDemand& model, double im, double capacity) {
  const auto [lambda, omega] = lognormal_from_moments(model.slope * im, model.sd_slope * im);
  return lognormal_exceedance(capacity, lambda, omega);
}

std::vector<double> linear_demand_transform(const LinearDemand& model, std::span<const double> im,
                                            std::span<const double> edp) {
  check(im, edp, 1);
  std::vector<double> u;
  for (std::size_t i = 0; i < im.size(); ++i) u.push_back(linear_demand_cdf(model, im[i], edp[i]));
  std::sort(u.begin(), u.end());
  return u;
}

std::vector<double> linear_demand_null(const LinearDemand& model, std::span<const double> im, int repeats,
                                       std::uint64_t seed) {
  const std::uint64_t stream = random::stable_hash("fragility/linear_demand_null");
  std::vector<double> result, edp(im.size());
  for (int repeat = 0; repeat < repeats; ++repeat) {
    for (std::size_t i = 0; i < im.size(); ++i) {
      const auto [lambda, omega] = lognormal_from_moments(model.slope * im[i], model.sd_slope * im[i]);
      const double u = random::uniform(seed, static_cast<std::uint64_t>(repeat) * im.size() + i, stream);
      edp[i] = std::exp(lambda + omega * gsl_cdf_ugaussian_Pinv(u));
    }
    result.push_back(ks_statistic(linear_demand_transform(fit_linear_demand(im, edp), im, edp)));
  }
  std::sort(result.begin(), result.end());
  return result;
}

Cloud fit_cloud(std::span<const double> im, std::span<const double> edp) {
  check(im, edp, 3);
  const Eigen::VectorXd x = vector(im).array().log(), y = vector(edp).array().log();
  Eigen::MatrixX2d design(x.size(), 2);
  design << Eigen::VectorXd::Ones(x.size()), x;
  const Eigen::Vector2d line = design.colPivHouseholderQr().solve(y);
  const double sd = std::sqrt((y - design * line).squaredNorm() / static_cast<double>(x.size() - 2));
  return {line(0), line(1), sd, squared_correlation(x, y)};
}

Regressions regressions(const RegressionSums& s, std::span<const BinFit> bins) {
  Regressions result;
  result.n = s.n;
  through_bins(bins, result);
  if (s.n < 3) return result;
  const double n = static_cast<double>(s.n), slope = s.xy / s.xx;
  result.slope = slope * s.unit;
  result.sd_slope = std::sqrt(std::max(0.0, s.yy / s.xx - slope * slope)) * s.unit;
  result.slope_r2 = squared_correlation(n, s.x, s.y, s.xx, s.xy, s.yy);

  Eigen::Matrix2d normal;
  normal << n, s.lx, s.lx, s.lxlx;
  const Eigen::Vector2d line = normal.colPivHouseholderQr().solve(Eigen::Vector2d(s.ly, s.lxly));
  const double residual = s.lyly - line(0) * s.ly - line(1) * s.lxly;
  result.cloud_intercept = line(0) + std::log(s.unit);
  result.cloud_slope = line(1);
  result.cloud_sd = std::sqrt(std::max(0.0, residual) / (n - 2));
  result.cloud_r2 = squared_correlation(n, s.lx, s.ly, s.lxlx, s.lxly, s.lyly);
  return result;
}

Regressions regressions(const Tally& tally, std::size_t edp, const Resampling& resampling,
                        std::span<const BinFit> bins) {
  constexpr Eigen::Index sums = TallyLayout::sums_per_regression;
  const std::size_t groups = tally.layout().groups;
  Eigen::MatrixXd by_group(static_cast<Eigen::Index>(groups), sums);
  for (std::size_t g = 0; g < groups; ++g) {
    const RegressionSums s = tally.regression(edp, g);
    by_group.row(static_cast<Eigen::Index>(g)) << static_cast<double>(s.n), s.x, s.y, s.xx, s.xy, s.yy, s.lx, s.ly,
        s.lxlx, s.lxly, s.lyly;
  }
  const double unit = tally.regression(edp).unit;
  std::vector<Regressions> resampled;
  const Eigen::MatrixXd totals = resampling.totals(by_group);
  for (const auto& t : totals.rowwise())
    resampled.push_back(
        regressions({std::llround(t(0)), t(1), t(2), t(3), t(4), t(5), t(6), t(7), t(8), t(9), t(10), unit}, {}));
  Regressions result = regressions(tally.regression(edp), bins);
  const auto error = [&](double Regressions::*value) {
    std::vector<double> values;
    for (const Regressions& r : resampled) values.push_back(r.*value);
    return standard_deviation(values);
  };
  result.slope_se = error(&Regressions::slope);
  result.sd_slope_se = error(&Regressions::sd_slope);
  result.cloud_intercept_se = error(&Regressions::cloud_intercept);
  result.cloud_slope_se = error(&Regressions::cloud_slope);
  result.cloud_sd_se = error(&Regressions::cloud_sd);
  return result;
}

}  // namespace freestand::fragility
