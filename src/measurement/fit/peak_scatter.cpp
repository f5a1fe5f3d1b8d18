#include "measurement/fit/peak_scatter.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/random.hpp"
#include "measurement/predict/score.hpp"
#include "measurement/search.hpp"

namespace freestand::measurement {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double largest_tau = 0.3;  // friction that differs more from test to test is not one friction
constexpr double tau_step = 0.01;    // as fine as the few tests that a laboratory has can tell
constexpr double shift_step = 0.06;  // d is linear in between
constexpr int shifts_to_a_side = 15;
static_assert(shifts_to_a_side * shift_step >= 3 * largest_tau);
constexpr double least_sigma = 1e-3;  // peaks are read no better
constexpr double most_in_common =
    0.99;  // by what peaks of a test differ would tell all, were it less than a tenth of what they share

// Nodes and weights of a standard normal number, to 2.5 to either side.
struct Node {
  double z, weight;
};
std::vector<Node> normal_nodes() {
  std::vector<Node> nodes;
  double sum = 0;
  for (int k = -10; k <= 10; ++k) {
    const double z = 0.25 * k;
    nodes.push_back({z, std::exp(-z * z / 2)});
    sum += nodes.back().weight;
  }
  for (Node& node : nodes) node.weight /= sum;
  return nodes;
}

}  // namespace

std::vector<double> PeakScatter::shifts() {
  std::vector<double> all;
  for (int k = -shifts_to_a_side; k <= shifts_to_a_side; ++k) all.push_back(shift_step * k);
  return all;
}

PeakScatter::PeakScatter(const VectorXd& y, const MatrixXd& d, std::vector<Index> peaks, std::size_t numbers)
    : y_(y), d_(d), peaks_(std::move(peaks)) {
  TellingTests telling;
  for_each_test([&](std::uint64_t, Index first, Index rows) {
    telling.add({y_.data() + first, static_cast<std::size_t>(rows)});
  });
  if (telling.count() == 0) return;
  const Own without = best_own(0);
  Own best = without;
  for (int k = 1; k * tau_step <= largest_tau + 1e-9; ++k)
    if (const Own own = best_own(k * tau_step); own.minus_2_ln_likelihood < best.minus_2_ln_likelihood)
      best = own, tau_ = k * tau_step;
  // Half of all data without tau show one, since it is not negative (S. G. Self and K.-Y. Liang, JASA 82, 1987).
  if (tau_ > 0) p_ = gsl_cdf_chisq_Q(without.minus_2_ln_likelihood - best.minus_2_ln_likelihood, 1) / 2;
  const double n = telling.count(), freedom = std::max(n - static_cast<double>(numbers), 1.0);
  rho_ = best.rho;
  as_read_ = tau_ == 0 && best.sigma < 1.01 * least_sigma;
  sigma_ = best.sigma * std::sqrt(n / freedom);
  tau_ *= std::sqrt(n / freedom);
  for_each_test([&](std::uint64_t, Index first, Index rows) {
    roots_.emplace_back(covariance(first, rows, moments_by_friction(first, rows, tau_).covariance, sigma_, rho_));
  });
}

template <class Use>
void PeakScatter::for_each_test(Use&& use) const {
  Index first = 0;
  for (std::size_t t = 0; t < peaks_.size(); first += peaks_[t++]) use(t, first, peaks_[t]);
}

bool PeakScatter::peaks_can_go_together() const {
  bool can = false;
  for_each_test(
      [&](std::uint64_t, Index first, Index rows) { can |= (y_.segment(first, rows).array() != 0).count() > 1; });
  return can;
}

VectorXd PeakScatter::by_friction(Index first, Index rows, double shift) const {
  const auto last = static_cast<double>(d_.cols() - 1);
  const double place = std::clamp(shift / shift_step + shifts_to_a_side, 0.0, last);
  const auto left = static_cast<Index>(std::min(std::floor(place), last - 1));
  const double share = place - static_cast<double>(left);
  return (1 - share) * d_.col(left).segment(first, rows) + share * d_.col(left + 1).segment(first, rows);
}

PeakScatter::Moments PeakScatter::moments_by_friction(Index first, Index rows, double tau) const {
  static const std::vector<Node> nodes = normal_nodes();
  Moments m{VectorXd::Zero(rows), MatrixXd::Zero(rows, rows)};
  if (tau == 0) return m;
  for (const Node& node : nodes) {
    const VectorXd d = by_friction(first, rows, tau * node.z);
    m.mean += node.weight * d;
    m.covariance += node.weight * d * d.transpose();
  }
  m.covariance -= m.mean * m.mean.transpose();
  return m;
}

MatrixXd PeakScatter::covariance(Index first, Index rows, const MatrixXd& by_friction, double sigma, double rho) const {
  const VectorXd scatters = (y_.segment(first, rows).array() != 0).cast<double>();
  const MatrixXd both = scatters * scatters.transpose();
  MatrixXd own = rho * both;
  own.diagonal().setOnes();
  return both.cwiseProduct(by_friction) + sigma * sigma / static_cast<double>(rows) * own;
}

PeakScatter::Own PeakScatter::best_own(double tau) const {
  std::vector<Moments> of_tests;
  for_each_test(
      [&](std::uint64_t, Index first, Index rows) { of_tests.push_back(moments_by_friction(first, rows, tau)); });
  const Objective minus_2_ln_likelihood = [&](std::span<const double> x) {
    double sum = 0;
    for_each_test([&](std::uint64_t t, Index first, Index rows) {
      std::vector<Index> told;
      for (Index k = 0; k < rows; ++k)
        if (y_[first + k] != 0) told.push_back(k);
      if (told.empty()) return;
      const Moments& m = of_tests[t];
      const Eigen::LLT<MatrixXd> root(covariance(first, rows, m.covariance, x[0], x.size() > 1 ? x[1] : 0)(told, told));
      sum += 2 * MatrixXd(root.matrixL()).diagonal().array().log().sum();
      sum += root.matrixL().solve((y_.segment(first, rows) - m.mean)(told)).squaredNorm();
    });
    return sum;
  };
  std::vector<Free> free = {
      {.name = "sigma", .lower = least_sigma, .upper = 3, .low = least_sigma, .high = 3, .logarithmic = true}};
  if (peaks_can_go_together()) free.push_back({.name = "rho", .upper = most_in_common, .high = most_in_common});
  Values start = {0.2, 0.5};
  start.resize(free.size());
  const Fitted found = simplex(free, minus_2_ln_likelihood, start, 0.2, 120);
  return {found.x[0], free.size() > 1 ? found.x[1] : 0, found.score};
}

VectorXd PeakScatter::draw(std::uint64_t s) const {
  VectorXd made = VectorXd::Zero(y_.size());
  const double common = std::sqrt(rho_), each = std::sqrt(1 - rho_);
  for_each_test([&](std::uint64_t t, Index first, Index rows) {
    const VectorXd by =
        tau_ > 0 ? by_friction(first, rows, tau_ * random::standard_normal(29, s, t)) : VectorXd::Zero(rows);
    const double of_test = random::standard_normal(23, s, t);
    for (Index k = first; k < first + rows; ++k)
      if (y_[k] != 0)
        made[k] = by[k - first] +
                  sigma_ * (common * of_test + each * random::standard_normal(24, s, static_cast<std::uint64_t>(k))) /
                      std::sqrt(static_cast<double>(rows));
  });
  return made;
}

MatrixXd PeakScatter::weighed(const MatrixXd& columns) const {
  MatrixXd in_units = columns;
  if (roots_.empty()) return in_units;
  for_each_test([&](std::uint64_t t, Index first, Index rows) {
    in_units.middleRows(first, rows) = roots_[t].matrixL().solve(columns.middleRows(first, rows));
  });
  return in_units;
}

}  // namespace freestand::measurement
