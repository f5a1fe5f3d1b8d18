#include <algorithm>
#include <cmath>

#include "fragility/overturning.hpp"

namespace freestand::fragility {
namespace {

constexpr int grid_points = 81;

struct Cell {
  double im;
  std::vector<double> n, over;  // [group]
};

std::vector<Cell> cells_of(const Tally& tally) {
  std::vector<Cell> cells;
  const std::size_t groups = tally.layout().groups;
  for (std::size_t i = 0; i < tally.layout().im_cell_count(); ++i) {
    const ImCell total = tally.im_cell(i);
    const double im = total.n > 0 ? total.im_sum / static_cast<double>(total.n) : 0;
    if (!(im > 0)) continue;
    Cell cell{im, std::vector<double>(groups), std::vector<double>(groups)};
    for (std::size_t g = 0; g < groups; ++g) {
      cell.n[g] = static_cast<double>(tally.im_cell_n(i, g));
      cell.over[g] = static_cast<double>(tally.im_cell_over(i, g));
    }
    cells.push_back(std::move(cell));
  }
  return cells;
}

template <class Weight>
std::vector<OverturningPoint> weighted(const std::vector<Cell>& cells, Weight weight) {
  std::vector<OverturningPoint> points;
  for (const Cell& cell : cells) {
    OverturningPoint point{cell.im, 0, 0};
    for (std::size_t g = 0; g < cell.n.size(); ++g) {
      point.n += weight(g) * cell.n[g];
      point.over += weight(g) * cell.over[g];
    }
    if (point.n > 0) points.push_back(point);
  }
  return points;
}

// Equally spaced from the first positive edge (or a hundredth of the last) to the last edge.
std::vector<double> grid_of(const std::vector<double>& edge) {
  const auto positive = std::find_if(edge.begin(), edge.end(), [](double e) { return e > 0; });
  if (positive == edge.end()) return {};
  const double low = positive + 1 == edge.end() ? edge.back() / 100 : *positive;
  std::vector<double> grid;
  for (int i = 0; i < grid_points; ++i) grid.push_back(low + (edge.back() - low) * i / (grid_points - 1));
  return grid;
}

}  // namespace

OverturningCurve overturning_curve(const Tally& tally, const Resampling& resampling) {
  const std::vector<Cell> cells = cells_of(tally);
  const OverturningFit fit = fit_overturning(weighted(cells, [](std::size_t) { return 1.0; }));
  OverturningCurve curve;
  curve.median = fit.median;
  curve.dispersion = fit.dispersion;
  curve.median_se = fit.median_se;
  curve.dispersion_se = fit.dispersion_se;
  curve.penalised = fit.penalised;
  curve.grid = grid_of(tally.options().im_edge);
  const std::size_t points = curve.grid.size();
  curve.probability.assign(points, unknown);
  curve.lower = curve.upper = curve.probability;
  if (std::isnan(fit.median)) return curve;

  std::vector<std::vector<double>> values(points);
  for (int r = 0; r < resampling.resamples(); ++r) {
    const auto weight = [&](std::size_t g) { return resampling.weight(r, static_cast<int>(g)); };
    const OverturningFit again = fit_overturning(weighted(cells, weight));
    for (std::size_t i = 0; i < points; ++i) values[i].push_back(overturning_probability(again, curve.grid[i]));
  }
  const std::vector<bool> there = tally.groups_with_samples();
  const int motions = static_cast<int>(std::count(there.begin(), there.end(), true));
  for (std::size_t i = 0; i < points; ++i) {
    curve.probability[i] = overturning_probability(fit, curve.grid[i]);
    const Interval band = percentile_interval(values[i], tally.options().confidence, motions);
    curve.lower[i] = band.lower;
    curve.upper[i] = band.upper;
  }
  return curve;
}

}  // namespace freestand::fragility
