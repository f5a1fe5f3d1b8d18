// Where each count of a tally lies.
#pragma once

#include <cstddef>
#include <vector>

#include "fragility/options.hpp"

namespace freestand::fragility {

// Position of a value among increasing edges: edge[i] <= value < edge[i + 1], the last edge included; -1 outside or
// NaN. With open ends every number has a bin.
int bin_index(const std::vector<double>& edge, double value, bool open_ends = false);

// Capacities of an EDP: those of the options, or {0.5} for a binary one.
std::vector<double> capacities(const EdpOptions& edp);

// Offsets into the flat array of counts and into the flat array of exact sums.
struct TallyLayout {
  static constexpr std::size_t cells_per_bin = 8;  // fine IM cells, for curves over IM
  static constexpr std::size_t sums_per_regression = 11;
  static constexpr std::size_t counts_per_bin = 5, sums_per_bin = 5;
  static constexpr std::size_t sums_per_pair = 7;

  TallyLayout(const Options& options, std::size_t group_count);

  std::size_t edps, bins, groups;
  std::vector<std::size_t> capacity_count;  // [edp]
  std::vector<std::size_t> axis_cells;      // [axis]

  std::size_t outside, failed, missing, bin_counts, im_cells;                  // offsets of counts
  std::vector<std::size_t> exceeding, histogram, im_cells_of, moved_in_cells;  // [edp]
  std::vector<std::vector<std::size_t>> axis;                                  // [edp][axis]
  std::vector<std::size_t> axis_counts, axis_sums;                             // [axis] of counts, of sums; one a cell
  std::size_t bin_sums, im_sums, regression_sums;                              // offsets of sums
  std::size_t count_size, sum_size;

  std::vector<std::size_t> paired;     // EDPs that take capacities: of these, every two vary together
  std::size_t pair_counts, pair_sums;  // offsets, by pair()

  // Of the i-th and the j-th of them, i <= j.
  std::size_t pairs() const { return paired.size() * (paired.size() + 1) / 2; }
  std::size_t pair(std::size_t bin, std::size_t i, std::size_t j) const { return bin * pairs() + j * (j + 1) / 2 + i; }

  std::size_t im_cell_count() const { return bins * cells_per_bin; }
  // n, still, over, moved, moved at an IM that is not above 0
  std::size_t at_bin(std::size_t edp, std::size_t bin, std::size_t group) const {
    return bin_counts + counts_per_bin * ((edp * bins + bin) * groups + group);
  }
  // of the moved ones, l = ln EDP and m = ln IM: l, l^2, m, m^2, l m
  std::size_t at_bin_sum(std::size_t edp, std::size_t bin, std::size_t group) const {
    return bin_sums + sums_per_bin * ((edp * bins + bin) * groups + group);
  }
  std::size_t at_regression(std::size_t edp, std::size_t group) const {
    return regression_sums + sums_per_regression * (edp * groups + group);
  }
  std::size_t at_exceeding(std::size_t edp, std::size_t bin, std::size_t group) const {
    return exceeding[edp] + (bin * groups + group) * capacity_count[edp];
  }
  // n, then one an EDP capacity
  std::size_t at_axis(std::size_t edp, std::size_t ax, std::size_t bin, std::size_t cell, std::size_t group) const {
    return axis[edp][ax] + ((bin * axis_cells[ax] + cell) * groups + group) * (1 + capacity_count[edp]);
  }
  // n, over
  std::size_t at_im_cell(std::size_t cell, std::size_t group) const { return im_cells + 2 * (cell * groups + group); }
  // n, then one an EDP capacity
  std::size_t at_im_cell_of(std::size_t edp, std::size_t cell, std::size_t group) const {
    return im_cells_of[edp] + (cell * groups + group) * (1 + capacity_count[edp]);
  }
  // of one that takes capacities
  std::size_t at_moved_in_cell(std::size_t edp, std::size_t cell, std::size_t group) const {
    return moved_in_cells[edp] + cell * groups + group;
  }
};

}  // namespace freestand::fragility
