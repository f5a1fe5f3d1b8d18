#include <limits>
#include <numeric>

#include "fragility/histogram.hpp"
#include "fragility/tally.hpp"

namespace freestand::fragility {
namespace {

RegressionSums regression_sums(const ExactSum* s, double unit) {
  const auto value = [&](int i) { return s[i].value(); };
  return {static_cast<std::int64_t>(value(0)),
          value(1),
          value(2),
          value(3),
          value(4),
          value(5),
          value(6),
          value(7),
          value(8),
          value(9),
          value(10),
          unit};
}

}  // namespace

std::int64_t Tally::count_of(Outcome outcome) const { return count_[static_cast<std::size_t>(outcome)]; }

std::int64_t Tally::outside_im() const { return count_[layout_.outside]; }

std::int64_t Tally::failed(std::size_t bin) const { return count_[layout_.failed + bin]; }

std::int64_t Tally::missing(std::size_t edp) const { return count_[layout_.missing + edp]; }

std::int64_t Tally::samples() const {
  return std::accumulate(count_.begin(), count_.begin() + outcome_count, std::int64_t{0});
}

std::vector<bool> Tally::groups_with_samples() const {
  std::vector<bool> there(layout_.groups, false);
  for (std::size_t cell = 0; cell < layout_.im_cell_count(); ++cell)
    for (std::size_t g = 0; g < layout_.groups; ++g)
      if (im_cell_n(cell, g) > 0) there[g] = true;
  return there;
}

Counts Tally::counts(std::size_t edp, std::size_t bin, std::size_t group) const {
  const std::int64_t* n = &count_[layout_.at_bin(edp, bin, group)];
  const ExactSum* sums = &sum_[layout_.at_bin_sum(edp, bin, group)];
  return {n[0],           n[1], n[2], n[3], n[4], sums[0].value(), sums[1].value(), sums[2].value(), sums[3].value(),
          sums[4].value()};
}

std::int64_t Tally::exceeding(std::size_t edp, std::size_t bin, std::size_t group, std::size_t capacity) const {
  return count_[layout_.at_exceeding(edp, bin, group) + capacity];
}

std::span<const std::int64_t> Tally::histogram(std::size_t edp, std::size_t bin) const {
  if (options_.edps[edp].binary) return {};
  constexpr auto cells = static_cast<std::size_t>(ln_cell_count);
  return {&count_[layout_.histogram[edp] + bin * cells], cells};
}

std::int64_t Tally::axis_n(std::size_t edp, std::size_t axis, std::size_t bin, std::size_t cell,
                           std::size_t group) const {
  return count_[layout_.at_axis(edp, axis, bin, cell, group)];
}

std::int64_t Tally::axis_exceeding(std::size_t edp, std::size_t axis, std::size_t bin, std::size_t cell,
                                   std::size_t group, std::size_t capacity) const {
  return count_[layout_.at_axis(edp, axis, bin, cell, group) + 1 + capacity];
}

double Tally::mean_on_axis(std::size_t axis, std::size_t cell) const {
  const std::int64_t n = count_[layout_.axis_counts[axis] + cell];
  return n > 0 ? sum_[layout_.axis_sums[axis] + cell].value() / static_cast<double>(n)
               : std::numeric_limits<double>::quiet_NaN();
}

ImCell Tally::im_cell(std::size_t cell) const {
  ImCell total;
  for (std::size_t g = 0; g < layout_.groups; ++g) total.n += im_cell_n(cell, g);
  total.im_sum = sum_[layout_.im_sums + cell].value();
  return total;
}

double Tally::mean_im(std::size_t bin) const {
  double n = 0, sum = 0;
  for (std::size_t i = 0; i < TallyLayout::cells_per_bin; ++i) {
    const ImCell cell = im_cell(bin * TallyLayout::cells_per_bin + i);
    n += static_cast<double>(cell.n);
    sum += cell.im_sum;
  }
  return n > 0 ? sum / n : std::numeric_limits<double>::quiet_NaN();
}

std::int64_t Tally::im_cell_n(std::size_t cell, std::size_t group) const {
  return count_[layout_.at_im_cell(cell, group)];
}

std::int64_t Tally::im_cell_over(std::size_t cell, std::size_t group) const {
  return count_[layout_.at_im_cell(cell, group) + 1];
}

std::int64_t Tally::moved_in_cell(std::size_t edp, std::size_t cell, std::size_t group) const {
  return options_.edps[edp].binary ? 0 : count_[layout_.at_moved_in_cell(edp, cell, group)];
}

std::int64_t Tally::still_in_cell(std::size_t edp, std::size_t cell, std::size_t group) const {
  const std::int64_t over = options_.edps[edp].censored ? im_cell_over(cell, group) : 0;
  return im_cell_of(edp, cell, group)[0] - over - moved_in_cell(edp, cell, group);
}

std::span<const std::int64_t> Tally::im_cell_of(std::size_t edp, std::size_t cell, std::size_t group) const {
  return {&count_[layout_.at_im_cell_of(edp, cell, group)], 1 + layout_.capacity_count[edp]};
}

RegressionSums Tally::regression(std::size_t edp, std::size_t group) const {
  return regression_sums(&sum_[layout_.at_regression(edp, group)], capacity_[edp].front());
}

RegressionSums Tally::regression(std::size_t edp) const {
  ExactSum total[TallyLayout::sums_per_regression];
  for (std::size_t g = 0; g < layout_.groups; ++g)
    for (std::size_t i = 0; i < std::size(total); ++i) total[i].add(sum_[layout_.at_regression(edp, g) + i]);
  return regression_sums(total, capacity_[edp].front());
}

}  // namespace freestand::fragility
