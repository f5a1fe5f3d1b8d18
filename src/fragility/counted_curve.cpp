#include "fragility/counted_curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "fragility/normal.hpp"
#include "fragility/rising.hpp"

namespace freestand::fragility {
namespace {

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

// Where all cells of a bin hold samples these are taken to be spread evenly about the mean of each, and two places stand for such a spread (by
// Gauss and Legendre): with one, bins in the lower tail of a curve came out 1.6 % too low. Where some are empty the intensities are a
// list of a few, and each cell is at its own.
CountedBin counted_bin(const Result& result, std::size_t index, double probability) {
  CountedBin bin{.im = result.im[index], .probability = probability, .index = index};
  const std::size_t cells = result.cell_im.size() / result.im.size(), first = index * cells;
  const double from = result.im_edge[index], width = (result.im_edge[index + 1] - from) / static_cast<double>(cells);
  const auto samples = std::span(result.cell_n).subspan(first, cells);
  const bool spread = std::ranges::find(samples, 0) == samples.end();
  for (std::size_t cell = 0; cell < cells; ++cell) {
    if (samples[cell] == 0) continue;
    const double im = result.cell_im[first + cell], below = im - from - static_cast<double>(cell) * width;
    const double reach =
        spread ? std::max(0.0, std::min({width / (2 * std::numbers::sqrt3), below, width - below})) : 0;
    const double half = static_cast<double>(samples[cell]) / 2;
    bin.places.push_back({im - reach, half});
    bin.places.push_back({im + reach, half});
  }
  return bin;
}

std::vector<CountedBin> counted_bins(const Result& result, const EdpResult& edp, std::size_t capacity) {
  std::vector<CountedBin> bins;
  for (std::size_t i = 0; i < result.im.size(); ++i) {
    const double p = edp.surface.empirical[i * edp.capacity.size() + capacity];
    if (std::isfinite(p) && result.im[i] > 0) bins.push_back(counted_bin(result, i, p));
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
  if (bin.places.empty() || fitted(bin.im) == shown) return bin.im;
  double low = bin.places.front().im, high = bin.places.back().im;
  if (!(fitted(low) < shown && shown < fitted(high))) return bin.im;
  for (int i = 0; i < 60 && low < high; ++i) (fitted(0.5 * (low + high)) < shown ? low : high) = 0.5 * (low + high);
  return high;
}

double CountedCurve::lognormal(double im) const {
  return im > 0 && shape_.median > 0 && shape_.dispersion > 0
             ? normal_cdf(std::log(im / shape_.median) / shape_.dispersion)
             : 0;
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
// curve is looked up.
double CountedCurve::over_bin(const CountedBin& bin) const {
  const double middle = fitted(bin.im);
  double beside = 0, n = 0;
  for (const CountedBin::Place& place : bin.places) beside += place.n * (fitted(place.im) - middle), n += place.n;
  return n > 0 ? middle + beside / n : middle;
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
