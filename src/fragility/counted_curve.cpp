#include "fragility/counted_curve.hpp"

#include <algorithm>
#include <cmath>

#include "fragility/normal.hpp"
#include "fragility/rising.hpp"

namespace freestand::fragility {
namespace {

// Intensities of a bin from `from` to 1 are taken to be spread as x^(p - 1), evenly in x^p (p = 1: in x; 0: in ln x), with the p that gives
// them their mean, p/(p + 1) (1 - from^(p + 1))/(1 - from^p), which grows with p.
constexpr double small_power =
    1e-6;  // nearer to 0 x^(1/p) loses over half of its figures, and ln x is off by p (ln from)^2/8 at most
double power_with_mean(double from, double mean) {
  if (from <= 0) return mean / (1 - mean);
  double low = -40, high = 40;  // means within a fortieth of either end: from there on they do not matter
  for (int i = 0; i < 40; ++i) {
    const double p = (low + high) / 2 + 1e-12;
    const double there = p / (p + 1) * std::expm1((p + 1) * std::log(from)) / std::expm1(p * std::log(from));
    (there < mean ? low : high) = (low + high) / 2;
  }
  return (low + high) / 2;
}

// Puts the places between `low` and `high` that the curve needs behind `places`. A fiftieth at the middle of a line is a seventy-fifth on
// its average, which does not show in the two digits that a rate is told in; 1e-6 is what exports are held to.
void follow(const CountedCurve& curve, double low, double high, int depth, std::vector<double>& places) {
  constexpr double share = 0.02, least = 1e-6;
  const double middle = std::sqrt(low * high), here = curve(middle);
  const double line = curve(low) + (curve(high) - curve(low)) * (middle - low) / (high - low);
  if (depth == 0 || std::fabs(line - here) <= share * here + least) return;
  follow(curve, low, middle, depth - 1, places);
  places.push_back(middle);
  follow(curve, middle, high, depth - 1, places);
}

}  // namespace

std::vector<CountedBin> counted_bins(const Result& result, const EdpResult& edp, std::size_t capacity) {
  std::vector<CountedBin> bins;
  for (std::size_t i = 0; i < result.im.size(); ++i) {
    const double p = edp.surface.empirical[i * edp.capacity.size() + capacity];
    if (std::isfinite(p) && result.im[i] > 0)
      bins.push_back({result.im[i], p, result.im_edge[i], result.im_edge[i + 1], false, i});
  }
  return bins;
}

CountedCurve CountedCurve::through_cells(Shape shape) {
  CountedCurve curve(std::move(shape));
  for (std::size_t i = 0; i < curve.shape_.cell_im.size(); ++i)
    curve.knots_.push_back({curve.shape_.cell_im[i], curve.shape_.cell_share[i], curve.shape_.cell_share[i]});
  return curve;
}

CountedCurve::CountedCurve(const std::vector<CountedBin>& bins, Shape shape) : shape_(std::move(shape)) {
  shape_.cell_share = risen(shape_.cell_share, shape_.cell_n);
  for (const CountedBin& bin : bins) {
    double shown = bin.by_law ? fitted(bin.im) : over_bin(bin);
    if (!knots_.empty()) shown = std::max(shown, knots_.back().fitted);
    knots_.push_back({where(bin, shown), shown, bin.probability});
  }
}

// Where the curve within a bin shows what the whole bin does; its mean, where there is no such place or the curve is level.
double CountedCurve::where(const CountedBin& bin, double shown) const {
  if (!(bin.from >= 0) || !std::isfinite(bin.to) || fitted(bin.im) == shown) return bin.im;
  double low = bin.from, high = bin.to;
  if (!(fitted(low) < shown && shown < fitted(high))) return bin.im;
  for (int i = 0; i < 60 && low < high; ++i) (fitted(0.5 * (low + high)) < shown ? low : high) = 0.5 * (low + high);
  return high;
}

double CountedCurve::lognormal(double im) const {
  return shape_.median > 0 && shape_.dispersion > 0 ? normal_cdf(std::log(im / shape_.median) / shape_.dispersion) : 0;
}

double CountedCurve::fitted(double im) const {
  const std::vector<double>&at = shape_.cell_im, &share = shape_.cell_share;
  if (share.empty()) return lognormal(im);
  const auto next = std::upper_bound(at.begin(), at.end(), im);
  if (next == at.begin()) {
    const double first = lognormal(at.front());
    return first > 0 ? share.front() * lognormal(im) / first : share.front();
  }
  const std::size_t i = static_cast<std::size_t>(next - at.begin()) - 1;
  return next == at.end() ? share.back() : std::lerp(share[i], share[i + 1], (im - at[i]) / (at[i + 1] - at[i]));
}

// The mean over the intensities of a bin, about the curve at the bin's mean: where that is level the mean is the very number, by which the
// curve is looked up. By midpoints: of a bin that is w dispersions wide they are off by no more than (w/32)^2/24 of the
// curve's largest bend, 0.24, so by 1e-4 of one of three.
double CountedCurve::over_bin(const CountedBin& bin) const {
  if (!(bin.from >= 0) || !std::isfinite(bin.to) || !(bin.from < bin.im && bin.im < bin.to)) return fitted(bin.im);
  constexpr int points = 32;
  const double from = bin.from / bin.to, power = power_with_mean(from, bin.im / bin.to), low = std::pow(from, power);
  const double middle = fitted(bin.im);
  double beside = 0;
  for (int i = 0; i < points; ++i) {
    const double u = (i + 0.5) / points;
    beside += fitted(bin.to * (std::fabs(power) < small_power ? std::pow(from, 1 - u)
                                                              : std::pow(low + u * (1 - low), 1 / power))) -
              middle;
  }
  return middle + beside / points;
}

double CountedCurve::operator()(double im) const {
  const double f = fitted(im);
  const auto next = std::ranges::upper_bound(knots_, im, {}, &Knot::im);
  const Knot &first = knots_.front(), &last = knots_.back();
  // F may fall where it has no median: P stays between the shares all the same.
  if (next == knots_.begin())
    return first.fitted > 0 ? first.probability * std::min(1.0, f / first.fitted) : first.probability;
  if (next == knots_.end()) {
    if (!(last.fitted < 1)) return last.probability;
    const double in_the_end = last.fitted > 0 ? std::min(1.0, last.probability / last.fitted) : 1;
    return std::lerp(last.probability, in_the_end, std::max(0.0, (f - last.fitted) / (1 - last.fitted)));
  }
  const Knot &low = *(next - 1), &high = *next;
  const bool rise = high.fitted > low.fitted && high.probability > low.probability;
  const double along = rise ? (f - low.fitted) / (high.fitted - low.fitted) : (im - low.im) / (high.im - low.im);
  return std::lerp(low.probability, high.probability, std::clamp(along, 0.0, 1.0));
}

std::vector<double> places_to_follow(const CountedCurve& curve, const std::vector<CountedBin>& bins, double least,
                                     double most) {
  // Of a bin of three dispersions a line over a 32nd is off by (3/32)^2/8 of 0.24 at most, 3e-4.
  constexpr int halvings = 5;
  std::vector<double> ends, places;
  if (least > 0 && least < bins.front().im) ends.push_back(least);
  for (const CountedBin& bin : bins) ends.push_back(bin.im);
  if (most > bins.back().im && std::isfinite(most)) ends.push_back(most);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (i > 0) follow(curve, ends[i - 1], ends[i], halvings, places);
    places.push_back(ends[i]);
  }
  return places;
}

}  // namespace freestand::fragility
