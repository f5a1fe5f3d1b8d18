#include "measurement/fit/judge.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace freestand::measurement {
namespace {

constexpr double failed_residual = 1e4;  // [noise units]

// Changes between two predictions, or a prediction and what was measured, one after the other channel, as independent
// numbers of the sensors' noise.
template <class Of>
Eigen::VectorXd stacked(const Bench& bench, const Test& test, const Prediction& model, Of&& other) {
  std::vector<double> values;
  for (int c = 0; c < channel_count; ++c) {
    const auto channel = static_cast<Channel>(c);
    const double noise = bench.noise(channel);
    if (history(test, channel).empty() || noise <= 0) continue;
    const auto& a = model.channel(channel);
    const auto& b = other(channel);
    const std::size_t from = values.size();
    for (std::size_t k = 0; k < a.size(); ++k) values.push_back((a[k] - b[k]) / noise);
    bench.sensor(channel).whiten(values.data() + from, a.size(), test.dt_s);
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
std::vector<double> misfits_of_replays(const Eigen::MatrixXd& gram) {
  const Eigen::Index count = gram.rows();
  const auto n = static_cast<double>(count), more = n / (n - 1);  // A of the others has one column fewer
  std::vector<double> misfits;
  for (Eigen::Index k = 0; k < count && count > 1; ++k) {
    std::vector<Eigen::Index> others;
    for (Eigen::Index i = 0; i < count; ++i)
      if (i != k) others.push_back(i);
    misfits.push_back(
        misfit_of(n * gram(k, k), std::sqrt(n * more) * gram(others, k), inner_of(more * gram(others, others))));
  }
  return misfits;
}

// Of one standard deviation: half the difference that friction makes one up and one down.
Eigen::VectorXd change_with_friction(const Bench& bench, ModelSpec model, Values x, const Test& test,
                                     double deviation) {
  model.friction_factor = {.free = static_cast<int>(x.size())};
  x.push_back(std::exp(-deviation));
  const Prediction less = predict(model, test, x);
  x.back() = std::exp(deviation);
  const Prediction more = predict(model, test, x);
  Eigen::VectorXd change = 0.5 * stacked(
                                     bench, test, more, [&](Channel c) -> const auto& { return less.channel(c); });
  if (less.failed() || more.failed()) change.setZero();
  return change;
}

}  // namespace

double total(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

struct Judge::Parts {
  std::vector<Eigen::MatrixXd>
      A;  // columns of replays, then of what lies between readings, of the test's friction and of drifts
  std::vector<Eigen::Index> replays;  // how many of them are of replays
  std::vector<Inner> inner;
  std::vector<Eigen::MatrixXd> root;            // C^-1/2 = 1 + A root A^T
  std::vector<std::vector<Eigen::Index>> kept;  // of all samples
};

Judge::Judge(const Bench& bench, const ModelSpec& reference, const Values& x, const Jobs& jobs, double limit,
             double friction_scatter)
    : bench_(bench), tests_(tests_of(bench.data(), Role::calibration)) {
  const auto columns = jobs("replays", tests_.size(), [&](std::size_t i) {
    const Test& test = bench.test(tests_[i]);
    const Prediction nominal = predict(reference, test, x);
    Values all{0, 0};
    const auto add = [&](const Prediction& other, double& count) {
      if (other.failed() != nominal.failed()) return;
      const Eigen::VectorXd column = stacked(
          bench, test, other, [&](Channel c) -> const auto& { return nominal.channel(c); });
      if (column.size() > 0) ++count;
      all.insert(all.end(), column.begin(), column.end());
    };
    predict(bench.replays_asked(reference, tests_[i], x),
            [&](std::size_t, const Prediction& replay) { add(replay, all[0]); });
    for (const FloorMotion& motion : bench.between_readings(tests_[i]).strayed)
      add(predict(reference, test, x, &motion), all[1]);
    if (friction_scatter > 0) {
      const Eigen::VectorXd column = change_with_friction(bench, reference, x, test, friction_scatter);
      all.insert(all.end(), column.begin(), column.end());
    }
    return all;
  });
  take(columns, limit);
}

Judge::Judge(const Bench& bench) : bench_(bench), tests_(tests_of(bench.data(), Role::calibration)) {
  take(std::vector<Values>(tests_.size(), Values{0, 0}), 1);
}

void Judge::take(const std::vector<Values>& columns, double limit) {
  auto parts = std::make_shared<Parts>();
  for (std::size_t i = 0; i < tests_.size(); ++i) {
    const Test& test = bench_.test(tests_[i]);
    Eigen::Index rows = 0;
    for (int c = 0; c < channel_count; ++c)
      if (bench_.noise(static_cast<Channel>(c)) > 0)
        rows += static_cast<Eigen::Index>(history(test, static_cast<Channel>(c)).size());
    const Eigen::Index all = rows > 0 ? static_cast<Eigen::Index>(columns[i].size() - 2) / rows : 0;
    const auto count = static_cast<Eigen::Index>(columns[i][0]), between = static_cast<Eigen::Index>(columns[i][1]);
    const Eigen::Map<const Eigen::MatrixXd> changes(columns[i].data() + 2, rows, all);
    Eigen::MatrixXd A = changes.leftCols(count);
    A /= std::sqrt(std::max<double>(static_cast<double>(count), 1));
    const auto n = static_cast<double>(std::max<Eigen::Index>(rows, 1));
    unread_.push_back(changes.middleCols(count, between).norm() / std::sqrt(n * std::max<double>(columns[i][1], 1)));
    expected_.push_back(std::sqrt(1 + A.squaredNorm() / n));
    std::vector<Eigen::Index> kept;
    for (Eigen::Index k = 0; k < rows; ++k)
      if (A.row(k).squaredNorm() <= limit * limit) kept.push_back(k);
    samples_.push_back(static_cast<double>(kept.size()));
    replay_misfits_.push_back(misfits_of_replays(A(kept, Eigen::all).transpose() * A(kept, Eigen::all)));
    const Eigen::MatrixXd drift = drifts(test);
    A.conservativeResize(rows, all + drift.cols());
    if (drift.cols() > 0) A.rightCols(drift.cols()) = drift;
    A.middleCols(count, all - count) = changes.rightCols(all - count);
    A = Eigen::MatrixXd(A(kept, Eigen::all));
    const Eigen::MatrixXd gram = A.transpose() * A;
    parts->replays.push_back(count);
    parts->inner.push_back(inner_of(gram));
    parts->root.push_back(root_part(gram));
    allowed_.push_back(gram.size() ? gram.trace() - parts->inner.back().solve(gram * gram).trace() : 0);
    parts->A.push_back(std::move(A));
    parts->kept.push_back(std::move(kept));
  }
  parts_ = std::move(parts);
}

// A reading that moves evenly away from zero, of each sensor that drifts, by one standard deviation.
Eigen::MatrixXd Judge::drifts(const Test& test) const {
  std::vector<std::vector<double>> columns;
  for (int c = 0; c < channel_count; ++c) {
    const auto channel = static_cast<Channel>(c);
    if (history(test, channel).empty() || bench_.noise(channel) <= 0 || bench_.sensor(channel).drift_per_s == 0)
      continue;
    std::vector<double>& column = columns.emplace_back();
    for (int other = 0; other < channel_count; ++other) {
      const auto at = static_cast<Channel>(other);
      if (bench_.noise(at) <= 0) continue;
      const std::size_t from = column.size(), n = history(test, at).size();
      for (std::size_t k = 0; k < n; ++k)
        column.push_back(other == c ? bench_.sensor(at).drift_per_s * test.dt_s * static_cast<double>(k) : 0.0);
      bench_.sensor(at).whiten(column.data() + from, n, test.dt_s);
    }
  }
  Eigen::MatrixXd all(columns.empty() ? 0 : static_cast<Eigen::Index>(columns[0].size()),
                      static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k)
    all.col(static_cast<Eigen::Index>(k)) = Eigen::Map<const Eigen::VectorXd>(columns[k].data(), all.rows());
  return all;
}

std::vector<double> Judge::strays() const {
  std::vector<double> largest;
  for (const std::vector<double>& misfits : replay_misfits_)
    largest.push_back(misfits.empty() ? 0 : *std::max_element(misfits.begin(), misfits.end()));
  return largest;
}

Eigen::VectorXd Judge::residual(std::size_t i, const Prediction& model) const {
  const Test& test = bench_.test(tests_[i]);
  return stacked(
      bench_, test, model, [&](Channel c) -> const auto& { return history(test, c); })(parts_->kept[i]);
}

Eigen::VectorXd Judge::change(std::size_t i, const Prediction& from, const Prediction& to) const {
  return stacked(
      bench_, bench_.test(tests_[i]), to, [&](Channel c) -> const auto& { return from.channel(c); })(parts_->kept[i]);
}

Eigen::MatrixXd Judge::weighed(std::size_t i, const Eigen::MatrixXd& M) const {
  const Eigen::MatrixXd& A = parts_->A[i];
  if (A.cols() == 0) return M;
  return M - A * parts_->inner[i].solve(A.transpose() * M);
}

Eigen::VectorXd Judge::against(std::size_t i, const Eigen::MatrixXd& M, const Eigen::VectorXd& r) const {
  const Eigen::MatrixXd& A = parts_->A[i];
  if (A.cols() == 0) return M.transpose() * r;
  return M.transpose() * r - (A.transpose() * M).transpose() * parts_->inner[i].solve(A.transpose() * r);
}

Judge::Products Judge::products(std::size_t i, const Eigen::MatrixXd& M) const {
  const Eigen::MatrixXd& A = parts_->A[i];
  const Eigen::MatrixXd square = M.transpose() * M;
  if (A.cols() == 0) return {square, square, Eigen::MatrixXd(M.cols(), 0), slow(i, M)};
  const Eigen::MatrixXd N = A.transpose() * M, gram = A.transpose() * A, solved = parts_->inner[i].solve(N);
  Products p{square - N.transpose() * solved, {}, {}, slow(i, M - A * solved)};
  // With V = C^-1 M: of white noise V^T V, of all but replays V^T B B^T V.
  const Eigen::Index replays = parts_->replays[i], drifts = A.cols() - replays;
  const Eigen::MatrixXd cross = N - gram * solved;  // A^T V
  p.covariance = square - N.transpose() * solved - solved.transpose() * N + solved.transpose() * gram * solved;
  p.covariance += cross.bottomRows(drifts).transpose() * cross.bottomRows(drifts);
  p.replays.resize(M.cols(), replays > 1 ? replays : 0);
  const auto n = static_cast<double>(replays);
  for (Eigen::Index k = 0; k < p.replays.cols(); ++k) {
    std::vector<Eigen::Index> others;
    Eigen::VectorXd scale(A.cols() - 1);
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
      if (j == k) continue;
      scale[static_cast<Eigen::Index>(others.size())] = j < replays ? std::sqrt(n / (n - 1)) : 1;
      others.push_back(j);
    }
    const Eigen::MatrixXd G = scale.asDiagonal() * gram(others, others) * scale.asDiagonal();
    const Eigen::VectorXd b = scale.asDiagonal() * gram(others, k);
    p.replays.col(k) = std::sqrt(n) * (N.row(k).transpose() -
                                       (scale.asDiagonal() * N(others, Eigen::all)).transpose() * inner_of(G).solve(b));
  }
  return p;
}

// Of sums over the sensors' independent numbers. Noise that enters a sample enters the numbers behind it as well: these weights give those of
// samples, and they those of what the coloured noise is made of (sensor.hpp).
Eigen::MatrixXd Judge::slow(std::size_t i, const Eigen::MatrixXd& weights) const {
  const double dt_s = test(i).dt_s;
  const auto& kept = parts_->kept[i];
  Eigen::MatrixXd added(0, 0);
  Eigen::Index from = 0;
  for (int c = 0; c < channel_count; ++c) {
    const auto channel = static_cast<Channel>(c);
    const std::size_t count = bench_.noise(channel) > 0 ? history(test(i), channel).size() : 0;
    const Sensor& sensor = bench_.sensor(channel);
    const Eigen::Index first = std::exchange(from, from + static_cast<Eigen::Index>(count));
    if (count == 0 || sensor.slow_powers.empty()) continue;
    Eigen::MatrixXd known = Eigen::MatrixXd::Zero(from - first, weights.cols());  // also of samples that are left out
    for (std::size_t k = 0; k < kept.size(); ++k)
      if (first <= kept[k] && kept[k] < from) known.row(kept[k] - first) = weights.row(static_cast<Eigen::Index>(k));
    sensor.whiten_transposed(known.data(), count, dt_s, static_cast<std::size_t>(known.cols()));
    Eigen::MatrixXd more = known;
    const Sensor other = sensor.with_slow_power(more_slow_power);
    for (auto column : known.colwise()) sensor.colour_transposed(column.data(), count, dt_s);
    for (auto column : more.colwise()) other.colour_transposed(column.data(), count, dt_s);
    if (added.size() == 0) added.setZero(weights.cols(), weights.cols());
    added += more.transpose() * more - known.transpose() * known;
  }
  return added;
}

std::vector<double> Judge::whitened(std::size_t i, const Prediction& prediction) const {
  if (prediction.failed()) return std::vector<double>(parts_->kept[i].size(), failed_residual);
  Eigen::VectorXd r = residual(i, prediction);
  if (parts_->root[i].size()) r += parts_->A[i] * (parts_->root[i] * (parts_->A[i].transpose() * r));
  return {r.begin(), r.end()};
}

std::vector<double> Judge::misfit(const ModelSpec& model, const std::function<Values(std::size_t i)>& x) const {
  std::vector<Asked> asked;
  for (std::size_t i = 0; i < tests_.size(); ++i) asked.push_back({model, test(i), x(i)});
  std::vector<double> misfits;
  predict(asked, [&](std::size_t i, const Prediction& prediction) {
    if (prediction.failed()) return misfits.push_back(1e8);
    const Eigen::VectorXd r = residual(i, prediction);
    misfits.push_back(misfit_of(r.squaredNorm(), parts_->A[i].transpose() * r, parts_->inner[i]));
  });
  return misfits;
}

std::vector<double> Judge::misfit(const ModelFit& fit) const {
  const auto fold = fold_of(tests_.size());
  return misfit(fit.model, [&](std::size_t i) { return fit.left_out_refitted ? fit.fold_x[fold[i]] : fit.x; });
}

std::vector<double> Judge::misfit_of_fit(const ModelFit& fit) const {
  return misfit(fit.model, [&](std::size_t) { return fit.x; });
}

}  // namespace freestand::measurement
