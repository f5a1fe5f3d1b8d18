#include "exports/curve.hpp"

#include <algorithm>
#include <cmath>

#include "fragility/normal.hpp"

namespace freestand::exports {
namespace {

// Where im lies among points whose im rises: between `below` and below + 1, `share` of the way.
struct Place {
  std::size_t below;
  double share;
};

template <class At>
Place place(const std::vector<At>& points, double im) {
  const auto above = std::upper_bound(points.begin(), points.end(), im, [](double x, const At& p) { return x < p.im; });
  if (above == points.begin()) return {0, 0};
  const auto below = static_cast<std::size_t>(above - points.begin()) - 1;
  if (above == points.end()) return {below, 0};
  return {below, (im - points[below].im) / (above->im - points[below].im)};
}

double between(double low, double high, double share) { return low + (high - low) * share; }

double of_points(const std::vector<Point>& points, double im) {
  const auto [below, share] = place(points, im);
  const Point& a = points[below];
  return share > 0 ? between(a.probability, points[below + 1].probability, share) : a.probability;
}

double of_parts(const Curve& curve, double im) {
  const auto [below, share] = place(curve.parts, im);
  const PartsPoint& a = curve.parts[below];
  const PartsPoint& b = share > 0 ? curve.parts[below + 1] : a;
  const double p_over = between(a.p_over, b.p_over, share), p_never = between(a.p_never, b.p_never, share),
               lambda = between(a.lambda, b.lambda, share), omega = between(a.omega, b.omega, share);
  return p_over + (1 - p_over) * (1 - p_never) * fragility::normal_cdf((lambda - curve.ln_capacity) / omega);
}

}  // namespace

Curve lognormal(double median, double dispersion) {
  Curve curve;
  curve.form = Form::lognormal;
  curve.median = median;
  curve.dispersion = dispersion;
  return curve;
}

double probability(const Curve& curve, double im) {
  if (curve.form == Form::lognormal)
    return im > 0 ? fragility::normal_cdf(std::log(im / curve.median) / curve.dispersion) : 0;
  return curve.form == Form::discrete ? of_points(curve.points, im) : of_parts(curve, im);
}

}  // namespace freestand::exports
