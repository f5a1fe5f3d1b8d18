#include "fragility/probit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.hpp"
#include "fragility/normal.hpp"

namespace freestand::fragility {
namespace {

// Logarithms of Phi(eta) and 1 - Phi(eta), and phi/Phi and phi/(1 - Phi), also far out where the tails vanish.
struct Tails {
  double log_lower, log_upper, rise, fall;
};

Tails tails(double eta) {
  const double x = std::fabs(eta);
  const double density = normal_density(x), small = normal_cdf(-x);
  const bool far = x > 30;
  const double log_small =
      far ? -x * x / 2 - std::log(x * std::sqrt(2 * pi)) + std::log1p(-1 / (x * x)) : std::log(small);
  const double steep = normal_hazard(x);
  const double log_large = std::log1p(-small), other = density / (1 - small);
  return eta < 0 ? Tails{log_small, log_large, steep, other} : Tails{log_large, log_small, other, steep};
}

// A point as the likelihood sees it.
struct Trial {
  double log_im, n, hits;
};

struct Probit {
  std::vector<Trial> trials;
  bool penalised;

  // Log likelihood (with half the log determinant of the information if penalised), its gradient, and the information.
  struct Value {
    double objective = 0;
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  };

  Value at(const Eigen::Vector2d& line) const {
    Value value;
    for (const auto& [log_im, n, hits] : trials) {
      const Eigen::Vector2d x(1, log_im);
      const Tails t = tails(line.dot(x));
      value.objective += hits * t.log_lower + (n - hits) * t.log_upper;
      value.gradient += (hits * t.rise - (n - hits) * t.fall) * x;
      value.information += n * t.rise * t.fall * x * x.transpose();
    }
    if (penalised) add_penalty(line, value);
    return value;
  }

  void add_penalty(const Eigen::Vector2d& line, Value& value) const {
    value.objective += 0.5 * std::log(value.information.determinant());
    const Eigen::Matrix2d inverse = value.information.inverse();
    for (const auto& [log_im, n, hits] : trials) {
      const Eigen::Vector2d x(1, log_im);
      const double eta = line.dot(x);
      const Tails t = tails(eta);
      const double slope = t.rise * t.fall * (-2 * eta - t.rise + t.fall);  // d(weight)/d(eta)
      value.gradient += 0.5 * n * slope * x.dot(inverse * x) * x;
    }
  }
};

// Fisher scoring with step halving. The last step is the first that would raise the objective by less than `enough`, so
// that the line is known to much better than sqrt(enough) standard errors; or by less than the objective's own rounding,
// beneath which no comparison of two values means anything.
constexpr double enough = 1e-12, rounding = 1e-15;

Eigen::Vector2d maximise(const Probit& probit, Eigen::Vector2d line) {
  Probit::Value value = probit.at(line);
  for (int iteration = 0; iteration < 200; ++iteration) {
    Eigen::Vector2d step = value.information.ldlt().solve(value.gradient);
    const double gain = step.dot(value.gradient);
    if (gain < std::max(enough, rounding * std::fabs(value.objective))) return line + step;
    Probit::Value next = probit.at(line + step);
    for (int halving = 0; halving < 40 && !(next.objective >= value.objective); ++halving) {
      step /= 2;
      next = probit.at(line + step);
    }
    if (!(next.objective >= value.objective)) break;
    line += step;
    value = next;
  }
  return line;
}

struct Range {
  double least = std::numeric_limits<double>::infinity(), most = -std::numeric_limits<double>::infinity();
  void include(double im) {
    least = std::min(least, im);
    most = std::max(most, im);
  }
};

}  // namespace

ProbitFit fit_probit(const std::vector<ProbitPoint>& points, const ProbitFit& start) {
  ProbitFit fit;
  Range missed, hit, all;
  for (const auto& point : points) {
    if (!(point.n > 0)) continue;
    all.include(point.im);
    if (point.hits > 0) hit.include(point.im);
    if (point.hits < point.n) missed.include(point.im);
  }
  if (!(hit.least <= hit.most) || !(missed.least <= missed.most) || all.least == all.most) return fit;
  fit.penalised = hit.least >= missed.most || missed.least >= hit.most;
  Probit probit{{}, fit.penalised};
  for (const auto& point : points)
    if (point.n > 0) probit.trials.push_back({std::log(point.im), point.n, point.hits});
  const bool started = std::isfinite(start.a) && std::isfinite(start.b) && !fit.penalised;
  const Eigen::Vector2d line = maximise(probit, started ? Eigen::Vector2d(start.a, start.b) : Eigen::Vector2d::Zero());
  fit.a = line(0);
  fit.b = line(1);
  if (!(fit.b > 0)) return fit;
  fit.median = std::exp(-fit.a / fit.b);
  fit.dispersion = 1 / fit.b;
  return fit;
}

double probit_probability(const ProbitFit& fit, double im) {
  if (!(im > 0)) return std::isnan(fit.a) ? unknown : 0;
  return normal_cdf(fit.a + fit.b * std::log(im));
}

}  // namespace freestand::fragility
