#include "fragility/fit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fragility/bin_fit.hpp"
#include "fragility/covariance.hpp"
#include "fragility/fragility_function.hpp"
#include "fragility/histogram.hpp"
#include "fragility/regression.hpp"
#include "fragility/result_numbers.hpp"
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

// All but the curves over IM.
EdpResult fit_edp(const Tally& tally, std::size_t e, const Resampling& resampling) {
  const EdpOptions& options = tally.options().edps[e];
  EdpResult result;
  result.binary = options.binary;
  result.capacity = capacities(options);
  result.bins = fit_bins(tally, e);
  result.surface = surface(tally, e, resampling, result.bins);
  for (std::size_t a = 0; a < tally.options().axes.size(); ++a) result.axes.push_back(axis_surface(tally, e, a));
  if (options.binary) return result;
  result.distribution = coarsened(tally, e);
  result.regressions = regressions(tally, e, resampling, result.bins);
  return result;
}

// What can be made by itself: a demand's bins with all that rests on them, one of its curves over IM, or the curve of
// overturning.
struct Piece {
  std::size_t edp = 0;
  std::optional<std::size_t> capacity = {};
  bool overturning = false;
};

std::vector<Piece> pieces(const Options& options) {
  std::vector<Piece> all;
  for (std::size_t e = 0; e < options.edps.size(); ++e) {
    all.push_back({e});
    for (std::size_t c = 0; c < capacities(options.edps[e]).size(); ++c) all.push_back({e, c});
  }
  all.push_back({.overturning = true});
  return all;
}

void fit_pieces(const Tally& tally, const Resampling& resampling, const Jobs& jobs, Result& result) {
  const Options& options = tally.options();
  const std::vector<Piece> all = pieces(options);
  const auto found = jobs("fit", all.size(), [&](std::size_t i) {
    const auto& [edp, capacity, overturning] = all[i];
    if (overturning) return numbers_of(overturning_function(tally, resampling));
    if (capacity) return numbers_of(fragility_function(tally, edp, *capacity, resampling));
    return numbers_of(fit_edp(tally, edp, resampling));
  });
  result.edps.resize(options.edps.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& [edp, capacity, overturning] = all[i];
    if (overturning)
      from_numbers(found[i], result.overturning);
    else if (capacity)
      from_numbers(found[i], result.edps[edp].functions.emplace_back());
    else
      from_numbers(found[i], result.edps[edp]);
  }
  for (std::size_t e = 0; e < options.edps.size(); ++e) {
    EdpResult& edp = result.edps[e];
    edp.name = options.edps[e].name;
    edp.unit = options.edps[e].unit;
    edp.symbol = options.edps[e].symbol;
    for (std::size_t a = 0; a < options.axes.size(); ++a) {
      edp.axes[a].name = options.axes[a].name;
      edp.axes[a].unit = options.axes[a].unit;
    }
  }
}

}  // namespace

Result fit(const Tally& tally, const Jobs& jobs) {
  const Options& options = tally.options();
  Result result;
  result.im_name = options.im_name;
  result.im_unit = options.im_unit;
  result.im_period_s = options.im_period_s;
  result.im_damping = options.im_damping;
  result.im_edge = options.im_edge;
  result.confidence = options.confidence;
  result.resamples = options.resamples;
  for (std::size_t b = 0; b + 1 < options.im_edge.size(); ++b) {
    const double mean = tally.mean_im(b);
    result.im.push_back(std::isnan(mean) ? (options.im_edge[b] + options.im_edge[b + 1]) / 2 : mean);
  }
  constexpr std::size_t cells = TallyLayout::cells_per_bin;
  for (std::size_t cell = 0; cell < tally.layout().im_cell_count(); ++cell) {
    const ImCell in = tally.im_cell(cell);
    const double middle = std::lerp(options.im_edge[cell / cells], options.im_edge[cell / cells + 1],
                                    (static_cast<double>(cell % cells) + 0.5) / cells);
    result.cell_n.push_back(in.n);
    result.cell_im.push_back(in.n > 0 ? in.im_sum / static_cast<double>(in.n) : middle);
  }
  for (int i = 0; i < outcome_count; ++i)
    result.outcome_counts[static_cast<std::size_t>(i)] = tally.count_of(static_cast<Outcome>(i));
  result.samples = tally.samples();
  result.outside_im = tally.outside_im();
  const std::vector<bool> there = tally.groups_with_samples();
  result.motions = static_cast<int>(std::count(there.begin(), there.end(), true));

  const Resampling resampling(tally.groups(), there, options.resamples, options.seed);
  result.left_out_records = resampling.left_out_records();
  fit_pieces(tally, resampling, jobs, result);
  result.covariance = covariance(tally);
  result.warnings = warnings(tally, result);
  return result;
}

}  // namespace freestand::fragility
