#include "fragility/clusters.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/random.hpp"
#include "fragility/normal.hpp"
#include "fragility/threshold_fit.hpp"

namespace freestand::fragility {
namespace {

// The time goes with it. Of 256 samples S differs from its limit, scaled, by 0.85/256 or 0.3 % (Stephens's correction, goodness.hpp): less
// than the error of a 500th in p moves it.
constexpr int most_drawn = 256;
constexpr double far = 8;  // standard deviations; one normal number in 10^15 lies further out

// One stream of uniforms and normals.
class Draws {
 public:
  Draws(std::uint64_t seed, std::uint64_t repeat)
      : seed_(seed), counter_(repeat << 24), stream_(random::stable_hash("fragility/clustered_null")) {}
  double uniform() {
    if (!spare_) {
      const auto [first, second] = random::bits(seed_, counter_++, stream_);
      next_ = random::unit_interval(second);
      spare_ = true;
      return random::unit_interval(first);
    }
    spare_ = false;
    return next_;
  }
  double normal() {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(2 * pi * uniform());
  }

 private:
  std::uint64_t seed_, counter_, stream_;
  double next_ = 0;
  bool spare_ = false;
};

// By linear interpolation, which errs by h^2/8 times the second derivative: Phi by 8e-7, its inverse, exact where u is within
// 64 steps of an end, by 1e-5.
class NormalTable {
 public:
  static const NormalTable& get() {
    static const NormalTable table;
    return table;
  }
  double cdf(double x) const { return cdf_at(place(x)); }
  static double place(double x) { return (x + far) / step; }
  double cdf_at(double place) const {
    if (!(place > 0)) return 0;
    const auto i = static_cast<std::size_t>(place);
    if (i + 1 >= cdf_.size()) return 1;
    return cdf_[i] + (place - static_cast<double>(i)) * (cdf_[i + 1] - cdf_[i]);
  }
  double inverse(double u) const {
    const double place = u * parts;
    const auto i = static_cast<std::size_t>(place);
    constexpr std::size_t edge = 64;
    if (i < edge || i + edge >= inverse_.size()) return gsl_cdf_ugaussian_Pinv(u);
    return inverse_[i] + (place - static_cast<double>(i)) * (inverse_[i + 1] - inverse_[i]);
  }

 private:
  static constexpr double step = 0.005;
  static constexpr int parts = 8192;
  NormalTable() {
    for (double x = -far; x <= far; x += step) cdf_.push_back(normal_cdf(x));
    for (int i = 0; i <= parts; ++i)
      inverse_.push_back(gsl_cdf_ugaussian_Pinv(std::clamp(i / static_cast<double>(parts), 1e-9, 1 - 1e-9)));
  }
  std::vector<double> cdf_, inverse_;
};

// The distribution of z > cut: moments of order 0 to 2 over z > cut, and the empirical one at points.
struct Simulated {
  double mass = 0, first = 0, second = 0;
  std::vector<double> x, lower, upper;  // P(z <= x) just below each point and at it, increasing
};

double statistic(const Simulated& s, double cut) {
  const double c = std::max(cut, -far);
  const double mean = s.first / s.mass, square = s.second / s.mass;
  const bool whole = cut <= -far;
  const TruncatedNormal fit = whole ? TruncatedNormal{mean, std::sqrt(square - mean * mean)}
                                    : fit_truncated(c, mean - c, square - 2 * c * mean + c * c);
  const double at_cut = whole ? 0 : normal_cdf((c - fit.mean) / fit.deviation), offset = 1 - s.mass;
  double largest = 0;
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    if (s.x[i] <= cut) continue;
    const double fitted = (NormalTable::get().cdf((s.x[i] - fit.mean) / fit.deviation) - at_cut) / (1 - at_cut);
    largest = std::max({largest, (s.upper[i] - offset) / s.mass - fitted, fitted - (s.lower[i] - offset) / s.mass});
  }
  return largest;
}

// One by one; those below the cut are drawn again.
Simulated drawn(const Clustering& c, double cut, Draws& draws) {
  Simulated s;
  const double root = std::sqrt(c.correlation), rest = std::sqrt(1 - c.correlation);
  const auto draw = [&](double size, bool shared) {
    const double effect = shared ? root * draws.normal() : 0, scale = shared ? rest : 1;
    for (int i = 0; i < static_cast<int>(size); ++i) {
      double z = effect + scale * draws.normal();
      for (int again = 0; z <= cut && again < 100; ++again) z = effect + scale * draws.normal();
      s.x.push_back(std::max(z, cut + 1e-12));
    }
  };
  for (const double size : c.sizes) draw(size, true);
  draw(c.single, false);
  std::sort(s.x.begin(), s.x.end());
  const double n = static_cast<double>(s.x.size());
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    s.lower.push_back(static_cast<double>(i) / n);
    s.upper.push_back(static_cast<double>(i + 1) / n);
    s.first += s.x[i] / n;
    s.second += s.x[i] * s.x[i] / n;
  }
  s.mass = 1;
  return s;
}

// The mixture of the groups about the normal distribution.
class Mixture {
 public:
  Mixture(const Clustering& c, Draws& draws) : root_(std::sqrt(c.correlation)), rest_(std::sqrt(1 - c.correlation)) {
    double squares = c.single;
    const double n = c.n();
    for (const double size : c.sizes) {
      squares += size * size;
      weight_.push_back(size / n);
      effect_.push_back(root_ * draws.normal());
    }
    // What samples scatter within their groups is drawn with the independent ones: it may not count twice.
    shrink_ = std::sqrt(std::max(0.0, 1 - n / squares));
    single_ = c.single / n;
    const std::vector<double> mixed = at_points();
    for (std::size_t i = 0; i < points; ++i) difference_.push_back(shrink_ * (mixed[i] - normal_cdf(x_of(i))));
  }
  double difference(double x) const {
    const double place = std::clamp((x + width) / step, 0.0, points - 1.001);
    const auto i = static_cast<std::size_t>(place);
    return difference_[i] + (place - static_cast<double>(i)) * (difference_[i + 1] - difference_[i]);
  }
  // Added to the normal distribution's moments of order 1 and 2 over z > c.
  double first(double c) const { return shrink_ * (sum(&Mixture::first_of, c) - normal_density(c)); }
  double second(double c) const {
    return shrink_ * (sum(&Mixture::second_of, c) - (normal_cdf(-c) + c * normal_density(c)));
  }

 private:
  // Between its points a component of deviation d errs by at most 0.24 (step/d)^2/8 of its weight: by 0.3 % at a correlation
  // of 0.9, where d = 0.3, and less below; by 20 % at the largest one, 0.999, where d = 0.03: of 40 groups 0.005 in an S of 0.14, a
  // thirtieth of it. Beyond +-5 lie 6e-7 of the distribution.
  static constexpr double width = 5, step = 0.1;
  static constexpr std::size_t points = 101;
  static double x_of(std::size_t i) { return -width + step * static_cast<double>(i); }

  // Group by group, so that the divisions of all points are made side by side: most of the time is theirs.
  std::vector<double> at_points() const {
    const NormalTable& table = NormalTable::get();
    std::array<double, points> x, place;
    std::vector<double> sum;
    for (std::size_t i = 0; i < points; ++i) {
      x[i] = x_of(i);
      sum.push_back(single_ * table.cdf(x[i]));
    }
    for (std::size_t g = 0; g < weight_.size(); ++g) {
      for (std::size_t i = 0; i < points; ++i) place[i] = NormalTable::place((x[i] - effect_[g]) / rest_);
      for (std::size_t i = 0; i < points; ++i) sum[i] += weight_[g] * table.cdf_at(place[i]);
    }
    return sum;
  }
  double sum(double (*moment)(double, double, double), double c) const {
    double total = single_ * moment(0, 1, c);
    for (std::size_t g = 0; g < weight_.size(); ++g) total += weight_[g] * moment(effect_[g], rest_, c);
    return total;
  }
  // Of N(mean, deviation^2) over z > c.
  static double first_of(double mean, double deviation, double c) {
    const double t = (c - mean) / deviation;
    return mean * normal_cdf(-t) + deviation * normal_density(t);
  }
  static double second_of(double mean, double deviation, double c) {
    const double t = (c - mean) / deviation;
    return (mean * mean + deviation * deviation) * normal_cdf(-t) + deviation * (mean + c) * normal_density(t);
  }

  double root_, rest_, shrink_ = 0, single_ = 0;
  std::vector<double> weight_, effect_, difference_;
};

Simulated of_many(const Clustering& c, double cut, Draws& draws) {
  const Mixture mixture(c, draws);
  const double low = std::max(cut, -far), n = c.n(), shrink = std::sqrt(most_drawn / n);
  Simulated s;
  // Sorted uniforms as the sums of exponential gaps.
  std::vector<double> u(most_drawn + 1);
  double total = 0;
  for (double& x : u) x = total -= std::log(draws.uniform());
  double mass = 0, first = 0, second = 0;
  for (int i = 0; i < most_drawn; ++i) {
    const double p = u[static_cast<std::size_t>(i)] / total, x = NormalTable::get().inverse(p);
    const double centre = p + mixture.difference(x);
    s.x.push_back(x);
    s.lower.push_back(centre + shrink * (i / static_cast<double>(most_drawn) - p));
    s.upper.push_back(centre + shrink * ((i + 1) / static_cast<double>(most_drawn) - p));
    if (x <= low) continue;
    mass += 1.0 / most_drawn;
    first += x / most_drawn;
    second += x * x / most_drawn;
  }
  s.mass = normal_cdf(-low) - mixture.difference(low) * (cut > -far) + shrink * (mass - normal_cdf(-low));
  s.first = normal_density(low) + mixture.first(low) + shrink * (first - normal_density(low));
  const double square = normal_cdf(-low) + low * normal_density(low);
  s.second = square + mixture.second(low) + shrink * (second - square);
  return s;
}

}  // namespace

double Clustering::n() const { return std::accumulate(sizes.begin(), sizes.end(), single); }

Clustering clustering(std::span<const GroupMoments> groups, std::size_t record_groups) {
  Clustering c;
  double n = 0, sum = 0, squares = 0, within = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const GroupMoments& m = groups[g];
    if (g >= record_groups) c.single += m.n;
    if (g >= record_groups || !(m.n > 0)) continue;
    c.sizes.push_back(m.n);
    n += m.n;
    sum += m.sum;
    squares += m.n * m.n;
    within += m.sum2 - m.sum * m.sum / m.n;
  }
  const double count = static_cast<double>(c.sizes.size());
  if (count < 2 || n <= count) return c;
  double between_groups = 0;
  for (std::size_t g = 0; g < std::min(record_groups, groups.size()); ++g)
    if (groups[g].n > 0) between_groups += groups[g].n * std::pow(groups[g].sum / groups[g].n - sum / n, 2);
  const double usual = (n - squares / n) / (count - 1);
  const double b = between_groups / (count - 1), w = std::max(within, 0.0) / (n - count);
  c.correlation = std::clamp((b - w) / (b + (usual - 1) * w), 0.0, 0.999);
  return c;
}

std::vector<double> clustered_null(const Clustering& c, double below, std::uint64_t seed, int repeats) {
  const double cut = below > 0 ? std::max(gsl_cdf_ugaussian_Pinv(below), -far) : -far;
  std::vector<double> null;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    Draws draws(seed, static_cast<std::uint64_t>(repeat));
    const double s = statistic(c.n() <= most_drawn ? drawn(c, cut, draws) : of_many(c, cut, draws), cut);
    if (std::isfinite(s)) null.push_back(s);
  }
  std::sort(null.begin(), null.end());
  return null;
}

double null_p(const std::vector<double>& null, double s) {
  const auto above = null.end() - std::lower_bound(null.begin(), null.end(), s);
  return (1 + static_cast<double>(above)) / (1 + static_cast<double>(null.size()));
}

}  // namespace freestand::fragility
