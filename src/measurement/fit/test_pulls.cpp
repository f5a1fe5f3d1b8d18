#include "measurement/fit/test_pulls.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "measurement/fit/slopes.hpp"

namespace freestand::measurement {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// The numbers' part of a test's pull where the friction of the test is off by a number of variance tau2.
Pull allowing(const Pull& test, double tau2) {
  const Index p = test.gram.rows() - 1;
  const double share = tau2 / (1 + tau2 * test.gram(p, p));
  const VectorXd f = test.gram.col(p).head(p);
  return {test.gram.topLeftCorner(p, p) - share * f * f.transpose(),
          test.against.head(p) - share * test.against[p] * f};
}

}  // namespace

OwnShifts::OwnShifts(const Bench& bench, const Judge& judge, const AsStated& place)
    : bench_(bench),
      judge_(judge),
      place_(place),
      model_(place.model),
      tests_(tests_of(bench.data(), Role::calibration)) {
  model_.friction_factor = {.free = static_cast<int>(place.x.size())};
  // Whose unit of the cube is one of the logarithm.
  model_.free.push_back(
      {.name = "factor", .lower = 0.1, .upper = 10, .low = std::exp(-0.5), .high = std::exp(0.5), .logarithmic = true});
}

Asked OwnShifts::asked(std::size_t i, Values x, double shift) const {
  x.insert(x.end(), place_.x.begin() + static_cast<std::ptrdiff_t>(x.size()), place_.x.end());
  x.push_back(std::exp(shift));
  return {model_, bench_.test(tests_[i]), std::move(x)};
}

Prediction OwnShifts::at(std::size_t i, Values x, double shift) const {
  return std::move(predict({asked(i, std::move(x), shift)}).front());
}

MatrixXd OwnShifts::slopes(std::size_t i, double shift) const {
  Values x = place_.x;
  x.push_back(std::exp(shift));
  MatrixXd M = slopes_of(judge_, bench_.test(tests_[i]), i, model_, x, at(i, place_.x, shift));
  VectorXd of_numbers = VectorXd::Zero(M.rows());
  bool held = false;
  for (std::size_t k = 0; k < place_.x.size(); ++k) {
    const Free& free = place_.model.free[k];
    if (!is_friction(free)) continue;
    constexpr double little = 1e-6;
    const double rate = (to_unit(free, place_.x[k] * (1 + little)) - to_unit(free, place_.x[k])) / little;
    of_numbers += rate * M.col(static_cast<Index>(k));
    held = true;
  }
  if (held) M.rightCols(1) = of_numbers;
  return M;
}

Pull OwnShifts::pull(std::size_t i, double shift) const {
  const MatrixXd M = slopes(i, shift);
  Pull pull{judge_.products(i, M).gram, judge_.against(i, M, judge_.residual(i, at(i, place_.x, shift)))};
  pull.against -= shift * pull.gram.rightCols(1);
  return pull;
}

// A stop more or less parts the valleys of two frictions: so from several.
double OwnShifts::best(std::size_t i) const {
  Shift best = best_from(i, 0);
  for (const double start : {-0.1, 0.1})
    if (const Shift found = best_from(i, start); found.G < best.G) best = found;
  return best.ln;
}

OwnShifts::Shift OwnShifts::best_from(std::size_t i, double start) const {
  constexpr int steps = 6;
  constexpr double little = 1e-4;
  const auto misfit = [&](double shift, VectorXd& r) {
    const Prediction model = at(i, place_.x, shift);
    r = judge_.residual(i, model);
    return model.failed() ? no_fit : judge_.against(i, r, r)[0];
  };
  VectorXd r;
  Shift best{start, misfit(start, r)};
  for (int k = 0; k < steps; ++k) {
    const MatrixXd f = judge_.change(i, at(i, place_.x, best.ln), at(i, place_.x, best.ln + little)) / little;
    const double ff = judge_.products(i, f).gram(0, 0);
    if (!(ff > 0)) break;
    double step = std::clamp(-judge_.against(i, f, r)[0] / ff, -0.3, 0.3);
    VectorXd next;
    double there = misfit(best.ln + step, next);
    for (int half = 0; half < 4 && there > best.G; ++half) there = misfit(best.ln + (step /= 2), next);
    if (!(there < best.G)) break;
    best = {best.ln + step, there};
    r = next;
  }
  return best;
}

std::vector<Pull> pulls_of(const OwnShifts& own, const std::vector<double>& shifts, const Jobs& jobs) {
  const auto answers = jobs("what the tests say of the numbers", own.count(), [&](std::size_t i) {
    const Pull pull = own.pull(i, shifts[i]);
    Values all(pull.gram.data(), pull.gram.data() + pull.gram.size());
    all.insert(all.end(), pull.against.begin(), pull.against.end());
    return all;
  });
  std::vector<Pull> pulls;
  for (const Values& all : answers) {
    const auto q = static_cast<Index>(std::lround(std::sqrt(all.size() + 0.25) - 0.5));  // q^2 + q numbers
    pulls.push_back({Eigen::Map<const MatrixXd>(all.data(), q, q), Eigen::Map<const VectorXd>(all.data() + q * q, q)});
  }
  return pulls;
}

std::vector<Pull> of_first(const std::vector<Pull>& pulls, Index count) {
  std::vector<Pull> first;
  for (const Pull& test : pulls) {
    std::vector<Index> kept(static_cast<std::size_t>(count));
    std::iota(kept.begin(), kept.end(), Index{0});
    kept.push_back(test.gram.rows() - 1);  // the friction of the test
    first.push_back({test.gram(kept, kept), test.against(kept)});
  }
  return first;
}

Pull sum_of(const std::vector<Pull>& pulls, double tau2) {
  const Index p = pulls.front().gram.rows() - 1;
  Pull sum{MatrixXd::Zero(p, p), VectorXd::Zero(p)};
  for (const Pull& test : pulls) {
    const Pull part = allowing(test, tau2);
    sum.gram += part.gram;
    sum.against += part.against;
  }
  return sum;
}

namespace {

// Restricted likelihood of tau, -2 ln.
double unlikely(const std::vector<Pull>& pulls, double tau) {
  const double tau2 = tau * tau;
  const Pull sum = sum_of(pulls, tau2);
  double value = 0;
  for (const Pull& test : pulls) {
    const Index p = test.gram.rows() - 1;
    const double more = 1 + tau2 * test.gram(p, p);
    value += std::log(more) - tau2 * test.against[p] * test.against[p] / more;
  }
  if (sum.gram.size() == 0) return value;
  const Eigen::LDLT<MatrixXd> solved(sum.gram);
  return value + solved.vectorD().cwiseAbs().array().log().sum() - sum.against.dot(solved.solve(sum.against));
}

}  // namespace

double friction_scatter(const std::vector<Pull>& pulls) {
  constexpr double least = 1e-4, most = 0.5, factor = 1.05;  // friction is given to no more than that
  double best = 0, value = unlikely(pulls, 0);
  const double without = value;
  for (double tau = least; tau < most; tau *= factor)
    if (const double here = unlikely(pulls, tau); here < value) best = tau, value = here;
  // At the edge of what tau can be, half of all chance lies at zero: p = P(chi^2 > fall)/2.
  return gsl_cdf_chisq_Q(std::max(without - value, 0.0), 1) / 2 < 0.05 ? best : 0;
}

double freedom_of_friction_scatter(const std::vector<Pull>& pulls, double tau2) {
  const Pull sum = sum_of(pulls, tau2);
  const Index p = sum.gram.rows(), n = static_cast<Index>(pulls.size());
  MatrixXd numbers(p, n);  // of each test, what its friction shares with them
  VectorXd precision(n);   // of what the test says of its friction, scatter allowed for
  for (Index i = 0; i < n; ++i) {
    const MatrixXd& gram = pulls[static_cast<std::size_t>(i)].gram;
    const double allowed = 1 + tau2 * gram(p, p);
    numbers.col(i) = gram.col(p).head(p) / allowed;
    precision[i] = gram(p, p) / allowed;
  }
  MatrixXd said = precision.asDiagonal();
  if (p > 0) said -= numbers.transpose() * sum.gram.completeOrthogonalDecomposition().solve(numbers);
  return tau2 * tau2 * said.squaredNorm();
}

Dispersion dispersion_of(const std::vector<Pull>& pulls, double tau2) {
  const Pull sum = sum_of(pulls, tau2);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solved(sum.gram);
  const VectorXd rates = solved.eigenvalues().cwiseMax(1e-12 * solved.eigenvalues().maxCoeff());
  const MatrixXd root = solved.eigenvectors() * rates.cwiseSqrt().cwiseInverse().asDiagonal();
  std::vector<MatrixXd> K;
  double square = 0;
  const VectorXd at_best = root * (root.transpose() * sum.against);
  for (const Pull& test : pulls) {
    const Pull part = allowing(test, tau2);
    K.push_back(root.transpose() * part.gram * root);
    square += (root.transpose() * (part.against - part.gram * at_best)).squaredNorm();
  }
  double trace = 0, trace2 = 0;
  for (std::size_t i = 0; i < K.size(); ++i)
    for (std::size_t j = 0; j < K.size(); ++j) {
      const MatrixXd V = (i == j ? K[i] : MatrixXd::Zero(K[i].rows(), K[i].cols())) - K[i] * K[j];
      if (i == j) trace += V.trace();
      trace2 += V.squaredNorm();
    }
  if (!(trace > 1e-6)) return {};  // one test says it all
  return {std::sqrt(square / trace), trace * trace / trace2};
}

bool disagree_beyond_chance(const Dispersion& of) {
  return of.freedom > 0 && gsl_cdf_chisq_Q(of.freedom * of.s * of.s, of.freedom) < chance_level;
}

}  // namespace freestand::measurement
