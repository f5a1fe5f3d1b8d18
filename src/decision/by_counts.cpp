#include "decision/by_counts.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace freestand::decision {
namespace {

// Width of a panel in ln im. The midpoint's error is width^2/24 of the second derivative of P over ln im, which is 1e-3 of P where P falls
// by im^6.
constexpr double panel = 0.025;

using Shape = fragility::CountedCurve::Shape;

// In which cells the sharpest curve leaps: those whose neighbours differ most first, where neither of these leaps and the share lies between
// theirs. (Leaps in two cells side by side would make it fall between them.)
std::vector<bool> where_it_leaps(const std::vector<double>& share) {
  std::vector<bool> leaps(share.size(), false);
  std::vector<std::size_t> order;
  for (std::size_t i = 1; i + 1 < share.size(); ++i)
    if ((share[i] - share[i - 1]) * (share[i + 1] - share[i]) >= 0 && share[i + 1] != share[i - 1]) order.push_back(i);
  std::ranges::stable_sort(order, std::ranges::greater{},
                           [&](std::size_t i) { return std::fabs(share[i + 1] - share[i - 1]); });
  for (const std::size_t i : order) leaps[i] = !leaps[i - 1] && !leaps[i + 1];
  return leaps;
}

}  // namespace

ByCounts::ByCounts(const HazardCurve& hazard, const fragility::Result& result, const fragility::EdpResult& edp,
                   std::size_t capacity, const fragility::FragilityFunction& f, const Range& swept)
    : hazard_(hazard),
      result_(result),
      edp_(edp),
      f_(f),
      capacity_(capacity),
      swept_from_(swept.from),
      bins_(fragility::counted_bins(result, edp, capacity)) {
  if (empty()) return;
  weight_ = weights();
  const double first = std::max(hazard.first(), swept.from);
  if (!(first < hazard.last())) return;
  const int panels = static_cast<int>(std::ceil(std::log(hazard.last() / first) / panel));
  for (int i = 0; i <= panels; ++i)
    node_.push_back(first * std::pow(hazard.last() / first, i / static_cast<double>(panels)));
  for (std::size_t i = 0; i + 1 < node_.size(); ++i) {
    middle_.push_back(std::sqrt(node_[i] * node_[i + 1]));
    events_.push_back(hazard.rate(node_[i]) - hazard.rate(node_[i + 1]));
  }
}

std::vector<double> ByCounts::weights() const {
  TabulatedFragility table{{}, {}, {swept_from_, std::numeric_limits<double>::infinity()}};
  for (const fragility::CountedBin& bin : bins_) table.im.push_back(bin.im);
  std::vector<double> weight = rate_weights(hazard_, table);
  const auto next =
      static_cast<std::size_t>(std::upper_bound(table.im.begin(), table.im.end(), hazard_.last()) - table.im.begin());
  const std::size_t low = next == 0 ? 0 : next - 1, high = std::min(next, table.im.size() - 1);
  const double share =
      low == high ? 0 : std::log(hazard_.last() / table.im[low]) / std::log(table.im[high] / table.im[low]);
  weight[low] += (1 - share) * hazard_.annual_rate.back();
  weight[high] += share * hazard_.annual_rate.back();
  return weight;
}

double ByCounts::integral(const fragility::CountedCurve& curve, const Range& range) const {
  double sum = range.to > hazard_.last() ? hazard_.annual_rate.back() * curve(hazard_.last()) : 0;
  for (std::size_t i = 0; i < middle_.size(); ++i) {
    const double from = std::max(node_[i], range.from), to = std::min(node_[i + 1], range.to);
    const bool whole = from == node_[i] && to == node_[i + 1];
    if (from < to) sum += curve(middle_[i]) * (whole ? events_[i] : hazard_.rate(from) - hazard_.rate(to));
  }
  return sum;
}

fragility::CountedCurve ByCounts::curve(const std::vector<fragility::CountedBin>& bins, const Shape& shape) const {
  if (by_cells()) return fragility::CountedCurve::through_cells(shape);
  return {bins, shape};
}

double ByCounts::half_a_leap(const fragility::CountedCurve& lines, const std::vector<double>& share,
                             const Range& range) const {
  const std::vector<double>& im = f_.cell_im;
  const Range within{std::max({range.from, im.front(), hazard_.first()}),
                     std::min({range.to, im.back(), hazard_.last()})};
  if (!(within.from < within.to)) return 0;
  const auto events = [&](double from, double to) {
    from = std::max(from, within.from), to = std::min(to, within.to);
    return from < to ? hazard_.rate(from) - hazard_.rate(to) : 0;
  };
  const std::vector<bool> leaps = where_it_leaps(share);
  double leaping = 0, from = im.front();
  for (std::size_t i = 0; i < im.size(); ++i) {
    const double to = i + 1 < im.size() ? (im[i] + im[i + 1]) / 2 : im[i];
    if (leaps[i]) {
      const double below = share[i - 1], above = share[i + 1];
      const double at = to - (share[i] - below) / (above - below) * (to - from);
      leaping += below * events(from, at) + above * events(at, to);
    } else {
      leaping += share[i] * events(from, to);
    }
    from = to;
  }
  return (leaping - integral(lines, within)) / 2;
}

double ByCounts::rate_of(const std::vector<fragility::CountedBin>& bins, const Shape& shape, const Range& range) const {
  const fragility::CountedCurve lines = curve(bins, shape);
  return integral(lines, range) + (by_cells() ? half_a_leap(lines, shape.cell_share, range) : 0);
}

double ByCounts::rate(const Range& range) const { return rate_of(bins_, Shape(f_), range); }

Rate ByCounts::banded(const CurveReach& curve) {
  struct Row {
    double weight, to_lower, to_upper,
        to_falling;  // P of the bin to its limits: down, up, up where P falls as the curve
  };
  std::vector<Row> known_by_limits;
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    if (!same(i)) continue;
    const fragility::Interval limits = rising_limits(i);
    const double p = bins_[i].probability, falling = p == 0 ? std::fmin(limits.upper, falling_limit(i)) : limits.upper;
    known_by_limits.push_back({weight_[i], p - limits.lower, limits.upper - p, falling - p});
  }
  // Of a row of which nothing (or all) was counted in tail^share of the cases.
  const bool same_records = result_.left_out_records > 0;
  const auto added = [&](double Row::*reach, double share) {
    double sum = 0, squares = 0;
    for (const Row& row : known_by_limits) {
      const double unseen = row.weight * (1 - std::pow(1 - row.*reach, share));
      sum += unseen;
      squares += unseen * unseen;
    }
    return same_records ? sum : std::sqrt(squares);
  };
  const double value = rate(), tail = (1 - result_.confidence) / 2;
  const RateLimits limits(
      value, rates_left_out(),
      rates(edp_.surface.resampled, f_.resampled_median, f_.resampled_dispersion, f_.resampled_cell_share), result_,
      curve);
  if (std::isnan(limits.lower(tail))) return {value};
  // Each tail is asked for again and again, and takes two integrals over the hazard curve.
  std::map<double, double> lowers, uppers;
  const auto counted_lower = [&](double of) {
    const auto [known, fresh] = lowers.try_emplace(of);
    if (fresh) known->second = limits.lower(of);
    return known->second;
  };
  const auto counted_upper = [&](double of) {
    const auto [known, fresh] = uppers.try_emplace(of);
    if (fresh) known->second = limits.upper(of);
    return known->second;
  };
  const auto lower = [&](double of) {
    return -fragility::largest_beside_nothing(
        of, [&](double share, double rest) { return added(&Row::to_lower, share) - counted_lower(rest); });
  };
  const auto upper_with = [&](double Row::*reach, double of) {
    return fragility::largest_beside_nothing(
        of, [&](double share, double rest) { return added(reach, share) + counted_upper(rest); });
  };
  double least = lower(tail), most = upper_with(&Row::to_upper, tail);
  const double for_least = fragility::unused_tail(tail, +1, counted_upper, most),
               for_most = fragility::unused_tail(tail, -1, counted_lower, least);
  if (for_least > 0) least = lower(tail + for_least);
  if (for_most > 0) most = upper_with(&Row::to_upper, tail + for_most);
  const double coarse = by_cells() ? half_a_leap(this->curve(bins_, Shape(f_)), f_.cell_share, {}) : 0;
  const auto above = [&](double limit) { return value + std::hypot(limit - value, coarse); };
  upper_if_falling_ = above(std::min(most, upper_with(&Row::to_falling, tail)));
  return {value, std::max(0.0, value - std::hypot(value - least, coarse)),
          std::min(hazard_.annual_rate.front(), above(most))};
}

std::vector<double> ByCounts::rates_left_out() const {
  return rates(edp_.surface.left_out, f_.left_out_median, f_.left_out_dispersion, f_.left_out_cell_share);
}

double ByCounts::rate_below(const HazardCurve& hazard, const Range& range) const {
  struct Point {
    double im, share, n;
  };
  std::vector<Point> points;
  if (std::isnan(f_.median))
    for (std::size_t i = 0; i < f_.cell_share.size(); ++i)
      points.push_back({f_.cell_im[i], f_.cell_share[i], f_.cell_n[i]});
  if (points.empty())
    for (const fragility::CountedBin& bin : bins_)
      points.push_back({bin.im, bin.probability, static_cast<double>(edp_.bins[bin.index].n)});
  const Point& first = points.front();
  const double from = std::max(range.from, hazard.first());
  if (!(first.share > 0) || !(from < range.to)) return 0;
  const double level = first.share * (hazard.rate(from) - hazard.rate(range.to));
  const auto larger = std::ranges::find_if(points, [&](const Point& other) { return other.share > first.share; });
  if (larger == points.end()) return level;
  // A share of 1 is that of all samples there: half a sample less.
  const double low = gsl_cdf_ugaussian_Pinv(first.share),
               high = gsl_cdf_ugaussian_Pinv(std::min(larger->share, 1 - 0.5 / std::max(larger->n, 1.0)));
  if (!(high > low)) return level;
  const double dispersion = std::log(larger->im / first.im) / (high - low);
  return annual_rate(hazard, {first.im * std::exp(-low * dispersion), dispersion}, range);
}

double ByCounts::unknown_above(double im) const {
  std::size_t last = bins_.size() - 1;
  while (last > 0 && bins_[last].im > im) --last;
  const double p = curve(bins_, Shape(f_))(im);
  for (std::size_t i = 0; i < last; ++i)
    if (edp_.surface.empirical_lower[at(i)] > edp_.surface.empirical_upper[at(last)]) return p;
  return 1 - p;
}

// Of a row in which nothing was counted: its upper limit, or that of a row at a higher intensity where it is less. Of one in which all
// was counted the lower limit alike.
fragility::Interval ByCounts::rising_limits(std::size_t i) {
  const std::vector<double>&lower = edp_.surface.empirical_lower, &upper = edp_.surface.empirical_upper;
  fragility::Interval limits{lower[at(i)], upper[at(i)]};
  if (bins_[i].probability == 0)
    for (std::size_t j = i; j < bins_.size(); ++j) limits.upper = std::min(limits.upper, upper[at(j)]);
  if (bins_[i].probability == 1)
    for (std::size_t j = 0; j <= i; ++j) limits.lower = std::max(limits.lower, lower[at(j)]);
  bounded_by_others_ = bounded_by_others_ || limits.lower > lower[at(i)] || limits.upper < upper[at(i)];
  return limits;
}

// The limit of the lowest bin in which any was counted, times P here over P there by the resampled curves (what a tail of them exceeds).
double ByCounts::falling_limit(std::size_t i) const {
  const auto counted = std::find_if(bins_.begin(), bins_.end(), [](const auto& bin) { return bin.probability > 0; });
  if (counted == bins_.end() || counted->im <= bins_[i].im) return fragility::unknown;
  std::vector<double> falls;
  for (std::size_t r = 0; r < f_.resampled_median.size(); ++r) {
    const LognormalFragility f{f_.resampled_median[r], f_.resampled_dispersion[r]};
    const double fall = f(bins_[i].im) / f(counted->im);
    if (std::isfinite(fall)) falls.push_back(fall);
  }
  std::sort(falls.begin(), falls.end());
  return edp_.surface.empirical_upper[at(static_cast<std::size_t>(counted - bins_.begin()))] *
         fragility::sorted_quantile(falls, (1 + result_.confidence) / 2);
}

// Of each resample, or of each group left out: `again` is [of them, im, capacity], with the curves of the same.
std::vector<double> ByCounts::rates(const std::vector<double>& again, const std::vector<double>& median,
                                    const std::vector<double>& dispersion,
                                    const std::vector<double>& cell_share) const {
  const std::size_t size = edp_.surface.empirical.size(), cells = f_.cell_share.size();
  std::vector<double> found(size == 0 ? 0 : again.size() / size, 0);
  std::vector<fragility::CountedBin> bins = bins_;
  Shape shape(f_);
  for (std::size_t r = 0; r < found.size(); ++r) {
    for (std::size_t i = 0; i < bins.size(); ++i) bins[i].probability = again[r * size + at(i)];
    shape.median = f_.median, shape.dispersion = f_.dispersion;
    if (r < median.size() && std::isfinite(median[r])) shape.median = median[r], shape.dispersion = dispersion[r];
    if ((r + 1) * cells <= cell_share.size())
      std::copy_n(cell_share.begin() + static_cast<long>(r * cells), cells, shape.cell_share.begin());
    found[r] = rate_of(bins, shape, {});
  }
  return found;
}

bool ByCounts::same(std::size_t i) const {
  for (std::size_t of = at(i); of < edp_.surface.resampled.size(); of += edp_.surface.empirical.size())
    if (edp_.surface.resampled[of] != bins_[i].probability) return false;
  return true;
}

}  // namespace freestand::decision
