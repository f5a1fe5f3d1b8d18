#include "measurement/verdict/chance.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <deque>

#include "base/random.hpp"
#include "measurement/fit/least_squares.hpp"
#include "measurement/fit/slopes.hpp"
#include "measurement/fit/starts.hpp"
#include "measurement/verdict/candidates.hpp"

namespace freestand::measurement {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double least_length = 1e-2;  // of a direction: histories that change by less in all show nothing

double standard_normal(std::uint64_t sample, std::uint64_t i) { return random::standard_normal(20, sample, i); }

// Products of all tests' columns, which processes share test by test.
struct Summed {
  MatrixXd gram, covariance, slow;
  std::vector<MatrixXd> replays;  // of each test
  VectorXd against;               // the residual
};

// columns(i) makes the columns of the i-th test, and the residual that is held against them.
template <class Columns>
Summed sum_of(const char* what, std::size_t tests, Index q, const Judge& judge, const Jobs& jobs, Columns&& columns) {
  const auto answers = jobs(what, tests, [&](std::size_t i) {
    const auto [M, r] = columns(i);
    const Judge::Products p = judge.products(i, M);
    const VectorXd against = judge.against(i, M, r);
    Values all;
    const auto add = [&](const auto& part) { all.insert(all.end(), part.data(), part.data() + part.size()); };
    add(p.gram), add(p.covariance), add(against), add(Values{p.slow.size() > 0 ? 1.0 : 0.0}), add(p.slow),
        add(p.replays);
    return all;
  });
  Summed sum{MatrixXd::Zero(q, q), MatrixXd::Zero(q, q), MatrixXd::Zero(q, q), {}, VectorXd::Zero(q)};
  for (const Values& all : answers) {
    const double* at = all.data();
    const auto take = [&](Index rows, Index cols) {
      const Eigen::Map<const MatrixXd> part(at, rows, cols);
      at += rows * cols;
      return part;
    };
    sum.gram += take(q, q);
    sum.covariance += take(q, q);
    sum.against += take(q, 1);
    if (take(1, 1).value() > 0) sum.slow += take(q, q);
    sum.replays.emplace_back(take(q, (static_cast<Index>(all.size()) - (at - all.data())) / q));
  }
  return sum;
}

// How well the noise is known: as well as the sensor says of which that is said least.
struct NoiseKnown {
  double size_error = 0;
  std::vector<double> slow_powers;
  explicit NoiseKnown(const Bench& bench) {
    for (int c = 0; c < channel_count; ++c) {
      const Sensor& sensor = bench.sensor(static_cast<Channel>(c));
      size_error = std::max(size_error, sensor.size_error);
      if (spread(sensor.slow_powers) > spread(slow_powers)) slow_powers = sensor.slow_powers;
    }
  }
  static double spread(const std::vector<double>& ascending) {
    return ascending.empty() ? 0 : ascending.back() / ascending.front();
  }
};

// What noise alone makes of the columns' products, one draw after the other. Their covariance is S + g D, D being what more_slow_power adds to
// it, g the share of that more: with S = R R^T it is R U (1 + g L) U^T R^T, where U L U^T = R^-1 D R^-T.
class NoiseDraws {
 public:
  NoiseDraws(const Summed& sum, const Judge& judge, const Bench& bench) : sum_(sum), judge_(judge), known_(bench) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solved(sum.covariance);
    root_ = solved.eigenvectors() * solved.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
    if (known_.slow_powers.empty()) return;
    const double least = 1e-10 * solved.eigenvalues().maxCoeff();
    const VectorXd inverse =
        solved.eigenvalues().unaryExpr([&](double l) { return l > least ? 1 / std::sqrt(l) : 0.0; });
    const MatrixXd back = solved.eigenvectors() * inverse.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> grown(back.transpose() * sum.slow * back);
    root_ *= grown.eigenvectors();
    growth_ = grown.eigenvalues();
  }
  VectorXd draw(std::uint64_t s) const {
    VectorXd z(root_.cols());
    for (Index k = 0; k < z.size(); ++k) z[k] = standard_normal(s, static_cast<std::uint64_t>(k));
    if (const auto& powers = known_.slow_powers; !powers.empty()) {
      const double power = powers[random::bits(23, s, 0).first % powers.size()];
      z.array() *= (1 + (power - 1) / (more_slow_power - 1) * growth_.array()).max(0).sqrt();
    }
    z = root_ * z;
    for (std::size_t i = 0; i < sum_.replays.size(); ++i)
      if (const Index count = sum_.replays[i].cols(); count > 0) z += sum_.replays[i].col(replay(s, i, count));
    return size(s) * z;
  }

  // No model gains more on the truth than the misfit of the data themselves. A replay that went another way than all others shows a gain
  // larger than that: it is judged by a covariance without it, and the direction in which it went by one with it.
  double most(std::uint64_t s) const {
    double misfit = 0;
    for (std::size_t i = 0; i < sum_.replays.size(); ++i) {
      const double n = judge_.samples()[i];
      misfit += n + 3 * std::sqrt(2 * n);
      if (const Index count = sum_.replays[i].cols(); count > 0)
        misfit += judge_.replay_misfits()[i][static_cast<std::size_t>(replay(s, i, count))];
    }
    return std::pow(size(s), 2) * misfit;
  }

 private:
  static Index replay(std::uint64_t s, std::size_t i, Index count) {
    return static_cast<Index>(random::bits(21, s, i).first % static_cast<std::uint64_t>(count));
  }
  double size(std::uint64_t s) const { return std::exp(known_.size_error * standard_normal(s, 1ULL << 40)); }

  const Summed& sum_;
  const Judge& judge_;
  NoiseKnown known_;
  MatrixXd root_;
  VectorXd growth_;
};

// Of the model's own numbers: a refit in them lowers G by z^T gram^-1 z.
class Own {
 public:
  explicit Own(const MatrixXd& gram) {
    if (gram.size() > 0) solver_.compute(gram);
  }
  MatrixXd solve(const MatrixXd& b) const { return solver_.solve(b); }
  double gain(const VectorXd& z) const { return z.size() ? z.dot(solver_.solve(z)) : 0; }

 private:
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver_;
};

}  // namespace

std::vector<Tried> at_strengths(const ModelFit& base, const std::vector<const ModelFit*>& tried) {
  constexpr std::size_t strengths = 12;
  std::vector<Tried> all;
  for (const ModelFit* fit : tried) {
    all.push_back({&fit->model, fit->x});
    const std::size_t own = fit->model.free.size() - base.x.size();
    for (Values& x : starts_from({base.x}, fit->model, strengths * own)) all.push_back({&fit->model, std::move(x)});
  }
  return all;
}

Chance chance_of_gain(const Bench& bench, const Judge& judge, const ModelFit& base,
                      const std::vector<const ModelFit*>& tried, const Jobs& jobs, const AsStated* stated,
                      std::size_t tries) {
  const auto tests = tests_of(bench.data(), Role::calibration);
  const std::vector<Tried> all = at_strengths(base, tried);
  const AsStated known = stated ? *stated : AsStated{.model = base.model, .x = base.x, .names = {}, .is_off = {}};
  const auto deviate = static_cast<Index>(known.names.size());
  const auto p = static_cast<Index>(known.x.size()), q = p + static_cast<Index>(all.size());
  const Summed sum = sum_of("what effects change", tests.size(), q, judge, jobs, [&](std::size_t i) {
    const Test& test = bench.test(tests[i]);
    const Prediction at = predict(known.model, test, known.x);
    const VectorXd r = -judge.residual(i, at);  // what a change would have to make
    MatrixXd M = MatrixXd::Zero(r.size(), q);
    if (p > 0) M.leftCols(p) = slopes_as_stated(known, judge, test, i, at);
    std::vector<Asked> moved;
    std::deque<ModelSpec> models;
    for (const Tried& one : all) {
      auto [model, x] = moved_alike(known, base, *one.model, one.x);
      moved.push_back({models.emplace_back(std::move(model)), test, std::move(x)});
    }
    predict(moved, [&](std::size_t k, const Prediction& with) {
      if (!with.failed() && !at.failed()) M.col(p + static_cast<Index>(k)) = judge.change(i, at, with);
    });
    return std::pair(std::move(M), r);
  });
  const Own own(with_tolerance(sum.gram.topLeftCorner(p, p), known));
  const Index effects = q - p;
  const MatrixXd L = p ? MatrixXd(own.solve(sum.gram.topRightCorner(p, effects))) : MatrixXd(0, effects);
  VectorXd length(effects);
  for (Index k = 0; k < effects; ++k)
    length[k] = sum.gram(p + k, p + k) - (p ? sum.gram.col(p + k).head(p).dot(L.col(k)) : 0);
  const auto largest_gain = [&](const VectorXd& z) {
    const VectorXd left = z.tail(effects) - L.transpose() * z.head(p);
    double gain = 0;
    for (Index k = 0; k < effects; ++k)
      if (length[k] > std::max(least_length, 1e-9 * sum.gram(p + k, p + k)) && left[k] > 0)
        gain = std::max(gain, left[k] * left[k] / length[k]);
    return gain;
  };
  VectorXd measured = sum.against;
  measured.segment(p - deviate, deviate) -= deviations(known);
  Chance chance{.question = help_question, .about = {}, .observed = largest_gain(measured), .tries = tries};
  const NoiseDraws noise(sum, judge, bench);
  weigh(chance, [&](std::uint64_t s) {
    VectorXd z = noise.draw(s);
    for (Index d = 0; d < deviate; ++d)
      z += sum.gram.col(p - deviate + d) * standard_normal(s, (1ULL << 41) + static_cast<std::uint64_t>(d));
    return std::min(largest_gain(z), noise.most(s));
  });
  return chance;
}

Chance chance_of_steady_gain(const Bench& bench, const ModelFit& base, const ModelFit& with, std::size_t tries,
                             const Jobs& jobs, double friction_scatter) {
  const Judge judge(bench, with.model, with.x, jobs, fanned_out, friction_scatter);
  Chance chance = chance_of_gain(bench, judge, base, {&with}, jobs, nullptr, tries);
  chance.question = steady_question;
  return chance;
}

void weigh(Chance& chance, const std::function<double(std::uint64_t)>& draw) {
  std::vector<double> made;
  for (std::uint64_t s = 0; s < chance_simulations; ++s) made.push_back(draw(s));
  const auto more = std::count_if(made.begin(), made.end(), [&](double m) { return m >= chance.observed; });
  chance.simulations = static_cast<int>(chance_simulations);
  const auto of = static_cast<double>(chance.tries), all = static_cast<double>(made.size());
  chance.p = std::min(1.0, of * (1 + static_cast<double>(more)) / (1 + all));
  const auto place = made.begin() + static_cast<long>((1 - chance_level / of) * all);
  std::nth_element(made.begin(), place, made.end());
  chance.usual = *place;
}

void weigh_power(Chance& chance, const std::function<double(std::uint64_t)>& draw) {
  std::uint64_t more = 0;
  for (std::uint64_t s = 0; s < chance_simulations; ++s) more += draw(s) > chance.usual;
  chance.told_apart = static_cast<double>(more) / static_cast<double>(chance_simulations);
}

// Of n independent numbers the sum of squares has the mean n and the variance 2 n (n is some thousand); p of them go into the
// fit, others into what C allows for; instead, a replay adds what it shows to the others.
Chance chance_of_misfit(const Bench& bench, const Judge& judge, const ModelFit& fit, double misfit_of_fit) {
  Chance chance{.question = misfit_question, .about = {}, .observed = misfit_of_fit};
  const double size = NoiseKnown(bench).size_error;
  weigh(chance, [&](std::uint64_t s) {
    double sum = -static_cast<double>(fit.x.size());
    for (std::size_t i = 0; i < judge.samples().size(); ++i) {
      const double n = judge.samples()[i] - judge.allowed()[i];
      const auto& replays = judge.replay_misfits()[i];
      sum += n + std::sqrt(2 * n) * standard_normal(s, 1000 + i);
      if (!replays.empty()) sum += replays[random::bits(22, s, i).first % replays.size()];
    }
    return std::exp(2 * size * standard_normal(s, 1ULL << 40)) * sum;
  });
  return chance;
}

// Data from the rival are m_rival + e = m_best + d + e, of which the refitted best leaves what its numbers cannot make.
Chance chance_of_lead(const Bench& bench, const Judge& judge, const ModelFit& best, const ModelFit& rival,
                      const Jobs& jobs) {
  const auto tests = tests_of(bench.data(), Role::calibration);
  const auto b = static_cast<Index>(best.x.size()), r = static_cast<Index>(rival.x.size()), q = b + r + 1;
  const Summed sum = sum_of("best and rival", tests.size(), q, judge, jobs, [&](std::size_t i) {
    const Test& test = bench.test(tests[i]);
    const Prediction of_best = predict(best.model, test, best.x), of_rival = predict(rival.model, test, rival.x);
    const VectorXd left = judge.residual(i, of_best);
    MatrixXd M = MatrixXd::Zero(left.size(), q);
    if (b > 0) M.leftCols(b) = slopes_of(judge, test, i, best.model, best.x, of_best);
    if (r > 0) M.middleCols(b, r) = slopes_of(judge, test, i, rival.model, rival.x, of_rival);
    M.col(q - 1) = judge.change(i, of_best, of_rival);
    return std::pair(std::move(M), VectorXd(-left));
  });
  const Own own_best(sum.gram.topLeftCorner(b, b)), own_rival(sum.gram.block(b, b, r, r));
  const VectorXd of_difference = sum.gram.col(q - 1).head(b), to_rival = sum.gram.col(q - 1).segment(b, r);
  const double difference = sum.gram(q - 1, q - 1);
  // G of the rival less G of the best, each fitted again to data that lie by d + e from the best: what z says of e.
  const auto lead = [&](const VectorXd& z) {
    return own_best.gain(z.head(b) + of_difference) - own_rival.gain(z.segment(b, r)) - 2 * z[q - 1] - difference;
  };
  Chance chance{.question = lead_question, .about = {}};
  // Measured data lie by r from the best: e = r - d there.
  const VectorXd measured = sum.against - sum.gram.col(q - 1);
  // Both were fitted to them already; a rival at the end of its range would gain beyond it.
  chance.observed = -2 * measured[q - 1] - difference;
  const NoiseDraws noise(sum, judge, bench);
  weigh(chance, [&](std::uint64_t s) { return std::min(lead(noise.draw(s)), noise.most(s)); });
  // Data from the best lie by e from it.
  weigh_power(chance, [&](std::uint64_t s) {
    const VectorXd z = noise.draw(s);
    return own_best.gain(z.head(b)) - own_rival.gain(z.segment(b, r) - to_rival) - 2 * z[q - 1] + difference;
  });
  // A lead that is no larger than what the rival's fit may have left is none.
  if (chance.observed <= least_gain * total(judge.samples())) chance.p = 1;
  return chance;
}

}  // namespace freestand::measurement
