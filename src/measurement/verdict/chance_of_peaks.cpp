#include "measurement/verdict/chance_of_peaks.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <numeric>

#include "base/random.hpp"
#include "base/units.hpp"

namespace freestand::measurement {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// ln ratios of the calibration tests, one after the other.
class Ratios {
 public:
  Ratios(const Bench& bench, const Jobs& jobs)
      : bench_(bench), jobs_(jobs), tests_(tests_of(bench.data(), Role::calibration)) {
    for (const std::size_t i : tests_) peaks_.push_back(static_cast<Index>(ln_ratios(bench, i, Prediction{}).size()));
  }

  // A column for each point.
  MatrixXd of(const std::vector<Tried>& points) const {
    const auto answers = jobs_("peaks", points.size(), [&](std::size_t k) {
      Values all;
      for (const std::size_t i : tests_) {
        const auto ratios = ln_ratios(bench_, i, predict(*points[k].model, bench_.test(i), points[k].x));
        all.insert(all.end(), ratios.begin(), ratios.end());
      }
      return all;
    });
    MatrixXd columns(static_cast<Index>(answers.empty() ? 0 : answers.front().size()),
                     static_cast<Index>(points.size()));
    for (std::size_t k = 0; k < answers.size(); ++k)
      columns.col(static_cast<Index>(k)) = Eigen::Map<const VectorXd>(answers[k].data(), columns.rows());
    return columns;
  }

  // Derivatives in a model's numbers. Peaks jump where a slip more or less is the largest: differences over a hundredth of the range see
  // the slope beside such jumps.
  MatrixXd slopes(const ModelFit& fit) const {
    constexpr double step = 1e-2;
    std::vector<Tried> points;
    for (std::size_t k = 0; k < fit.x.size(); ++k)
      for (const double to : {-step, step}) {
        points.push_back({&fit.model, fit.x});
        points.back().x[k] = from_unit(fit.model.free[k], to_unit(fit.model.free[k], fit.x[k]) + to);
      }
    const MatrixXd at = of(points);
    MatrixXd slopes(count(), static_cast<Index>(fit.x.size()));
    for (Index k = 0; k < slopes.cols(); ++k) slopes.col(k) = (at.col(2 * k + 1) - at.col(2 * k)) / (2 * step);
    return slopes;
  }

  PeakScatter scatter_about(const ModelFit& fit) const {
    ModelSpec model = fit.model;
    model.friction_factor = {.free = static_cast<int>(fit.x.size())};
    std::vector<Tried> points;
    for (const double shift : PeakScatter::shifts()) {
      points.push_back({&model, fit.x});
      points.back().x.push_back(std::exp(shift));
    }
    const MatrixXd at = of(points);
    const VectorXd as_fitted = at.col(at.cols() / 2);
    return {-as_fitted, at.colwise() - as_fitted, peaks_, fit.x.size()};
  }
  // The fit moved to the least squares in units of the scatter about it, by Gauss and Newton's steps of at most a quarter of the box. A
  // friction that was fitted as if all tests scattered alike lies elsewhere, and its own squares would look like an effect.
  ModelFit moved(ModelFit fit) const {
    constexpr int steps = 3;
    for (int step = 0; step < steps && !fit.x.empty(); ++step) {
      const PeakScatter scatter = scatter_about(fit);
      const VectorXd off = scatter.weighed(of({{&fit.model, fit.x}}));
      const VectorXd by = scatter.weighed(slopes(fit)).colPivHouseholderQr().solve(-off);
      Values x = fit.x;
      for (std::size_t k = 0; k < x.size(); ++k) {
        const Free& free = fit.model.free[k];
        x[k] = from_unit(free, to_unit(free, x[k]) + std::clamp(by[static_cast<Index>(k)], -0.25, 0.25));
      }
      if (scatter.weighed(of({{&fit.model, x}})).norm() >= off.norm()) break;
      fit.x = x;
    }
    return fit;
  }
  Index count() const { return std::accumulate(peaks_.begin(), peaks_.end(), Index{0}); }

 private:
  const Bench& bench_;
  const Jobs& jobs_;
  std::vector<std::size_t> tests_;
  std::vector<Index> peaks_;  // how many each of them tells
};

// An orthonormal basis of what columns can make, and what of y is beyond it.
MatrixXd basis(const MatrixXd& columns) {
  if (columns.cols() == 0) return columns;
  const Eigen::ColPivHouseholderQR<MatrixXd> solved(columns);
  return MatrixXd(solved.householderQ() * MatrixXd::Identity(columns.rows(), columns.cols())).leftCols(solved.rank());
}
VectorXd beyond(const MatrixXd& basis, const VectorXd& y) { return y - basis * (basis.transpose() * y); }

// The peaks of a test, as if a model had foretold them.
Prediction as_measured(const Test& test) {
  const Peaks& p = test.peaks;
  Prediction measured;
  measured.response.outcome = fell(test) ? Outcome::overturned : Outcome::moved;
  measured.response.peak_slip_m = p.peak_slip_m.value_or(0);
  measured.response.residual_slip_m = p.residual_slip_m.value_or(0);
  measured.response.peak_rotation_rad = p.peak_rotation_rad.value_or(0);
  measured.response.peak_acceleration_mps2 = p.peak_acceleration_g.value_or(0) * standard_gravity_mps2;
  return measured;
}

}  // namespace

PeakScatter scatter_of_peaks(const Bench& bench, const ModelFit& fit, const Jobs& jobs) {
  const Ratios ratios(bench, jobs);
  return ratios.scatter_about(ratios.moved(fit));
}

Chance chance_of_gain_of_peaks(const Bench& bench, const ModelFit& fitted, const std::vector<const ModelFit*>& tried,
                               const Jobs& jobs) {
  const Ratios ratios(bench, jobs);
  const ModelFit base = ratios.moved(fitted);
  const PeakScatter scatter = ratios.scatter_about(base);
  std::vector<Tried> points = at_strengths(base, tried);
  points.insert(points.begin(), {&base.model, base.x});
  const MatrixXd at = scatter.weighed(ratios.of(points)), own = basis(scatter.weighed(ratios.slopes(base)));
  std::vector<VectorXd> directions;
  for (Index k = 1; k < at.cols(); ++k) {
    const VectorXd change = at.col(k) - at.col(0), left = beyond(own, change);
    if (left.norm() > 1e-3 * change.norm() && left.norm() > 0) directions.push_back(left.normalized());
  }
  const auto largest_share = [&](const VectorXd& y) {
    const VectorXd left = beyond(own, y);
    double most = 0;
    for (const VectorXd& d : directions) most = std::max(most, d.dot(left));
    return left.squaredNorm() > 0 ? most * most / left.squaredNorm() : 0;
  };
  // What a change would have to make.
  Chance chance{.question = help_question, .about = {}, .observed = largest_share(-at.col(0))};
  if (scatter.as_read()) return chance;
  weigh(chance, [&](std::uint64_t s) { return largest_share(scatter.weighed(scatter.draw(s))); });
  return chance;
}

// y, logarithms of peaks over those of the best as fitted, in units of how they scatter about the rival.
Chance chance_of_lead_of_peaks(const Bench& bench, const ModelFit& leader, const ModelFit& other, const Jobs& jobs) {
  const Ratios ratios(bench, jobs);
  const ModelFit best = ratios.moved(leader), rival = ratios.moved(other);
  const PeakScatter about_best = ratios.scatter_about(best), about_rival = ratios.scatter_about(rival);
  const MatrixXd at = about_rival.weighed(ratios.of({{&best.model, best.x}, {&rival.model, rival.x}}));
  const MatrixXd of_best = basis(about_rival.weighed(ratios.slopes(best))),
                 of_rival = basis(about_rival.weighed(ratios.slopes(rival)));
  const VectorXd apart = at.col(1) - at.col(0);  // rival less best
  const auto lead = [&](const VectorXd& y) {
    const double a = beyond(of_best, y).squaredNorm(), b = beyond(of_rival, y - apart).squaredNorm();
    return b > 0 ? 1 - a / b : 0;
  };
  Chance chance{.question = lead_question, .about = {}, .observed = lead(-at.col(0))};
  weigh(chance, [&](std::uint64_t s) { return lead(apart + about_rival.weighed(about_rival.draw(s))); });
  weigh_power(chance, [&](std::uint64_t s) { return lead(about_rival.weighed(about_best.draw(s))); });
  if (chance.observed <= 0) chance.p = 1;  // no lead
  return chance;
}

std::vector<TestError> errors_of_another_test(const Bench& bench) {
  const std::vector<std::size_t> tests = tests_of(bench.data(), Role::calibration);
  std::vector<TestError> errors(tests.size());
  for (std::size_t i = 0; i < tests.size(); ++i)
    for (const std::size_t other : tests)
      if (other != tests[i])
        errors[i].score +=
            test_error(bench, tests[i], as_measured(bench.test(other))).score / static_cast<double>(tests.size() - 1);
  return errors;
}

Chance chance_of_misfit_of_peaks(const Bench& bench, const ModelFit& fit) {
  const std::vector<TestError>& of_model = fit.left_out_refitted ? fit.left_out : fit.calibration;
  const std::vector<TestError> of_another = errors_of_another_test(bench);
  VectorXd more(static_cast<Index>(of_another.size()));
  for (std::size_t i = 0; i < of_another.size(); ++i)
    more[static_cast<Index>(i)] = of_model[i].score - 2 * of_another[i].score;
  Chance chance{.question = misfit_question, .about = {}, .observed = more.mean()};
  weigh(chance, [&](std::uint64_t s) {
    VectorXd turned = more;
    for (Index t = 0; t < turned.size(); ++t)
      if (random::bits(31, s, static_cast<std::uint64_t>(t)).first & 1) turned[t] = -turned[t];
    return turned.mean();
  });
  return chance;
}

}  // namespace freestand::measurement
