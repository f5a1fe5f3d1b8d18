#include "database/interpolate.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace freestand::database {
namespace {

constexpr double least_resolution = 1e-12;  // Phi^-1 is finite there

// Half a sample: with fewer, none of n would be expected to show it.
double resolution_of(const Point& point) {
  return std::clamp(0.5 / static_cast<double>(std::max<std::int64_t>(point.n, 1) + 1), least_resolution, 0.25);
}

Probability of(const Point& point) { return {point.probability, point.lower, point.upper, resolution_of(point)}; }

double drawn_in(double p, double resolution) { return std::clamp(p, resolution, 1 - resolution); }

// The points that are known, at intensities above zero.
std::vector<const Point*> usable(const Curve& curve) {
  std::vector<const Point*> points;
  for (const Point& point : curve.points)
    if (std::isfinite(point.probability) && point.im > 0) points.push_back(&point);
  return points;
}

// Change of Phi^-1(P) with ln IM at an end of the points: of the fitted lognormal, or of the last two points where they rise.
double slope_at(const Curve& curve, const std::vector<const Point*>& points, std::size_t end) {
  if (curve.dispersion > 0) return 1 / curve.dispersion;
  if (points.size() < 2) return 0;
  const Probability a = of(*points[end ? end - 1 : 0]), b = of(*points[end ? end : 1]);
  const double resolution = std::max(a.resolution, b.resolution);
  const double rise =
      gsl_cdf_ugaussian_Pinv(drawn_in(b.value, resolution)) - gsl_cdf_ugaussian_Pinv(drawn_in(a.value, resolution));
  return std::max(0.0, rise / std::log(points[end ? end : 1]->im / points[end ? end - 1 : 0]->im));
}

Probability beyond(const Curve& curve, const std::vector<const Point*>& points, std::size_t end, double im) {
  Probability p = of(*points[end]);
  const double shift = slope_at(curve, points, end) * std::log(im / points[end]->im);
  for (double Probability::*member : {&Probability::value, &Probability::lower, &Probability::upper})
    if (p.*member > 0 && p.*member < 1) p.*member = gsl_cdf_ugaussian_P(gsl_cdf_ugaussian_Pinv(p.*member) + shift);
  return p;
}

}  // namespace

Probability blend(std::span<const Probability> known, std::span<const double> weights) {
  double resolution = least_resolution;
  for (const Probability& p : known) resolution = std::max(resolution, p.resolution);
  const auto mean = [&](double Probability::*member) {
    const auto all = [&](auto&& is) { return std::all_of(known.begin(), known.end(), is); };
    const bool plain = all([&](const Probability& p) { return p.*member <= resolution; }) ||
                       all([&](const Probability& p) { return p.*member >= 1 - resolution; });
    double sum = 0;
    for (std::size_t i = 0; i < known.size(); ++i) {
      const double p = known[i].*member;
      sum += weights[i] * (plain ? p : gsl_cdf_ugaussian_Pinv(drawn_in(p, resolution)));
    }
    return std::clamp(plain ? sum : gsl_cdf_ugaussian_P(sum), 0.0, 1.0);
  };
  return {mean(&Probability::value), mean(&Probability::lower), mean(&Probability::upper), resolution};
}

Probability at(const Curve& curve, double im) {
  const std::vector<const Point*> points = usable(curve);
  if (points.empty()) return {};
  const auto next = std::find_if(points.begin(), points.end(), [&](const Point* p) { return p->im >= im; });
  if (next == points.end()) return beyond(curve, points, points.size() - 1, im);
  if ((*next)->im == im) return of(**next);
  if (next == points.begin()) return beyond(curve, points, 0, im);
  const Point &a = **(next - 1), &b = **next;
  const double t = std::log(im / a.im) / std::log(b.im / a.im);
  return blend(std::array{of(a), of(b)}, std::array{1 - t, t});
}

bool outside(const Curve& curve, double im) { return im < curve.im_least || im > curve.im_most; }

}  // namespace freestand::database
