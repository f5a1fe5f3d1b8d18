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

struct Node {
  double im;
  Probability p;
};

// The points that are known, at intensities above zero.
std::vector<const Point*> usable(const Curve& curve) {
  std::vector<const Point*> points;
  for (const Point& point : curve.points)
    if (std::isfinite(point.probability) && point.im > 0) points.push_back(&point);
  return points;
}

// Does the curve fall from its first point on, by more than the limits of both?
bool falls(const std::vector<const Point*>& points) {
  return std::any_of(points.begin(), points.end(), [&](const Point* p) { return p->upper < points.front()->lower; });
}

// Lines over the intensity, level beyond the points.
Probability lines(const std::vector<Node>& nodes, double im) {
  const auto next = std::find_if(nodes.begin(), nodes.end(), [&](const Node& n) { return n.im >= im; });
  if (next == nodes.end()) return nodes.back().p;
  Probability p = next->p;
  if (next == nodes.begin()) return p;
  const auto& [before, a] = *(next - 1);
  const double rest = (next->im - im) / (next->im - before);
  for (double Probability::*member : {&Probability::value, &Probability::lower, &Probability::upper})
    p.*member -= rest * (p.*member - a.*member);
  p.resolution = std::max(p.resolution, a.resolution);
  return p;
}

}  // namespace

Probability blend(std::span<const Probability> known, std::span<const double> weights) {
  double resolution = least_resolution;
  for (const Probability& p : known) resolution = std::max(resolution, p.resolution);
  const auto none = [&](const Probability& p) { return p.value <= resolution; };
  const auto all = [&](const Probability& p) { return p.value >= 1 - resolution; };
  const auto every = [&](auto&& is) { return std::all_of(known.begin(), known.end(), is); };
  const auto any = [&](auto&& is, bool negative_too = false) {
    for (std::size_t i = 0; i < known.size(); ++i)
      if ((weights[i] > 0 || (negative_too && weights[i] < 0)) && is(known[i])) return true;
    return false;
  };
  // Between one that never happened, or always did, and one that did sometimes, Phi^-1 tells how many samples there were, and not where
  // between them the change begins.
  const bool mixed = (any(none, true) && !every(none)) || (any(all, true) && !every(all));
  // Of weights below zero, which extrapolate, the opposite end.
  const auto mean = [&](double Probability::*end, double Probability::*opposite) {
    const auto of = [&](std::size_t i) { return known[i].*(weights[i] < 0 ? opposite : end); };
    bool plain = mixed, low = true, high = true;
    for (std::size_t i = 0; i < known.size(); ++i) low &= of(i) <= resolution, high &= of(i) >= 1 - resolution;
    plain = plain || low || high;
    double sum = 0;
    for (std::size_t i = 0; i < known.size(); ++i)
      sum += weights[i] * (plain ? of(i) : gsl_cdf_ugaussian_Pinv(drawn_in(of(i), resolution)));
    return std::clamp(plain ? sum : gsl_cdf_ugaussian_P(sum), 0.0, 1.0);
  };
  Probability blended{mean(&Probability::value, &Probability::value), mean(&Probability::lower, &Probability::upper),
                      mean(&Probability::upper, &Probability::lower), resolution};
  // Phi^-1 has no end at 0 and 1: where one of them may be there, so may what lies between.
  if (any([](const Probability& p) { return p.lower <= 0; })) blended.lower = 0;
  if (any([](const Probability& p) { return p.upper >= 1; })) blended.upper = 1;
  for (std::size_t i = 0; mixed && i < known.size(); ++i)
    if (weights[i] > 0) {
      blended.lower = std::min(blended.lower, known[i].lower);
      blended.upper = std::max(blended.upper, known[i].upper);
    }
  return blended;
}

Probability at(const Curve& curve, double im) {
  const std::vector<const Point*> points = usable(curve);
  if (points.empty()) return {};
  const auto fitted = [&](double x) { return gsl_cdf_ugaussian_P(std::log(x / curve.median) / curve.dispersion); };
  std::vector<Node> nodes;
  if (!by_lognormal(curve)) {
    Probability start = of(*points.front());
    if (falls(points))
      start.upper = 1;
    else
      start.value = start.lower = 0;
    nodes.push_back({0, start});
    for (const Point* point : points) nodes.push_back({point->im, of(*point)});
    return lines(nodes, im);
  }
  for (const Point* point : points) {
    Probability p = of(*point);
    p.lower -= p.value;
    p.upper -= p.value;
    nodes.push_back({point->im, p});
  }
  Probability p = lines(nodes, im);
  p.value = fitted(im);
  p.lower = std::clamp(p.value + p.lower, 0.0, p.value);
  p.upper = std::clamp(p.value + p.upper, p.value, 1.0);
  return p;
}

bool by_lognormal(const Curve& curve) { return curve.family == lognormal_family && curve.dispersion > 0; }

bool outside(const Curve& curve, double im) { return im < curve.im_least || im > curve.im_most; }

}  // namespace freestand::database
