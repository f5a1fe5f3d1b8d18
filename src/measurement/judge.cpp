#include "measurement/judge.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace freestand::measurement {
namespace {

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

}  // namespace

struct Judge::Parts {
  std::vector<Eigen::MatrixXd> A;
  std::vector<Eigen::LLT<Eigen::MatrixXd>> inner;  // of 1 + A^T A
};

Judge::Judge(const Bench& bench, const ModelSpec& reference, const Values& x, const Jobs& jobs)
    : bench_(bench), tests_(tests_of(bench.data(), Role::calibration)) {
  auto parts = std::make_shared<Parts>();
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
  for (std::size_t i = 0; i < tests_.size(); ++i) {
    const Test& test = bench.test(tests_[i]);
    Eigen::Index rows = 0;
    for (int c = 0; c < channel_count; ++c)
      if (bench.noise(static_cast<Channel>(c)) > 0)
        rows += static_cast<Eigen::Index>(history(test, static_cast<Channel>(c)).size());
    const Eigen::Index count = rows > 0 ? static_cast<Eigen::Index>(columns[i].size()) / rows : 0;
    Eigen::MatrixXd A = Eigen::Map<const Eigen::MatrixXd>(columns[i].data(), rows, count);
    A /= std::sqrt(std::max<double>(static_cast<double>(count), 1));
    samples_.push_back(static_cast<double>(rows));
    expected_.push_back(rows > 0 ? std::sqrt(1 + A.squaredNorm() / static_cast<double>(rows)) : 1);
    parts->inner.emplace_back(Eigen::MatrixXd::Identity(count, count) + A.transpose() * A);
    parts->A.push_back(std::move(A));
  }
  parts_ = std::move(parts);
}

double Judge::misfit(std::size_t i, const ModelFit& fit, const Values& x) const {
  const Test& test = bench_.test(tests_[i]);
  const Prediction model = predict(fit.model, test, x);
  if (model.failed()) return 1e8;
  const Eigen::VectorXd r = stacked(
      bench_, test, model, [&](Channel c) -> const auto& { return history(test, c); });
  const Eigen::VectorXd projected = parts_->A[i].transpose() * r;
  return r.squaredNorm() - (projected.size() ? projected.dot(parts_->inner[i].solve(projected)) : 0.0);
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
