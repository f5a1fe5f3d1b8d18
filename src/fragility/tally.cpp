#include "fragility/tally.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <numeric>

#include "fragility/histogram.hpp"
#include "fragility/validate.hpp"

namespace freestand::fragility {
namespace {

// Squares of larger numbers leave the range of exact sums.
constexpr double largest = 1e12;

bool sound(Outcome outcome) {
  return outcome == Outcome::at_rest || outcome == Outcome::moved || outcome == Outcome::overturned;
}

Options checked(Options options) {
  validate(options);
  return options;
}

// Fine cell inside a bin; the bin's edges share out by equal width.
std::size_t cell_in_bin(const std::vector<double>& edge, std::size_t bin, double im) {
  constexpr std::size_t cells = TallyLayout::cells_per_bin;
  const double place = std::clamp((im - edge[bin]) / (edge[bin + 1] - edge[bin]), 0.0, 1.0);
  return std::min(static_cast<std::size_t>(place * static_cast<double>(cells)), cells - 1);
}

}  // namespace

Tally::Tally(Options options)
    : options_(checked(std::move(options))),
      groups_(options_),
      layout_(options_, static_cast<std::size_t>(groups_.count())),
      count_(layout_.count_size, 0),
      sum_(layout_.sum_size) {
  for (const EdpOptions& edp : options_.edps) capacity_.push_back(capacities(edp));
}

void Tally::add(const Sample& sample) {
  if (sample.edp.size() != options_.edps.size() || sample.axis.size() != options_.axes.size())
    throw Error("a sample cannot be counted (another number of EDPs or axes than the options have): pass one of each",
                Exit::data);
  const auto group = static_cast<std::size_t>(groups_.group(sample.motion, sample.index));
  ++count_[static_cast<std::size_t>(sample.outcome)];
  const int found = std::abs(sample.im) < largest ? bin_index(options_.im_edge, sample.im, options_.open_ends) : -1;
  const auto bin = static_cast<std::size_t>(found);
  if (!sound(sample.outcome)) {
    if (found >= 0) ++count_[layout_.failed + bin];
    return;
  }
  if (found < 0) {
    ++count_[layout_.outside];
    return;
  }
  const std::size_t cell = bin * TallyLayout::cells_per_bin + cell_in_bin(options_.im_edge, bin, sample.im);
  ++count_[layout_.at_im_cell(cell, group)];
  if (sample.outcome == Outcome::overturned) ++count_[layout_.at_im_cell(cell, group) + 1];
  sum_[layout_.im_sums + cell].add(sample.im);
  for (std::size_t a = 0; a < options_.axes.size(); ++a) {
    const int on_axis = bin_index(options_.axes[a].edge, sample.axis[a]);
    if (on_axis < 0 || !(std::abs(sample.axis[a]) < largest)) continue;
    ++count_[layout_.axis_counts[a] + static_cast<std::size_t>(on_axis)];
    sum_[layout_.axis_sums[a] + static_cast<std::size_t>(on_axis)].add(sample.axis[a]);
  }
  const Place place{bin, cell, group, std::log(sample.im)};
  for (std::size_t e = 0; e < layout_.edps; ++e) add_edp(e, place, sample);
  add_pairs(place, sample);
}

void Tally::add_edp(std::size_t e, const Place& place, const Sample& sample) {
  const auto [bin, cell, group, ln_im] = place;
  const EdpOptions& edp = options_.edps[e];
  const bool overturned = sample.outcome == Outcome::overturned;
  const bool fallen = overturned && edp.censored;  // above every capacity
  const bool over =
      fallen || (overturned && edp.binary);  // told apart from those that stand; else it goes by its value
  const double value = sample.edp[e];
  const double unit = edp.binary ? 1 : capacity_[e].front();
  if (!fallen && !(std::abs(value) < largest * unit)) {
    ++count_[layout_.missing + e];
    return;
  }
  const bool still = !over && value <= (edp.binary ? 0.5 : edp.still_threshold);
  std::int64_t* counts = &count_[layout_.at_bin(e, bin, group)];
  ++counts[0];
  ++counts[still ? 1 : over ? 2 : 3];

  const std::vector<double>& capacity = capacity_[e];
  const auto above = [&](std::size_t c) { return fallen || (!still && value > capacity[c]); };
  for (std::size_t c = 0; c < capacity.size(); ++c)
    if (above(c)) ++count_[layout_.at_exceeding(e, bin, group) + c];
  const auto count_at = [&](std::size_t first) {  // samples, then those above each capacity
    ++count_[first];
    for (std::size_t c = 0; c < capacity.size(); ++c)
      if (above(c)) ++count_[first + 1 + c];
  };
  count_at(layout_.at_im_cell_of(e, cell, group));
  for (std::size_t a = 0; a < options_.axes.size(); ++a) {
    const int on_axis = bin_index(options_.axes[a].edge, sample.axis[a]);
    if (on_axis >= 0) count_at(layout_.at_axis(e, a, bin, static_cast<std::size_t>(on_axis), group));
  }
  if (still || over || edp.binary) return;
  ++count_[layout_.at_moved_in_cell(e, cell, group)];
  const double ln_value = std::log(value);
  ExactSum* sums = &sum_[layout_.at_bin_sum(e, bin, group)];
  sums[0].add(ln_value);
  sums[1].add(ln_value * ln_value);
  const auto cell_of_residual = static_cast<std::size_t>(ln_cell(residual(e, bin, sample.im, ln_value)));
  ++count_[layout_.histogram[e] + bin * ln_cell_count + cell_of_residual];
  if (!(sample.im > 0)) {
    ++counts[4];
    return;
  }
  sums[2].add(ln_im);
  sums[3].add(ln_im * ln_im);
  sums[4].add(ln_value * ln_im);
  add_regression(e, place, sample.im, value);
}

double Tally::residual(std::size_t e, std::size_t bin, double im, double ln_value) const {
  if (options_.pilot_slope.empty() || !(im > 0)) return ln_value;
  return ln_value - options_.pilot_slope[e][bin] * std::log(im / options_.pilot_im[bin]);
}

// In units of the EDP's first capacity, so that the fixed resolution of ExactSum suits any unit.
void Tally::add_regression(std::size_t e, const Place& place, double im, double value) {
  const double x = im, y = value / capacity_[e].front();
  const double lx = place.ln_im, ly = std::log(y);
  const double terms[] = {1, x, y, x * x, x * y, y * y, lx, ly, lx * lx, lx * ly, ly * ly};
  static_assert(std::size(terms) == TallyLayout::sums_per_regression);
  ExactSum* sums = &sum_[layout_.at_regression(e, place.group)];
  for (std::size_t i = 0; i < std::size(terms); ++i) sums[i].add(terms[i]);
}

void Tally::merge(const Tally& other) {
  if (count_.size() != other.count_.size() || sum_.size() != other.sum_.size())
    throw Error("two tallies cannot be merged (their options differ): count both with the same options", Exit::data);
  for (std::size_t i = 0; i < count_.size(); ++i) count_[i] += other.count_[i];
  for (std::size_t i = 0; i < sum_.size(); ++i) sum_[i].add(other.sum_[i]);
}

}  // namespace freestand::fragility
