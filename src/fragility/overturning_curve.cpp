#include <algorithm>
#include <cmath>

#include "fragility/intervals.hpp"
#include "fragility/overturning.hpp"

namespace freestand::fragility {
namespace {

constexpr int grid_points = 81;

struct Cells {
  std::vector<double> im;
  Eigen::MatrixXd n, over;  // [group, cell]
};

Cells cells_of(const Tally& tally) {
  const auto groups = static_cast<Eigen::Index>(tally.layout().groups);
  const auto all = static_cast<Eigen::Index>(tally.layout().im_cell_count());
  Cells cells{{}, Eigen::MatrixXd(groups, all), Eigen::MatrixXd(groups, all)};
  Eigen::Index used = 0;
  for (std::size_t i = 0; i < tally.layout().im_cell_count(); ++i) {
    const ImCell total = tally.im_cell(i);
    const double im = total.n > 0 ? total.im_sum / static_cast<double>(total.n) : 0;
    if (!(im > 0)) continue;
    cells.im.push_back(im);
    for (Eigen::Index g = 0; g < groups; ++g) {
      cells.n(g, used) = static_cast<double>(tally.im_cell_n(i, static_cast<std::size_t>(g)));
      cells.over(g, used) = static_cast<double>(tally.im_cell_over(i, static_cast<std::size_t>(g)));
    }
    ++used;
  }
  cells.n.conservativeResize(groups, used);
  cells.over.conservativeResize(groups, used);
  return cells;
}

std::vector<OverturningPoint> points_of(const std::vector<double>& im, const Eigen::RowVectorXd& n,
                                        const Eigen::RowVectorXd& over) {
  std::vector<OverturningPoint> points;
  for (Eigen::Index i = 0; i < n.size(); ++i)
    if (n(i) > 0) points.push_back({im[static_cast<std::size_t>(i)], n(i), over(i)});
  return points;
}

// The curve of one resample on the grid; 0 or 1 throughout where no sample, or every sample, of it overturned.
void append_curve(const std::vector<OverturningPoint>& points, const OverturningFit& start,
                  const std::vector<double>& grid, std::vector<std::vector<double>>& values) {
  double n = 0, over = 0;
  for (const auto& point : points) {
    n += point.n;
    over += point.over;
  }
  const OverturningFit fit = fit_overturning(points, start);
  for (std::size_t i = 0; i < grid.size(); ++i)
    values[i].push_back(over == 0 || over == n ? over / n : overturning_probability(fit, grid[i]));
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
  const Cells cells = cells_of(tally);
  const OverturningFit fit = fit_overturning(points_of(cells.im, cells.n.colwise().sum(), cells.over.colwise().sum()));
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
  const Eigen::MatrixXd n = resampling.totals(cells.n), over = resampling.totals(cells.over);
  for (Eigen::Index r = 0; r < n.rows(); ++r)
    append_curve(points_of(cells.im, n.row(r), over.row(r)), fit, curve.grid, values);
  const std::vector<bool> there = tally.groups_with_samples();
  const int motions = static_cast<int>(std::count(there.begin(), there.end(), true));
  for (std::size_t i = 0; i < points; ++i) {
    curve.probability[i] = overturning_probability(fit, curve.grid[i]);
    const Interval band = percentile_interval(values[i], curve.probability[i], tally.options().confidence, motions);
    curve.lower[i] = band.lower;
    curve.upper[i] = band.upper;
  }
  return curve;
}

}  // namespace freestand::fragility
