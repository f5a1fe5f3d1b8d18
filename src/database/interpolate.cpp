#include "database/interpolate.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

namespace freestand::database {
namespace {

constexpr double least_resolution = 1e-12;  // Phi^-1 is finite there
constexpr int halvings = 50;                // to round-off

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

// A curve as its family states it.
class Reading {
 public:
  explicit Reading(const Curve& curve)
      : lognormal_(by_lognormal(curve)), median_(curve.median), dispersion_(curve.dispersion) {
    const std::vector<const Point*> points = usable(curve);
    if (points.empty()) return;
    falls_ = !lognormal_ && falls(points);
    if (!lognormal_) {
      Probability start = of(*points.front());
      if (falls_)
        start.upper = 1;
      else
        start.value = start.lower = 0;
      nodes_.push_back({0, start});
    }
    for (const Point* point : points) {
      Probability p = of(*point);
      if (lognormal_) p.lower -= p.value, p.upper -= p.value;
      nodes_.push_back({point->im, p});
    }
  }

  bool known() const { return !nodes_.empty(); }
  bool falls_from_the_start() const { return falls_; }
  // The same, but for what of it falls by chance.
  Reading rising() const {
    Reading risen = *this;
    for (std::size_t i = 1; !lognormal_ && i < nodes_.size(); ++i)
      for (double Probability::*member : {&Probability::value, &Probability::lower, &Probability::upper})
        risen.nodes_[i].p.*member = std::max(risen.nodes_[i].p.*member, risen.nodes_[i - 1].p.*member);
    return risen;
  }

  Probability operator()(double im) const {
    if (!known()) return {};
    Probability p = lines(nodes_, im);
    if (!lognormal_) return p;
    p.value = gsl_cdf_ugaussian_P(std::log(im / median_) / dispersion_);
    p.lower = std::clamp(p.value + p.lower, 0.0, p.value);
    p.upper = std::clamp(p.value + p.upper, p.value, 1.0);
    return p;
  }

  // ln im of where it hardly begins, and of where it has come as far as it does.
  std::pair<double, double> reach() const {
    constexpr double far = 8;  // a lognormal is within 1e-15 of 0 and 1 so many dispersions from its median
    const std::size_t first = lognormal_ ? 0 : 1;
    const double from = std::log(nodes_[first].im) - far, to = std::log(nodes_.back().im);
    if (!lognormal_) return {from, to};
    return {std::min(from, std::log(median_) - far * dispersion_), std::max(to, std::log(median_) + far * dispersion_)};
  }
  bool never_exceeds() const {
    return !lognormal_ && std::ranges::all_of(nodes_, [](const Node& node) { return node.p.value == 0; });
  }
  // The same of its points.
  std::pair<double, double> ends() const {
    return {std::log(nodes_[lognormal_ ? 0 : 1].im), std::log(nodes_.back().im)};
  }

 private:
  bool lognormal_, falls_ = false;
  double median_, dispersion_;
  std::vector<Node> nodes_;
};

// A curve that rises, or an end of its band, read the other way round.
class Reached {
 public:
  // is_taken_off: with a negative weight. Beyond the points its band is level for want of knowledge, which is no reason to take more off.
  Reached(const Reading& curve, double Probability::*member, bool is_taken_off)
      : curve_(curve.rising()), member_(member) {
    std::tie(from_, to_) = is_taken_off && member != &Probability::value ? curve_.ends() : curve_.reach();
  }
  double most() const { return p_at(to_); }
  // ln of the intensity from which on it is p at least: so far down as it looks where it always is.
  double ln_im(double p) const {
    double below = from_, above = to_;
    if (p_at(below) >= p) return below;
    for (int i = 0; i < halvings; ++i) {
      const double middle = 0.5 * (below + above);
      (p_at(middle) >= p ? above : below) = middle;
    }
    return above;
  }

 private:
  double p_at(double ln_im) const { return curve_(std::exp(ln_im)).*member_; }

  Reading curve_;
  double Probability::*member_;
  double from_ = 0, to_ = 0;
};

bool is_negative(double weight) { return weight < 0; }

// P of curves at equal probability: that of which the weighed ln of the intensities at which they reach it is that of im. With a negative
// weight that sum need not rise with P, where the curve that is taken off hardly does. Then the largest sum of all smaller P counts, and
// for an upper end the smallest one of all larger P: the answer rises, and its band holds what lies between.
class AtEqualProbability {
 public:
  AtEqualProbability(std::span<const Reading> curves, std::span<const double> weights, double Probability::*member,
                     double Probability::*opposite)
      : upper_(member == &Probability::upper) {
    for (std::size_t i = 0; i < curves.size(); ++i) {
      if (weights[i] == 0) continue;
      reached_.emplace_back(curves[i], weights[i] < 0 ? opposite : member, weights[i] < 0);
      weights_.push_back(weights[i]);
      most_ = std::min(most_, reached_.back().most());
    }
    if (!std::ranges::any_of(weights, is_negative)) return;
    for (int i = 1; i < looks; ++i) {
      looked_at_.push_back(most_ * gsl_cdf_ugaussian_P(-5 + 10.0 * i / looks));
      sums_.push_back(ln_im(looked_at_.back()));
    }
    rises_ = sums_.back() > sums_.front();
    if (upper_)
      for (std::size_t i = sums_.size() - 1; i > 0; --i) sums_[i - 1] = std::min(sums_[i - 1], sums_[i]);
    else
      for (std::size_t i = 1; i < sums_.size(); ++i) sums_[i] = std::max(sums_[i], sums_[i - 1]);
  }

  double most() const { return most_; }  // that all curves reach
  bool rises() const { return rises_; }  // on the whole
  double operator()(double im) const {
    if (is_reached(most_, im)) return most_;
    double below = 0, above = most_;
    for (int i = 0; i < halvings; ++i) {
      const double middle = 0.5 * (below + above);
      (is_reached(middle, im) ? below : above) = middle;
    }
    return below;
  }

 private:
  static constexpr int looks = 60;
  double ln_im(double p) const {
    double sum = 0;
    for (std::size_t i = 0; i < reached_.size(); ++i) sum += weights_[i] * reached_[i].ln_im(p);
    return sum;
  }
  bool is_reached(double p, double im) const {
    const auto beyond = std::ranges::upper_bound(looked_at_, p);
    const auto next = static_cast<std::size_t>(beyond - looked_at_.begin());
    double sum = ln_im(p);
    if (upper_ && next < sums_.size()) sum = std::min(sum, sums_[next]);
    if (!upper_ && next > 0) sum = std::max(sum, sums_[next - 1]);
    return sum <= std::log(im);
  }

  bool upper_, rises_ = true;
  std::vector<Reached> reached_;
  std::vector<double> weights_, looked_at_, sums_;
  double most_ = 1;
};

}  // namespace

Probability between(std::span<const Curve* const> curves, std::span<const double> weights, double im) {
  std::vector<Reading> readings;
  for (const Curve* curve : curves) readings.emplace_back(*curve);
  if (readings.size() == 1) return readings.front()(im);
  std::vector<Probability> here;
  for (const Reading& reading : readings) here.push_back(reading(im));
  const Probability at_im = blend(here, weights);
  if (std::ranges::any_of(readings, [](const Reading& r) { return !r.known() || r.falls_from_the_start(); }))
    return at_im;
  // Curves in which nothing ever happened.
  if (std::ranges::all_of(readings, [](const Reading& r) { return r.never_exceeds(); })) return at_im;
  const AtEqualProbability value(readings, weights, &Probability::value, &Probability::value),
      lower(readings, weights, &Probability::lower, &Probability::upper),
      upper(readings, weights, &Probability::upper, &Probability::lower);
  const bool outside = std::ranges::any_of(weights, is_negative);
  if (!value.rises()) return {at_im.value, 0, 1, at_im.resolution};
  Probability p{value(im), lower(im), upper(im), at_im.resolution};
  if (p.value == value.most()) {
    p.none_tells = std::ranges::any_of(here, [&](const Probability& one) { return one.value > value.most(); });
    double sum = 0;
    for (std::size_t i = 0; i < here.size(); ++i) {
      sum += weights[i] * gsl_cdf_ugaussian_Pinv(drawn_in(here[i].value, here[i].resolution));
      p.upper = outside ? 1 : std::max(p.upper, here[i].upper);
    }
    if (!outside) p.value = std::max(p.value, gsl_cdf_ugaussian_P(sum));
  }
  p.lower = std::min(p.lower, p.value);
  p.upper = std::max(p.upper, p.value);
  return p;
}

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

Probability at(const Curve& curve, double im) { return Reading(curve)(im); }

bool by_lognormal(const Curve& curve) { return curve.family == lognormal_family && curve.dispersion > 0; }

bool outside(const Curve& curve, double im) { return im < curve.im_least || im > curve.im_most; }

}  // namespace freestand::database
