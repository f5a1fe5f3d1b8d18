#include "fragility/tally_layout.hpp"

#include <algorithm>
#include <cmath>
#include <freestand/response.hpp>

#include "fragility/histogram.hpp"

namespace freestand::fragility {

int bin_index(const std::vector<double>& edge, double value, bool open_ends) {
  if (open_ends && !std::isnan(value)) value = std::clamp(value, edge.front(), edge.back());
  if (!(value >= edge.front()) || !(value <= edge.back())) return -1;
  const auto above = std::upper_bound(edge.begin(), edge.end(), value) - edge.begin();
  return static_cast<int>(std::min<std::ptrdiff_t>(above, static_cast<std::ptrdiff_t>(edge.size()) - 1)) - 1;
}

std::vector<double> capacities(const EdpOptions& edp) { return edp.binary ? std::vector<double>{0.5} : edp.capacities; }

TallyLayout::TallyLayout(const Options& options, std::size_t group_count)
    : edps(options.edps.size()), bins(options.im_edge.size() - 1), groups(group_count) {
  std::size_t next = outcome_count;
  const auto take = [&next](std::size_t size) {
    const std::size_t begin = next;
    next += size;
    return begin;
  };
  for (const auto& ax : options.axes) {
    axis_cells.push_back(ax.edge.size() - 1);
    axis_counts.push_back(take(axis_cells.back()));
  }
  outside = take(1);
  failed = take(bins);
  missing = take(edps);
  bin_counts = take(counts_per_bin * edps * bins * groups);
  im_cells = take(2 * im_cell_count() * groups);
  for (const auto& edp : options.edps) {
    const std::size_t capacity = capacities(edp).size();
    capacity_count.push_back(capacity);
    exceeding.push_back(take(bins * groups * capacity));
    im_cells_of.push_back(take(im_cell_count() * groups * (1 + capacity)));
    moved_in_cells.push_back(take(edp.binary ? 0 : im_cell_count() * groups));
    histogram.push_back(take(edp.binary ? 0 : bins * static_cast<std::size_t>(ln_cell_count)));
    std::vector<std::size_t>& offsets = axis.emplace_back();
    for (const std::size_t cells : axis_cells) offsets.push_back(take(bins * cells * groups * (1 + capacity)));
  }
  for (std::size_t e = 0; e < edps; ++e)
    if (!options.edps[e].binary) paired.push_back(e);
  pair_counts = take(bins * pairs());
  count_size = next;
  next = 0;
  bin_sums = take(sums_per_bin * edps * bins * groups);
  im_sums = take(im_cell_count());
  for (const std::size_t cells : axis_cells) axis_sums.push_back(take(cells));
  regression_sums = take(sums_per_regression * edps * groups);
  pair_sums = take(sums_per_pair * bins * pairs());
  sum_size = next;
}

}  // namespace freestand::fragility
