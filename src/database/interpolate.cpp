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

// Straight lines in P over the intensity: from 0 at 0 to the first point, level above the last.
Probability straight(const std::vector<const Point*>& points, double im) {
  const auto next = std::find_if(points.begin(), points.end(), [&](const Point* p) { return p->im >= im; });
  if (next == points.end()) return of(*points.back());
  Probability p = of(**next);
  if (next == points.begin()) {
    p.value *= im / (*next)->im;
    p.lower *= im / (*next)->im;
    return p;
  }
  const Point& before = **(next - 1);
  const double rest = ((*next)->im - im) / ((*next)->im - before.im);
  const Probability a = of(before);
  for (double Probability::*member : {&Probability::value, &Probability::lower, &Probability::upper})
    p.*member -= rest * (p.*member - a.*member);
  p.resolution = std::max(p.resolution, a.resolution);
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
  Probability p = straight(points, im);
  if (!by_lognormal(curve)) return p;
  const double by_points = p.value;
  p.value = gsl_cdf_ugaussian_P(std::log(im / curve.median) / curve.dispersion);
  if (im > points.back()->im || im < points.front()->im) {  // the band goes along
    p.lower += p.value - by_points;
    p.upper += p.value - by_points;
  }
  p.lower = std::clamp(p.lower, 0.0, p.value);
  p.upper = std::clamp(p.upper, p.value, 1.0);
  return p;
}

bool by_lognormal(const Curve& curve) { return curve.family == lognormal_family && curve.dispersion > 0; }

bool outside(const Curve& curve, double im) { return im < curve.im_least || im > curve.im_most; }

}  // namespace freestand::database
