#include "measurement/fit/importance.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/random.hpp"
#include "base/units.hpp"

namespace freestand::measurement {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t draw_count =
    500;  // a share of the sweep is known no better than to 1/sqrt of them by the tests' numbers
constexpr double proposed_freedom = 5;  // tails that are heavier than those of the answer, and a variance
constexpr double enough = 0.3;          // of the points count
constexpr int most_proposals = 12;

// Points about a middle, and the density from which they come.
struct Proposal {
  VectorXd middle;
  MatrixXd root;  // of the covariance

  // One in ten comes from anywhere in the cube: the tests may allow what is far from the fit.
  static constexpr std::uint64_t one_anywhere = 10;

  VectorXd draw(std::uint64_t round, std::uint64_t s) const {
    if (s % one_anywhere == 0)
      return VectorXd::NullaryExpr(
          middle.size(), [&](Index k) { return random::uniform(80 + round, s, static_cast<std::uint64_t>(k)); });
    const auto normal = [&](std::uint64_t i) { return random::standard_normal(40 + round, s, i); };
    VectorXd z(middle.size());
    double chi2 = 0;
    for (Index k = 0; k < z.size(); ++k) z[k] = normal(static_cast<std::uint64_t>(k));
    for (int k = 0; k < proposed_freedom; ++k) chi2 += std::pow(normal(1000 + static_cast<std::uint64_t>(k)), 2);
    return middle + root * z * std::sqrt(proposed_freedom / chi2);
  }
  double distance2(const VectorXd& z) const {
    return root.triangularView<Eigen::Lower>().solve(z - middle).squaredNorm();
  }
  // ln.
  double density(const VectorXd& z) const {
    const double p = static_cast<double>(z.size()), d2 = distance2(z);
    const double at_middle = std::lgamma(0.5 * (proposed_freedom + p)) - std::lgamma(0.5 * proposed_freedom) -
                             0.5 * p * std::log(proposed_freedom * pi) - root.diagonal().array().log().sum();
    const double about = std::exp(at_middle - 0.5 * (proposed_freedom + p) * std::log1p(d2 / proposed_freedom));
    const bool inside = (z.array() >= 0).all() && (z.array() <= 1).all();
    return std::log((1 - 1.0 / one_anywhere) * about + (inside ? 1.0 / one_anywhere : 0.0) + 1e-300);
  }
};

MatrixXd root_of(const MatrixXd& covariance) {
  const MatrixXd kept = covariance + 1e-14 * MatrixXd::Identity(covariance.rows(), covariance.cols());
  return kept.llt().matrixL();
}

VectorXd to_cube(const ModelSpec& model, const Values& x) {
  VectorXd z(static_cast<Index>(x.size()));
  for (std::size_t k = 0; k < x.size(); ++k) z[static_cast<Index>(k)] = to_unit(model.free[k], x[k]);
  return z;
}

// Empty where the point lies beyond the bounds of a number.
Values from_cube(const ModelSpec& model, const VectorXd& z) {
  Values x;
  for (Index k = 0; k < z.size(); ++k) {
    const Free& free = model.free[static_cast<std::size_t>(k)];
    x.push_back(from_unit(free, z[k]));
    if (std::abs(to_unit(free, x.back()) - z[k]) > 1e-9) return {};
  }
  return x;
}

class Sampler {
 public:
  Sampler(const ModelFit& fit, Proposal proposal, const Misfits& misfits, Posterior& out)
      : fit_(fit), first_(std::move(proposal)), proposal_(first_), misfits_(misfits), out_(out) {
    of_fit_ = least_ = misfits({fit.x}).front();
  }

  void run() {
    for (std::uint64_t round = 0;; ++round) {
      propose(round);
      weigh_points(1);
      if (round + 1 == most_proposals || (out_.counted >= enough && contained())) break;
      learn();
    }
    if (!temper()) take_linear();
    resample();
    if (of_fit_ - least_ > told_lead * square(out_.dispersion)) out_.better = best_;
  }

 private:
  static double square(double x) { return x * x; }

  void draw(std::uint64_t round) {
    z_.clear();
    points_.clear();
    for (std::uint64_t s = 0; s < draw_count; ++s) {
      z_.push_back(proposal_.draw(round, s));
      points_.push_back(from_cube(fit_.model, z_.back()));
    }
  }

  void propose(std::uint64_t round) {
    draw(round);
    G_ = misfits_(points_);
    const auto least = std::min_element(G_.begin(), G_.end());
    if (*least < least_) least_ = *least, best_ = points_[static_cast<std::size_t>(least - G_.begin())];
  }

  // widened: by so much is s^2 taken larger than it is.
  void weigh_points(double widened) {
    const double s2 = widened * square(out_.dispersion);
    weigh([&](std::size_t s) { return (G_[s] - least_) / s2; });
  }

  // By Student's density of the rise of G over s^2 at each point, over the density from which the point was drawn.
  template <class Rise>
  void weigh(const Rise& rise_at) {
    const double nu = out_.freedom, p = static_cast<double>(fit_.x.size());
    std::vector<double> ln;
    for (std::size_t s = 0; s < draw_count; ++s) {
      const double rise = rise_at(s);
      ln.push_back((nu > 0 ? -0.5 * (nu + p) * std::log1p(rise / nu) : -0.5 * rise) - proposal_.density(z_[s]));
      if (points_[s].empty()) ln.back() = -std::numeric_limits<double>::infinity();
    }
    const double top = *std::max_element(ln.begin(), ln.end());
    weight_.clear();
    for (const double l : ln) weight_.push_back(std::isfinite(top) ? std::exp(l - top) : 1.0);
    sum_ = std::accumulate(weight_.begin(), weight_.end(), 0.0);
    out_.counted = sum_ * sum_ / std::inner_product(weight_.begin(), weight_.end(), weight_.begin(), 0.0) / draw_count;
  }

  void moments(VectorXd& middle, MatrixXd& spread) const {
    middle = VectorXd::Zero(proposal_.middle.size());
    for (std::size_t s = 0; s < draw_count; ++s) middle += weight_[s] / sum_ * z_[s];
    spread = MatrixXd::Zero(middle.size(), middle.size());
    for (std::size_t s = 0; s < draw_count; ++s)
      spread += weight_[s] / sum_ * (z_[s] - middle) * (z_[s] - middle).transpose();
  }

  // The weighted points scatter no wider than those proposed do: else they come from a slope of something wider, as where friction is so
  // high that nothing slips and more of it changes nothing.
  bool contained() const {
    VectorXd middle;
    MatrixXd spread;
    moments(middle, spread);
    const MatrixXd inverse =
        proposal_.root.triangularView<Eigen::Lower>().solve(MatrixXd::Identity(spread.rows(), spread.cols()).eval());
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solved(inverse * spread * inverse.transpose());
    // As wide as the answer's own tails are, which have a variance from nu = 2 on, and a third more for chance.
    const double own = out_.freedom > 0 ? out_.freedom / std::max(out_.freedom - 2, 0.5) : 1;
    return solved.eigenvalues().maxCoeff() < 4.0 / 3 * std::max(own, proposed_freedom / (proposed_freedom - 2));
  }

  void learn() {
    VectorXd middle;
    MatrixXd spread;
    moments(middle, spread);
    // Few points tell no covariance: what was proposed stays in it, as much as they fail to count.
    const double known = std::min(1.0, out_.counted * draw_count / (10 * (static_cast<double>(fit_.x.size()) + 1)));
    const MatrixXd before = proposal_.root * proposal_.root.transpose();
    proposal_ = {known * middle + (1 - known) * proposal_.middle, root_of(known * spread + (1 - known) * before)};
  }

  // Where G is so rough that single points stand out, its rises are taken to say less, until a tenth of the points count. False: of those
  // that then count most come from anywhere, one in ten of all, and tell of the cube alone.
  bool temper() {
    constexpr double least_counted = 0.1, factor = 1.5;
    double widened = 1;
    for (int k = 0; k < 60 && out_.counted < least_counted; ++k) {
      weigh_points(widened *= factor);
      if (of_anywhere() > 0.5) return false;
    }
    out_.dispersion *= std::sqrt(widened);
    return out_.counted >= least_counted;
  }

  double of_anywhere() const {
    double sum = 0;
    for (std::size_t s = 0; s < draw_count; s += Proposal::one_anywhere) sum += weight_[s];
    return sum / sum_;
  }

  // As if G had at each point what derivatives at the fit foretell.
  void take_linear() {
    proposal_ = first_;
    draw(most_proposals);
    weigh([&](std::size_t s) { return proposal_.distance2(z_[s]); });
    out_.counted = 0;
  }

  // Systematic: each point as often as its weight says, to one.
  void resample() {
    double passed = 0;
    for (std::size_t s = 0; s < draw_count; ++s) {
      passed += weight_[s] / sum_ * draw_count;
      while (static_cast<double>(out_.of_mean.size()) + 0.5 < passed && !points_[s].empty())
        out_.of_mean.push_back(points_[s]);
    }
  }

  const ModelFit& fit_;
  const Proposal first_;
  Proposal proposal_;
  const Misfits& misfits_;
  Posterior& out_;
  double of_fit_ = 0, least_ = 0, sum_ = 0;
  Values best_;
  std::vector<VectorXd> z_;
  std::vector<Values> points_;
  std::vector<double> G_, weight_;
};

}  // namespace

void draw_by_importance(const ModelFit& fit, const VectorXd& step, const MatrixXd& covariance, const Misfits& misfits,
                        Posterior& out) {
  VectorXd middle = to_cube(fit.model, fit.x) + step;
  for (Index k = 0; k < middle.size(); ++k) {
    const Free& free = fit.model.free[static_cast<std::size_t>(k)];
    middle[k] = std::clamp(middle[k], to_unit(free, free.lower), to_unit(free, free.upper));
  }
  Sampler(fit, {middle, root_of(covariance)}, misfits, out).run();
}

}  // namespace freestand::measurement
