#include <algorithm>
#include <cmath>

#include "fragility/share_interval.hpp"
#include "fragility/surface.hpp"

namespace freestand::fragility {
namespace {

// One cell of the IM x axis plane.
class Cell {
 public:
  Cell(const Tally& tally, std::size_t edp, std::size_t axis, std::size_t bin, std::size_t cell) {
    const std::size_t groups = tally.layout().groups, capacities = tally.layout().capacity_count[edp];
    table_.resize(static_cast<Eigen::Index>(groups), 1 + static_cast<Eigen::Index>(capacities));
    for (std::size_t g = 0; g < groups; ++g) {
      const auto row = static_cast<Eigen::Index>(g);
      table_(row, 0) = static_cast<double>(tally.axis_n(edp, axis, bin, cell, g));
      for (std::size_t c = 0; c < capacities; ++c)
        table_(row, 1 + static_cast<Eigen::Index>(c)) =
            static_cast<double>(tally.axis_exceeding(edp, axis, bin, cell, g, c));
    }
  }

  std::int64_t n() const { return static_cast<std::int64_t>(table_.col(0).sum()); }
  std::int64_t hits(Eigen::Index c) const { return static_cast<std::int64_t>(table_.col(1 + c).sum()); }

  Interval band(Eigen::Index c, const MotionGroups& motions, double confidence) const {
    std::vector<GroupShare> shares;
    for (Eigen::Index g = 0; g < table_.rows(); ++g) shares.push_back({table_(g, 0), table_(g, 1 + c)});
    return share_interval(shares, motions, confidence);
  }

 private:
  Eigen::MatrixXd table_;  // [group, n and exceeding]
};

}  // namespace

AxisSurface axis_surface(const Tally& tally, std::size_t edp, std::size_t axis) {
  const Options& options = tally.options();
  const AxisOptions& ax = options.axes[axis];
  const std::size_t bins = tally.layout().bins, cells = ax.edge.size() - 1,
                    capacity = tally.layout().capacity_count[edp];
  AxisSurface result;
  result.name = ax.name;
  result.unit = ax.unit;
  result.edge = ax.edge;
  for (std::size_t x = 0; x < cells; ++x) {
    const double mean = tally.mean_on_axis(axis, x);
    result.centre.push_back(std::isnan(mean) ? (ax.edge[x] + ax.edge[x + 1]) / 2 : mean);
  }
  result.probability.assign(bins * cells * capacity, unknown);
  result.lower = result.upper = result.probability;
  result.n.assign(bins * cells, 0);
  for (std::size_t at = 0; at < bins * cells; ++at) {
    const Cell cell(tally, edp, axis, at / cells, at % cells);
    result.n[at] = cell.n();
    if (cell.n() < options.minimum_samples) continue;
    for (std::size_t c = 0; c < capacity; ++c) {
      const auto column = static_cast<Eigen::Index>(c);
      const Interval band = cell.band(column, tally.groups(), options.confidence);
      result.probability[at * capacity + c] = static_cast<double>(cell.hits(column)) / static_cast<double>(cell.n());
      result.lower[at * capacity + c] = band.lower;
      result.upper[at * capacity + c] = band.upper;
    }
    nest(std::span(result.lower).subspan(at * capacity, capacity),
         std::span(result.upper).subspan(at * capacity, capacity));
  }
  return result;
}

}  // namespace freestand::fragility
