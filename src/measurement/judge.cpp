#include "measurement/judge.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace freestand::measurement {
namespace {

constexpr double failed_residual = 1e4;  // [noise units]

// Changes between two predictions, or a prediction and what was measured, one after the other channel, in noise units.
template <class Of>
Eigen::VectorXd stacked(const Bench& bench, const Test& test, const Prediction& model, Of&& other) {
  std::vector<double> values;
  for (int c = 0; c < channel_count; ++c) {
    const auto channel = static_cast<Channel>(c);
    const double noise = bench.noise(channel);
    if (history(test, channel).empty() || noise <= 0) continue;
    const auto& a = model.channel(channel);
    const auto& b = other(channel);
    for (std::size_t k = 0; k < a.size(); ++k) values.push_back((a[k] - b[k]) / noise);
  }
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

// (C^-1/2 - 1) between A and A^T: with A^T A = V L V^T it is V ((1 + L)^-1/2 - 1)/L V^T.
Eigen::MatrixXd root_part(const Eigen::MatrixXd& gram) {
  if (gram.size() == 0) return gram;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved(gram);
  const Eigen::VectorXd part = solved.eigenvalues().unaryExpr([](double l) {
    const double root = std::sqrt(1 + std::max(l, 0.0));
    return -1 / (root * (1 + root));
  });
  return solved.eigenvectors() * part.asDiagonal() * solved.eigenvectors().transpose();
}

using Inner = Eigen::LLT<Eigen::MatrixXd>;  // of 1 + B^T B

Inner inner_of(const Eigen::MatrixXd& gram) {
  return Inner(Eigen::MatrixXd::Identity(gram.rows(), gram.rows()) + gram);
}

// r^T C^-1 r with C = 1 + B B^T: of r^T r and B^T r.
double misfit_of(double square, const Eigen::VectorXd& projected, const Inner& inner) {
  return projected.size() ? square - projected.dot(inner.solve(projected)) : square;
}

// gram: A^T A of all replays, with A as in judge.hpp.
double largest_stray(const Eigen::MatrixXd& gram) {
  const Eigen::Index count = gram.rows();
  const auto n = static_cast<double>(count), more = n / (n - 1);  // A of the others has one column fewer
  double largest = 0;
  for (Eigen::Index k = 0; k < count && count > 1; ++k) {
    std::vector<Eigen::Index> others;
    for (Eigen::Index i = 0; i < count; ++i)
      if (i != k) others.push_back(i);
    largest = std::max(largest, misfit_of(n * gram(k, k), std::sqrt(n * more) * gram(others, k),
                                          inner_of(more * gram(others, others))));
  }
  return largest;
}

}  // namespace

struct Judge::Parts {
  std::vector<Eigen::MatrixXd> A;
  std::vector<Inner> inner;
  std::vector<Eigen::MatrixXd> root;            // C^-1/2 = 1 + A root A^T
  std::vector<std::vector<Eigen::Index>> kept;  // of all samples
  Eigen::VectorXd residual(const Bench&, const Test&, const Prediction&, std::size_t i) const;
};

Judge::Judge(const Bench& bench, const ModelSpec& reference, const Values& x, const Jobs& jobs, double fanned_out)
    : bench_(bench), tests_(tests_of(bench.data(), Role::calibration)) {
  const auto columns = jobs("replays", tests_.size(), [&](std::size_t i) {
    const Test& test = bench.test(tests_[i]);
    const Prediction nominal = predict(reference, test, x);
    Values all;
    for (const FloorMotion& motion : bench.replays(tests_[i])) {
      const Prediction replay = predict(reference, test, x, &motion);
      if (replay.failed() != nominal.failed()) continue;
      const Eigen::VectorXd column = stacked(
          bench, test, replay, [&](Channel c) -> const auto& { return nominal.channel(c); });
      all.insert(all.end(), column.begin(), column.end());
    }
    return all;
  });
  take(columns, fanned_out);
}

Judge::Judge(const Bench& bench) : bench_(bench), tests_(tests_of(bench.data(), Role::calibration)) {
  take(std::vector<Values>(tests_.size()), 1);
}

void Judge::take(const std::vector<Values>& columns, double fanned_out) {
  auto parts = std::make_shared<Parts>();
  for (std::size_t i = 0; i < tests_.size(); ++i) {
    const Test& test = bench_.test(tests_[i]);
    Eigen::Index rows = 0;
    for (int c = 0; c < channel_count; ++c)
      if (bench_.noise(static_cast<Channel>(c)) > 0)
        rows += static_cast<Eigen::Index>(history(test, static_cast<Channel>(c)).size());
    const Eigen::Index count = rows > 0 ? static_cast<Eigen::Index>(columns[i].size()) / rows : 0;
    Eigen::MatrixXd A = Eigen::Map<const Eigen::MatrixXd>(columns[i].data(), rows, count);
    A /= std::sqrt(std::max<double>(static_cast<double>(count), 1));
    expected_.push_back(rows > 0 ? std::sqrt(1 + A.squaredNorm() / static_cast<double>(rows)) : 1);
    std::vector<Eigen::Index> kept;
    for (Eigen::Index k = 0; k < rows; ++k)
      if (A.row(k).squaredNorm() <= fanned_out * fanned_out) kept.push_back(k);
    A = Eigen::MatrixXd(A(kept, Eigen::all));
    samples_.push_back(static_cast<double>(kept.size()));
    const Eigen::MatrixXd gram = A.transpose() * A;
    parts->inner.push_back(inner_of(gram));
    parts->root.push_back(root_part(gram));
    strays_.push_back(largest_stray(gram));
    parts->A.push_back(std::move(A));
    parts->kept.push_back(std::move(kept));
  }
  parts_ = std::move(parts);
}

Eigen::VectorXd Judge::Parts::residual(const Bench& bench, const Test& test, const Prediction& model,
                                       std::size_t i) const {
  return stacked(
      bench, test, model, [&](Channel c) -> const auto& { return history(test, c); })(kept[i]);
}

std::vector<double> Judge::whitened(std::size_t i, const ModelSpec& model, std::span<const double> x) const {
  const Test& test = bench_.test(tests_[i]);
  const Prediction prediction = predict(model, test, x);
  if (prediction.failed()) return std::vector<double>(parts_->kept[i].size(), failed_residual);
  Eigen::VectorXd r = parts_->residual(bench_, test, prediction, i);
  if (parts_->root[i].size()) r += parts_->A[i] * (parts_->root[i] * (parts_->A[i].transpose() * r));
  return {r.begin(), r.end()};
}

double Judge::misfit(std::size_t i, const ModelFit& fit, const Values& x) const {
  const Test& test = bench_.test(tests_[i]);
  const Prediction model = predict(fit.model, test, x);
  if (model.failed()) return 1e8;
  const Eigen::VectorXd r = parts_->residual(bench_, test, model, i);
  return misfit_of(r.squaredNorm(), parts_->A[i].transpose() * r, parts_->inner[i]);
}

std::vector<double> Judge::misfit(const ModelFit& fit) const {
  const auto fold = fold_of(tests_.size());
  std::vector<double> misfits;
  for (std::size_t i = 0; i < tests_.size(); ++i)
    misfits.push_back(misfit(i, fit, fit.left_out_refitted ? fit.fold_x[fold[i]] : fit.x));
  return misfits;
}

std::vector<double> Judge::misfit_of_fit(const ModelFit& fit) const {
  std::vector<double> misfits;
  for (std::size_t i = 0; i < tests_.size(); ++i) misfits.push_back(misfit(i, fit, fit.x));
  return misfits;
}

}  // namespace freestand::measurement
