// Demands along a line over ln IM, of which the small ones are only counted.
#include "fragility/line_above.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fragility/bin_fit.hpp"
#include "fragility/made_study.hpp"
#include "fragility/normal.hpp"
#include "fragility/pilot.hpp"

namespace freestand::fragility {
namespace {

// ln X = lambda + slope x + omega z over x from `low` to 1, cut off at 0; a share `never` has none.
struct Cut01 {
  std::vector<double> x, y, still;

  Cut01(std::size_t n, double lambda, double slope, double omega, double never, std::uint64_t stream) {
    for (std::size_t i = 0; i < n; ++i) {
      const double at = test::uniform(i, stream + 1) - 0.5, ln = lambda + slope * at + omega * test::normal(i, stream);
      if (ln > 0 && test::uniform(i, stream + 2) >= never) {
        x.push_back(at);
        y.push_back(ln);
      } else {
        still.push_back(at);
      }
    }
  }
  // In eight cells of x.
  LineFit fit(std::optional<double> known = {}) const {
    LineSums above{};
    std::vector<LineCell> cells(8);
    for (int k = 0; k < 8; ++k) cells[static_cast<std::size_t>(k)] = {(k + 0.5) / 8 - 0.5, 0, 0};
    const auto cell = [&](double at) -> LineCell& { return cells[static_cast<std::size_t>(8 * (at + 0.5))]; };
    for (const double at : still) ++cell(at).still;
    for (std::size_t i = 0; i < x.size(); ++i) {
      ++cell(x[i]).above, ++above.n;
      above.x += x[i], above.xx += x[i] * x[i], above.y += y[i], above.yy += y[i] * y[i], above.xy += x[i] * y[i];
    }
    return fit_line_above(above, cells, 1, known);
  }
  // As it is written down, sample by sample: of those above alone, or beside those that stood still for want of demand alone.
  double likelihood(double lambda, double slope, double omega, bool truncated) const {
    double value = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double m = lambda + slope * x[i], z = (y[i] - m) / omega;
      value += -z * z / 2 - std::log(omega) - (truncated ? std::log(normal_cdf(m / omega)) : 0);
    }
    for (const double at : still)
      if (!truncated) value += std::log(normal_cdf(-(lambda + slope * at) / omega));
    return value;
  }
};

// Of the likelihood of every sample, for which those of the cells stand, hardly anything is left to gain.
TEST(LineAbove, IsTheMaximumOfTheLikelihood) {
  for (const double never : {0.0, 0.2}) {
    const Cut01 sample(4000, 0.4, 2, 1, never, 801);
    const LineFit fit = sample.fit();
    const bool truncated = fit.at.never > 0;
    EXPECT_EQ(truncated, never > 0);
    const double best = sample.likelihood(fit.at.lambda, fit.slope, fit.at.omega, truncated);
    for (const double step : {-0.3, 0.3}) {  // some ten standard errors
      EXPECT_LT(sample.likelihood(fit.at.lambda + step, fit.slope, fit.at.omega, truncated), best - 10);
      EXPECT_LT(sample.likelihood(fit.at.lambda, fit.slope + 3 * step, fit.at.omega, truncated), best - 10);
      EXPECT_LT(sample.likelihood(fit.at.lambda, fit.slope, fit.at.omega + step, truncated), best - 10);
    }
    for (const double step : {-0.01, 0.01}) {
      EXPECT_LT(sample.likelihood(fit.at.lambda + step, fit.slope, fit.at.omega, truncated), best + 0.05);
      EXPECT_LT(sample.likelihood(fit.at.lambda, fit.slope + 3 * step, fit.at.omega, truncated), best + 0.05);
      EXPECT_LT(sample.likelihood(fit.at.lambda, fit.slope, fit.at.omega + step, truncated), best + 0.05);
    }
  }
}

TEST(LineAbove, IsRightOnTheAverage) {
  double lambda = 0, slope = 0, omega = 0, never = 0, known = 0;
  const int sets = test::repeats_asked(40);
  for (int set = 0; set < sets; ++set) {
    const Cut01 sample(2000, 0.4, 2, 1, 0.2, 900 + 3 * static_cast<std::uint64_t>(set));
    const LineFit fit = sample.fit();
    lambda += fit.at.lambda / sets, slope += fit.slope / sets, omega += fit.at.omega / sets,
        never += fit.at.never / sets;
    known += sample.fit(2).at.lambda / sets;
  }
  // Of one set these scatter by 0.12, 0.2, 0.04, 0.04 and 0.1.
  EXPECT_NEAR(lambda, 0.4, 0.06);
  EXPECT_NEAR(slope, 2, 0.1);
  EXPECT_NEAR(omega, 1, 0.02);
  EXPECT_NEAR(never, 0.2, 0.02);
  EXPECT_NEAR(known, 0.4, 0.05);
}

// Where all x are one, and where the slope is known to be none, it is the fit without a line.
TEST(LineAbove, WithoutASlopeIsTheFitAtOnePlace) {
  const Cut01 sample(2000, 0.4, 0, 1, 0.2, 802);
  double y = 0, yy = 0;
  for (const double v : sample.y) y += v, yy += v * v;
  const ThresholdFit plain =
      fit_above(static_cast<double>(sample.y.size()), y, yy, static_cast<double>(sample.still.size()), 1);
  const LineFit fit = sample.fit(0);
  EXPECT_NEAR(fit.at.lambda, plain.lambda, 1e-6);
  EXPECT_NEAR(fit.at.omega, plain.omega, 1e-6);
  EXPECT_NEAR(fit.at.never, plain.never, 1e-6);
}

// Where Phi itself is still a number, beyond where the series begins.
TEST(LineAbove, TheLogarithmOfATailIsFinite) {
  for (const double x : {-30.5, -35.0, -37.0}) EXPECT_NEAR(ln_normal_cdf(x), std::log(normal_cdf(x)), 5e-6) << x;
  EXPECT_TRUE(std::isfinite(ln_normal_cdf(-1e3)));
}

TEST(LineAbove, TailsThatNoLognormalHasAreNone) {
  const LineCell cells[] = {{-0.3, 50, 5}, {0.3, 50, 5}};
  EXPECT_TRUE(std::isnan(fit_line_above({100, 0, 8, 10, 50, 0}, cells, 1).at.omega));
  EXPECT_TRUE(std::isnan(fit_line_above({1, 0, 0, 1, 1, 0}, {}, 1).at.omega));
}

// A demand that rises as IM^2 within a bin that is wide, of which a third lies below the threshold: the line was flattened by what is cut off
// and a true lognormal failed its test nearly always.
TEST(LineAbove, ATrueLognormalPassesWhereManyStandStill) {
  Options o = test::options(1, false);
  o.im_edge = {0.1, 0.42};
  o.minimum_samples = 20;
  o.edps = {{"slip", "m", "slip", false, std::exp(-10.2), {2e-4, 1e-3}}};
  const int sets = test::repeats_asked(60);
  int rejected = 0;
  double slope = 0, lambda = 0, never = 0;
  for (int set = 0; set < sets; ++set) {
    const auto stream = 2000 + 10 * static_cast<std::uint64_t>(set);
    const auto count = [&](const Options& options, std::uint64_t from, std::uint64_t to) {
      Tally tally(options);
      for (std::uint64_t i = from; i < to; ++i) {
        const double im = 0.1 + 0.32 * test::uniform(i, stream),
                     value = std::exp(-6.9 + 2 * std::log(im) + test::normal(i, stream + 1));
        tally.add({i, im, 0, Outcome::moved, {&value, 1}, {}});
      }
      return tally;
    };
    const Tally tally = count(with_pilot(count(o, 0, 1000)), 0, 6000);
    const BinFit bin = fit_bins(tally, 0)[0];
    EXPECT_NEAR(static_cast<double>(bin.n_still) / 6000, 0.35, 0.05);
    rejected += bin.ks_p_estimated <= 0.05;
    slope += bin.slope / sets, never += bin.p_never / sets;
    lambda += (bin.lambda - (-6.9 + 2 * std::log(bin.im_mean))) / sets;
  }
  EXPECT_LE(rejected, test::likely_counts(sets, 0.05).most);
  EXPECT_NEAR(slope, 2, 0.05);
  EXPECT_NEAR(lambda, 0, 0.02);
  EXPECT_LT(never, 0.02);
}

}  // namespace
}  // namespace freestand::fragility
