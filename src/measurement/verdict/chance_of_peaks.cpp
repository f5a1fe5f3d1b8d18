#include "measurement/verdict/chance_of_peaks.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <numeric>

#include "base/random.hpp"

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

  // Derivatives in a model's numbers, as an orthonormal basis of what they can make. Peaks jump where a slip more or less is the largest:
  // differences over a hundredth of the range see the slope beside such jumps.
  MatrixXd made_by(const ModelFit& fit) const {
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
    return basis(slopes);
  }
  Index count() const { return std::accumulate(peaks_.begin(), peaks_.end(), Index{0}); }

  // How peaks stray from a model where they are off by these.
  struct Straying {
    VectorXd off;
    TellingTests telling;
    double together = 1;  // share of the variance that the peaks of one test have in common
  };
  Straying straying(const VectorXd& off) const {
    Straying s{.off = off, .telling = {}};
    double square = 0, within = 0, peaks = 0, pairs = 0;
    for_each_test([&](std::size_t, Index at, Index all) {
      const VectorXd of_test = off.segment(at, all);
      s.telling.add({of_test.data(), static_cast<std::size_t>(all)});
      const auto n = static_cast<double>((of_test.array() != 0).count());
      const double mean = n > 0 ? of_test.sum() / n : 0;
      peaks += n, square += static_cast<double>(all) * of_test.squaredNorm();
      if (n < 2) return;
      pairs += n - 1;
      within += static_cast<double>(all) * (of_test.squaredNorm() - n * mean * mean);
    });
    if (pairs > 0 && square > 0) s.together = std::clamp(1 - within / pairs / (square / peaks), 0.0, 1.0);
    return s;
  }

  // One normal deviate a test, and one a peak.
  VectorXd noise(std::uint64_t s, const Straying& how) const {
    VectorXd e = VectorXd::Zero(count());
    const double common = std::sqrt(how.together), own = std::sqrt(1 - how.together);
    for_each_test([&](std::size_t t, Index at, Index all) {
      const double of_test = random::standard_normal(23, s, t);
      for (Index k = at; k < at + all; ++k)
        if (how.off[k] != 0)
          e[k] =
              (common * of_test + (own > 0 ? own * random::standard_normal(24, s, static_cast<std::uint64_t>(k)) : 0)) /
              std::sqrt(static_cast<double>(all));
    });
    return e;
  }

 private:
  // use(test, place of its first peak, its peaks).
  template <class Use>
  void for_each_test(Use&& use) const {
    Index at = 0;
    for (std::size_t t = 0; t < peaks_.size(); at += peaks_[t++]) use(t, at, peaks_[t]);
  }
  static MatrixXd basis(const MatrixXd& columns) {
    if (columns.cols() == 0) return columns;
    const Eigen::ColPivHouseholderQR<MatrixXd> solved(columns);
    return MatrixXd(solved.householderQ() * MatrixXd::Identity(columns.rows(), columns.cols())).leftCols(solved.rank());
  }

  const Bench& bench_;
  const Jobs& jobs_;
  std::vector<std::size_t> tests_;
  std::vector<Index> peaks_;  // how many each of them tells
};

VectorXd beyond(const MatrixXd& basis, const VectorXd& y) { return y - basis * (basis.transpose() * y); }

}  // namespace

Chance chance_of_gain_of_peaks(const Bench& bench, const ModelFit& base, const std::vector<const ModelFit*>& tried,
                               const Jobs& jobs) {
  const Ratios ratios(bench, jobs);
  std::vector<Tried> points = at_strengths(base, tried);
  points.insert(points.begin(), {&base.model, base.x});
  const MatrixXd at = ratios.of(points), own = ratios.made_by(base);
  const VectorXd measured = -at.col(0);  // what a change would have to make
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
  Chance chance{.question = help_question, .about = {}, .observed = largest_share(measured)};
  const auto how = ratios.straying(measured);
  weigh(chance, [&](std::uint64_t s) { return largest_share(ratios.noise(s, how)); });
  return chance;
}

Chance chance_of_lead_of_peaks(const Bench& bench, const ModelFit& best, const ModelFit& rival, const Jobs& jobs) {
  const Ratios ratios(bench, jobs);
  const MatrixXd at = ratios.of({{&best.model, best.x}, {&rival.model, rival.x}});
  const MatrixXd of_best = ratios.made_by(best), of_rival = ratios.made_by(rival);
  const VectorXd apart = at.col(1) - at.col(0);  // rival less best
  // y: ln of the peaks, over those of the best as fitted.
  const auto lead = [&](const VectorXd& y) {
    const double a = beyond(of_best, y).squaredNorm(), b = beyond(of_rival, y - apart).squaredNorm();
    return b > 0 ? 1 - a / b : 0;
  };
  const auto scatter = [](const MatrixXd& numbers, const Ratios::Straying& how) {
    const double n = how.telling.count(), freedom = std::max(n - static_cast<double>(numbers.cols()), 1.0);
    return n > 0 ? std::sqrt(beyond(numbers, how.off).squaredNorm() / (freedom * how.telling.shares / n)) : 0;
  };
  const auto from_best = ratios.straying(at.col(0)), from_rival = ratios.straying(at.col(1));
  const double of_best_itself = scatter(of_best, from_best), of_rival_itself = scatter(of_rival, from_rival);
  Chance chance{.question = lead_question, .about = {}, .observed = lead(-at.col(0))};
  weigh(chance, [&](std::uint64_t s) { return lead(apart + of_rival_itself * ratios.noise(s, from_rival)); });
  weigh_power(chance, [&](std::uint64_t s) { return lead(of_best_itself * ratios.noise(s, from_best)); });
  if (chance.observed <= 0) chance.p = 1;  // no lead
  return chance;
}

}  // namespace freestand::measurement
