// Sets of outcomes drawn from a fit, and the fits of a table to many of them at once.
#include <algorithm>
#include <limits>
#include <numeric>

#include "base/random.hpp"
#include "measurement/fit/outcome_fit.hpp"

namespace freestand::measurement {
namespace {

using Eigen::Index;
using Eigen::MatrixXf;
using Eigen::VectorXf;

constexpr Index rows_at_once = 32;  // so that products of rows and sets stay small

std::vector<Index> every_test(Index tests) {
  std::vector<Index> all(static_cast<std::size_t>(tests));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

Index TableSearch::rows_from(Index first) const {
  return std::clamp<Index>(static_cast<Index>(rows_.size()) - first, 0, rows_at_once);
}

MatrixXf TableSearch::squares(Index first, const MatrixXf& outcomes, const std::vector<Index>& tests) const {
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const Rows> all(probability_.data() + first * outcomes.rows(), rows_from(first), outcomes.rows());
  const MatrixXf p = all(Eigen::all, tests), y = outcomes(tests, Eigen::all);
  MatrixXf square = -2 * p * y;
  square.colwise() += p.rowwise().squaredNorm();
  square.rowwise() += y.colwise().sum();
  return square;
}

VectorXf TableSearch::least_squares(const MatrixXf& outcomes) const {
  const std::vector<Index> tests = every_test(outcomes.rows());
  VectorXf least = VectorXf::Constant(outcomes.cols(), std::numeric_limits<float>::infinity());
  for (Index first = 0; rows_from(first) > 0; first += rows_at_once)
    least = least.cwiseMin(squares(first, outcomes, tests).colwise().minCoeff().transpose());
  return least;
}

TableSearch::SetFits TableSearch::fits_to(const MatrixXf& outcomes) const {
  const std::vector<Index> tests = every_test(outcomes.rows());
  SetFits fits{VectorXf::Constant(outcomes.cols(), std::numeric_limits<float>::infinity()),
               VectorXf::Zero(outcomes.cols())};
  for (Index first = 0; rows_from(first) > 0; first += rows_at_once) {
    const MatrixXf square = squares(first, outcomes, tests);
    for (Index s = 0; s < outcomes.cols(); ++s) {
      Index row = 0;
      const float least = square.col(s).minCoeff(&row);
      if (least >= fits.squares[s]) continue;
      fits.squares[s] = least;
      const float* p = probability_.data() + (first + row) * outcomes.rows();
      fits.expected[s] = std::accumulate(p, p + outcomes.rows(), 0.0F);
    }
  }
  return fits;
}

// The least of all but a fold is sought in what all tests make, less what the fold does.
VectorXf TableSearch::left_out_squares(const MatrixXf& outcomes) const {
  const Index sets = outcomes.cols();
  const std::vector<Index> all = every_test(outcomes.rows());
  std::vector<std::vector<Index>> folds;
  for (const auto fold = fold_of(all.size()); const Index t : all) {
    const std::size_t f = fold[static_cast<std::size_t>(t)];
    folds.resize(std::max(folds.size(), f + 1));
    folds[f].push_back(t);
  }
  const auto count = static_cast<Index>(folds.size());
  MatrixXf least = MatrixXf::Constant(count, sets, std::numeric_limits<float>::infinity());
  Eigen::Matrix<Index, Eigen::Dynamic, Eigen::Dynamic> row = decltype(row)::Zero(count, sets);
  for (Index first = 0; rows_from(first) > 0; first += rows_at_once) {
    const MatrixXf whole = squares(first, outcomes, all);
    for (Index f = 0; f < count; ++f) {
      const MatrixXf others = whole - squares(first, outcomes, folds[static_cast<std::size_t>(f)]);
      const Eigen::RowVectorXf lowest = others.colwise().minCoeff();
      for (Index s = 0; s < sets; ++s) {
        if (lowest[s] >= least(f, s)) continue;
        least(f, s) = others.col(s).minCoeff(&row(f, s));
        row(f, s) += first;
      }
    }
  }
  VectorXf sum = VectorXf::Zero(sets);
  for (Index f = 0; f < count; ++f)
    for (Index s = 0; s < sets; ++s)
      for (const Index t : folds[static_cast<std::size_t>(f)]) {
        const float p = probability_[static_cast<std::size_t>(row(f, s) * outcomes.rows() + t)];
        sum[s] += (p - outcomes(t, s)) * (p - outcomes(t, s));
      }
  return sum;
}

MatrixXf outcome_sets(const Bench& bench, const TabulatedFit& model, std::uint64_t stream, std::size_t sets) {
  const auto& tests = model.table.tests;
  MatrixXf y(static_cast<Index>(tests.size()), static_cast<Index>(1 + sets));
  for (std::size_t t = 0; t < tests.size(); ++t) {
    const auto row = static_cast<Index>(t);
    y(row, 0) = fell(bench.test(tests[t])) ? 1 : 0;
    for (std::uint64_t s = 0; s < sets; ++s)
      y(row, static_cast<Index>(1 + s)) = random::uniform(stream, s, t) < model.fit.calibration[t].probability ? 1 : 0;
  }
  return y;
}

OutcomeMisfit outcome_misfit(const Bench& bench, const TabulatedFit& model) {
  const MatrixXf y = outcome_sets(bench, model, 27, outcome_simulations);
  const auto fits = TableSearch(bench, model.table).fits_to(y);
  const VectorXf fallen = y.colwise().sum().transpose();
  return weigh_outcomes(fits.squares.cast<double>() / static_cast<double>(y.rows()),
                        (fallen - fits.expected).cast<double>(), fallen[0]);
}

}  // namespace freestand::measurement
