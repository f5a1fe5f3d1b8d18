#include "fragility/fit.hpp"

#include <algorithm>
#include <cmath>

#include "fragility/bin_fit.hpp"
#include "fragility/covariance.hpp"
#include "fragility/fragility_function.hpp"
#include "fragility/histogram.hpp"
#include "fragility/regression.hpp"
#include "fragility/surface.hpp"
#include "fragility/warnings.hpp"

namespace freestand::fragility {
namespace {

constexpr int cells_joined = 8;  // fine cells to one cell of the coarsened histogram

Distribution coarsened(const Tally& tally, std::size_t edp) {
  constexpr int cells = ln_cell_count / cells_joined + 1;
  const std::size_t bins = tally.layout().bins;
  std::vector<std::int64_t> all(bins * cells, 0);
  int first = cells, last = -1;
  for (std::size_t b = 0; b < bins; ++b) {
    const auto fine = tally.histogram(edp, b);
    for (int i = 0; i < static_cast<int>(fine.size()); ++i) {
      const std::int64_t count = fine[static_cast<std::size_t>(i)];
      if (count == 0) continue;
      const int cell = i / cells_joined;
      all[b * cells + static_cast<std::size_t>(cell)] += count;
      first = std::min(first, cell);
      last = std::max(last, cell);
    }
  }
  Distribution result;
  if (last < 0) return result;
  for (int cell = first; cell <= last + 1; ++cell) result.ln_edge.push_back(ln_cell_edge(cell * cells_joined));
  for (std::size_t b = 0; b < bins; ++b)
    for (int cell = first; cell <= last; ++cell)
      result.count.push_back(all[b * cells + static_cast<std::size_t>(cell)]);
  return result;
}

// Counts the steps of a fit: of each EDP its bins with their surface and each axis, and the overturning curve.
class Told {
 public:
  Told(const Options& options, const Steps& steps)
      : steps_(steps), total_(options.edps.size() * (1 + options.axes.size()) + 1) {}
  void step() {
    ++done_;
    if (steps_) steps_(done_, total_);
  }

 private:
  const Steps& steps_;
  std::size_t done_ = 0, total_;
};

EdpResult fit_edp(const Tally& tally, std::size_t e, const Resampling& resampling, EstimatedNull& null, Told& told) {
  const EdpOptions& options = tally.options().edps[e];
  EdpResult result;
  result.name = options.name;
  result.unit = options.unit;
  result.symbol = options.symbol;
  result.binary = options.binary;
  result.capacity = capacities(options);
  result.bins = fit_bins(tally, e, null);
  result.surface = surface(tally, e, resampling, result.bins);
  for (std::size_t c = 0; c < result.capacity.size(); ++c)
    result.functions.push_back(fragility_function(tally, e, c, resampling));
  told.step();
  for (std::size_t a = 0; a < tally.options().axes.size(); ++a) {
    result.axes.push_back(axis_surface(tally, e, a));
    told.step();
  }
  if (options.binary) return result;
  result.distribution = coarsened(tally, e);
  result.regressions = regressions(tally, e, resampling, result.bins);
  return result;
}

}  // namespace

Result fit(const Tally& tally, const Steps& steps) {
  EstimatedNull null(tally.options().seed);
  return fit(tally, null, steps);
}

Result fit(const Tally& tally, EstimatedNull& null, const Steps& steps) {
  const Options& options = tally.options();
  Result result;
  result.im_name = options.im_name;
  result.im_unit = options.im_unit;
  result.im_edge = options.im_edge;
  result.confidence = options.confidence;
  result.resamples = options.resamples;
  for (std::size_t b = 0; b + 1 < options.im_edge.size(); ++b) {
    const double mean = tally.mean_im(b);
    result.im.push_back(std::isnan(mean) ? (options.im_edge[b] + options.im_edge[b + 1]) / 2 : mean);
  }
  for (int i = 0; i < outcome_count; ++i)
    result.outcome_counts[static_cast<std::size_t>(i)] = tally.count_of(static_cast<Outcome>(i));
  result.samples = tally.samples();
  result.outside_im = tally.outside_im();
  const std::vector<bool> there = tally.groups_with_samples();
  result.motions = static_cast<int>(std::count(there.begin(), there.end(), true));

  const Resampling resampling(tally.groups(), there, options.resamples, options.seed);
  Told told(options, steps);
  for (std::size_t e = 0; e < options.edps.size(); ++e)
    result.edps.push_back(fit_edp(tally, e, resampling, null, told));
  result.overturning = overturning_function(tally, resampling);
  result.covariance = covariance(tally);
  told.step();
  result.warnings = warnings(tally, result);
  return result;
}

HalfWidth half_width(const Result& result) {
  HalfWidth width;
  double largest = -1;
  for (const EdpResult& edp : result.edps)
    for (std::size_t i = 0; i < edp.surface.probability.size(); ++i) {
      const std::size_t bin = i / edp.capacity.size();
      const double band = (edp.surface.upper[i] - edp.surface.lower[i]) / 2;
      ++(std::isnan(band) ? width.empty_points : width.points);
      const double half = std::isnan(band) ? 0.5 : band;
      if (edp.bins[bin].n == 0 || half <= largest) continue;
      largest = half;
      width.edp = edp.name;
      width.im = result.im[bin];
      width.capacity = edp.capacity[i % edp.capacity.size()];
    }
  if (largest >= 0 && width.points > 0) width.largest = largest;
  return width;
}

}  // namespace freestand::fragility
