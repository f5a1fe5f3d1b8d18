#include "fragility/overturning.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.hpp"

namespace freestand::fragility {
namespace {

double phi(double x) { return std::exp(-x * x / 2) / std::sqrt(2 * pi); }
double upper_tail(double x) { return 0.5 * std::erfc(x / std::sqrt(2.0)); }

// phi(x)/Phi(-x), also far out where both vanish.
double hazard(double x) {
  if (x < 30) return phi(x) / upper_tail(x);
  return x + 1 / x - 2 / (x * x * x);
}

double log_upper_tail(double x) {
  if (x < 30) return std::log(upper_tail(x));
  return -x * x / 2 - std::log(x * std::sqrt(2 * pi)) + std::log1p(-1 / (x * x));
}

struct Probit {
  const std::vector<OverturningPoint>& points;
  bool penalised;

  // Log likelihood (with half the log determinant of the information if penalised), its gradient, and the information.
  struct Value {
    double objective = 0;
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  };

  Value at(const Eigen::Vector2d& line) const {
    Value value;
    for (const auto& [im, n, over] : points) {
      const Eigen::Vector2d x(1, std::log(im));
      const double eta = line.dot(x), rise = hazard(-eta), fall = hazard(eta);  // phi/Phi, phi/(1 - Phi)
      if (over > 0) value.objective += over * log_upper_tail(-eta);
      if (n > over) value.objective += (n - over) * log_upper_tail(eta);
      value.gradient += (over * rise - (n - over) * fall) * x;
      value.information += n * rise * fall * x * x.transpose();
    }
    if (penalised) add_penalty(line, value);
    return value;
  }

  void add_penalty(const Eigen::Vector2d& line, Value& value) const {
    value.objective += 0.5 * std::log(value.information.determinant());
    const Eigen::Matrix2d inverse = value.information.inverse();
    for (const auto& [im, n, over] : points) {
      const Eigen::Vector2d x(1, std::log(im));
      const double eta = line.dot(x), rise = hazard(-eta), fall = hazard(eta);
      const double slope = rise * fall * (-2 * eta - rise + fall);  // d(weight)/d(eta)
      value.gradient += 0.5 * n * slope * x.dot(inverse * x) * x;
    }
  }
};

// Fisher scoring with step halving.
Eigen::Vector2d maximise(const Probit& probit, Eigen::Vector2d line) {
  Probit::Value value = probit.at(line);
  for (int iteration = 0; iteration < 200; ++iteration) {
    Eigen::Vector2d step = value.information.ldlt().solve(value.gradient);
    const double gain = step.dot(value.gradient);
    Probit::Value next = probit.at(line + step);
    for (int halving = 0; halving < 40 && !(next.objective >= value.objective); ++halving) {
      step /= 2;
      next = probit.at(line + step);
    }
    if (!(next.objective >= value.objective)) break;
    line += step;
    value = next;
    if (gain < 1e-16 * (1 + std::fabs(value.objective))) break;
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

OverturningFit fit_overturning(const std::vector<OverturningPoint>& points) {
  OverturningFit fit;
  Range stood, over, all;
  for (const auto& point : points) {
    if (!(point.n > 0)) continue;
    all.include(point.im);
    if (point.over > 0) over.include(point.im);
    if (point.over < point.n) stood.include(point.im);
  }
  if (!(over.least <= over.most) || !(stood.least <= stood.most) || all.least == all.most) return fit;
  fit.penalised = over.least >= stood.most || stood.least >= over.most;
  const Probit probit{points, fit.penalised};
  const Eigen::Vector2d line = maximise(probit, Eigen::Vector2d::Zero());
  fit.a = line(0);
  fit.b = line(1);
  if (!(fit.b > 0)) return fit;
  fit.median = std::exp(-fit.a / fit.b);
  fit.dispersion = 1 / fit.b;
  const Eigen::Matrix2d covariance = probit.at(line).information.inverse();
  const Eigen::Vector2d median_gradient = fit.median * Eigen::Vector2d(-1 / fit.b, fit.a / (fit.b * fit.b));
  fit.median_se = std::sqrt(median_gradient.dot(covariance * median_gradient));
  fit.dispersion_se = std::sqrt(covariance(1, 1)) / (fit.b * fit.b);
  return fit;
}

double overturning_probability(const OverturningFit& fit, double im) {
  if (!(im > 0)) return std::isnan(fit.a) ? unknown : 0;
  return upper_tail(-(fit.a + fit.b * std::log(im)));
}

}  // namespace freestand::fragility
