#include "measurement/fit/posterior.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/random.hpp"
#include "measurement/fit/history_misfit.hpp"
#include "measurement/fit/importance.hpp"
#include "measurement/fit/least_squares.hpp"
#include "measurement/fit/own_numbers.hpp"
#include "measurement/predict/placements.hpp"

namespace freestand::measurement {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// The rows as another test would have them: its own friction, and its own placement of the specimen. By how much friction scatters is known
// from n tests that tell of it, so that another one lies off their mean by that times Student's t of n - 1: of three tests normal
// deviates would hold it in 83 of 100 cases where 90 are meant.
void leave_the_mean(const ModelFit& fit, Posterior& out) {
  std::sort(out.of_mean.begin(), out.of_mean.end());
  out.draws = out.of_mean;
  const int placed = placement_number(fit.model);
  const auto student = [&](double z) { return gsl_cdf_tdist_Pinv(gsl_cdf_ugaussian_P(z), out.friction_freedom); };
  for (std::size_t s = 0; s < out.draws.size(); ++s) {
    Values& x = out.draws[s];
    const double friction = std::exp(out.friction_scatter * student(random::standard_normal(39, s, 0)));
    const double aside =
        out.placements.emplace_back(placement_scatter(fit.model, x) * random::standard_normal(39, s, 1));
    for (std::size_t k = 0; k < x.size(); ++k) {
      const Free& free = fit.model.free[k];
      if (is_friction(free)) x[k] = std::clamp(x[k] * friction, free.lower, free.upper);
      if (static_cast<int>(k) == placed) x[k] = placed_at(fit.model, std::log(x[k]) + aside);
    }
  }
}

Posterior of_histories(const Bench& bench, const ModelFit& fit, const Jobs& jobs) {
  Posterior out;
  const HistoryMisfit misfit(bench, fit, jobs);
  const Dispersion& found = misfit.dispersion();
  out.friction_scatter = misfit.friction_scatter();
  out.friction_freedom = misfit.friction_freedom();
  out.dispersion = found.s;
  out.freedom = found.freedom;
  out.tests_disagree = disagree_beyond_chance(found);
  out.stated_otherwise = misfit.stated_otherwise();
  out.leaves_too_much = misfit.leaves_too_much();
  const Misfits misfits = [&](const std::vector<Values>& points) {
    const auto answers =
        jobs("draws of the numbers", points.size(), [&](std::size_t s) { return Values{misfit(points[s])}; });
    std::vector<double> G;
    for (const Values& answer : answers) G.push_back(answer[0]);
    return G;
  };
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solved(misfit.rates());
  // No number is proposed wider than its range.
  const VectorXd rates = solved.eigenvalues().cwiseMax(out.dispersion * out.dispersion);
  const MatrixXd inverse =
      solved.eigenvectors() * rates.cwiseInverse().asDiagonal() * solved.eigenvectors().transpose();
  // The fit knows one friction of all tests, and all that is stated as stated: where that is not so, other numbers are likelier.
  draw_by_importance(fit, misfit.step(inverse), out.dispersion * out.dispersion * inverse, misfits, out);
  if (misfit.likeliest_as_stated()) out.better.clear();
  std::sort(out.of_mean.begin(), out.of_mean.end());
  out.in_laboratory = misfit.in_laboratory();
  out.stated = jobs("what is stated beside the draws", out.of_mean.size(),
                    [&](std::size_t s) { return misfit.stated_beside(out.of_mean[s], s); });
  return out;
}

// By how much slips lie beside the model's, apart from the sensor's noise, which is most of what small ones show.
struct Beside {
  std::vector<double> ln, noise2;  // measured over computed; variance of that by the noise

  double weight(std::size_t i, double scatter2) const { return 1 / (scatter2 + noise2[i]); }
  double weights(double scatter2) const {
    double sum = 0;
    for (std::size_t i = 0; i < ln.size(); ++i) sum += weight(i, scatter2);
    return sum;
  }
  double mean(double scatter2) const {
    double sum = 0;
    for (std::size_t i = 0; i < ln.size(); ++i) sum += weight(i, scatter2) * ln[i];
    return sum / weights(scatter2);
  }
  double chi_square(double scatter2) const {
    const double middle = mean(scatter2);
    double sum = 0;
    for (std::size_t i = 0; i < ln.size(); ++i) sum += weight(i, scatter2) * std::pow(ln[i] - middle, 2);
    return sum;
  }
  // At which chi square is its degrees of freedom (Paule & Mandel, J. Res. NBS 87, 1982); 0 where the noise explains all.
  double scatter2(double freedom) const {
    double low = 0, high = 1e-12;
    if (chi_square(high) <= freedom) return 0;
    while (chi_square(high) > freedom) high *= 2;
    for (int halved = 0; halved < 60; ++halved)
      (chi_square(0.5 * (low + high)) > freedom ? low : high) = 0.5 * (low + high);
    return high;
  }
};

// Of the tests that slipped, measured and computed. Another test lies about the mean by the scatter, and by what is not known of the mean.
void measure_discrepancy(const Bench& bench, const ModelFit& fit, const std::vector<std::size_t>& tests,
                         Posterior& out) {
  Beside beside;
  for (const std::size_t i : tests) {
    const double measured = std::abs(bench.test(i).peaks.peak_slip_m.value_or(0));
    const Prediction model = predict(fit.model, bench.test(i), fit.x);
    const double least = least_motion(bench, Channel::slip);
    if (measured > least && !model.failed() && model.response.peak_slip_m > least &&
        peaks_compare(bench.test(i), model.response)) {
      beside.ln.push_back(std::log(measured / model.response.peak_slip_m));
      beside.noise2.push_back(std::pow(bench.noise(Channel::slip) / model.response.peak_slip_m, 2));
    }
  }
  const double freedom =
      static_cast<double>(beside.ln.size()) - static_cast<double>(std::max<std::size_t>(fit.x.size(), 1));
  if (freedom < 1) return;
  const double scatter2 = beside.scatter2(freedom);
  out.slip_bias_ln = beside.mean(scatter2);
  out.slip_scatter_ln = std::sqrt(scatter2 + 1 / beside.weights(scatter2));
}

// Drawn evenly where tests only bound a number: an end of the bound is known to a 2000th of what is allowed.
constexpr std::size_t points_of_a_bound = 2000;

Posterior of_peaks(const Bench& bench, const ModelFit& fit, const Jobs& jobs) {
  Posterior out;
  const auto tests = tests_of(bench.data(), Role::calibration);
  const double n = static_cast<double>(tests.size()), p = static_cast<double>(fit.x.size());
  const Misfits misfits = [&](const std::vector<Values>& points) {
    const auto answers = jobs("draws of the numbers", points.size(), [&](std::size_t s) {
      return Values{points[s].empty() ? no_fit : n * mean_score(bench, tests, fit.model, points[s])};
    });
    std::vector<double> G;
    for (const Values& answer : answers) G.push_back(answer[0]);
    return G;
  };
  out.freedom = telling_tests(bench, tests, fit.model, fit.x).count() - p;
  measure_discrepancy(bench, fit, tests, out);
  if (fit.x.empty()) return out;
  const double at_fit = misfits({fit.x}).front();
  // All stood still, or all fell, and the model agrees: as likely wherever it does, and nowhere else.
  if (at_fit == 0) {
    const std::vector<Values> points = sobol_starts(fit.model.free, points_of_a_bound);
    const std::vector<double> G = misfits(points);
    for (std::size_t i = 0; i < points.size(); ++i)
      if (G[i] == 0) out.draws.push_back(points[i]);
    out.of_mean = out.draws;
    return out;
  }
  if (out.freedom < 1) return out;
  out.dispersion = std::sqrt(at_fit / out.freedom);
  MatrixXd covariance = MatrixXd::Identity(static_cast<Index>(p), static_cast<Index>(p));
  for (std::size_t k = 0; k < fit.x.size(); ++k) {
    const Free& free = fit.model.free[k];
    const bool known = k < fit.intervals.size() && fit.intervals[k].lower < fit.intervals[k].upper;
    const double width = known ? to_unit(free, fit.intervals[k].upper) - to_unit(free, fit.intervals[k].lower) : 1.0;
    covariance(static_cast<Index>(k), static_cast<Index>(k)) = std::pow(width / 4, 2);
  }
  draw_by_importance(fit, VectorXd::Zero(static_cast<Index>(p)), covariance, misfits, out);
  return out;
}

}  // namespace

Interval Posterior::interval(std::size_t number, double level, std::optional<double> held) const {
  std::vector<double> values;
  for (const Values& row : of_mean) values.push_back(row[number]);
  std::sort(values.begin(), values.end());
  const auto count = static_cast<double>(values.size());
  double below = (1 - level) / 2, above = below;  // shares left out
  if (held) {
    const auto [from, to] = std::equal_range(values.begin(), values.end(), *held);
    const double least = static_cast<double>(from - values.begin()) / count,
                 most = static_cast<double>(values.end() - to) / count;
    if (least < below)
      below = least, above = 1 - level - least;
    else if (most < above)
      above = most, below = 1 - level - most;
  }
  const auto at = [&](double share) {
    const double place = std::clamp(share * count - 0.5, 0.0, count - 1);
    const auto lower = static_cast<std::size_t>(place);
    const double upper = values[std::min(lower + 1, values.size() - 1)];
    return values[lower] + (place - static_cast<double>(lower)) * (upper - values[lower]);
  };
  const Interval interval{at(below), at(1 - above)};
  return held ? Interval{std::min(interval.lower, *held), std::max(interval.upper, *held)} : interval;
}

Interval interval_of(const Posterior& open, const ModelFit& fit, std::size_t number, double level) {
  if (!fit.draws
           .empty()) {  // of rows that miss outcomes by as much the fit is one: it says nothing of where the others lie
    const Interval drawn = open.interval(number, level);
    return {std::min(drawn.lower, fit.x[number]), std::max(drawn.upper, fit.x[number])};
  }
  const bool allowed = fit.evaluations > 0 || open.better.empty();
  return open.interval(number, level, allowed ? std::optional(fit.x[number]) : std::nullopt);
}

bool take_intervals(const Posterior& open, ModelFit& fit) {
  if (open.of_mean.empty()) return false;
  for (fit.intervals.clear(); fit.intervals.size() < fit.x.size();)
    fit.intervals.push_back(interval_of(open, fit, fit.intervals.size(), 0.95));
  return true;
}

bool draws_friction(const ModelSpec& model, const Posterior& open) {
  return open.friction_scatter > 0 && std::any_of(model.free.begin(), model.free.end(), is_friction);
}

Posterior posterior(const Bench& bench, const ModelFit& fit, const Jobs& jobs) {
  Posterior out;
  const Kind kind = kind_of_set(bench);
  if (tests_of(bench.data(), Role::calibration).empty() || (fit.x.empty() && kind != Kind::peaks)) return out;
  switch (kind) {
    case Kind::history:
      out = of_histories(bench, fit, jobs);
      break;
    case Kind::peaks:
      out = of_peaks(bench, fit, jobs);
      break;
    case Kind::outcome:
      out.of_mean = fit.draws;
      break;
  }
  leave_the_mean(fit, out);
  return out;
}

Posterior open_numbers(const Bench& bench, ModelFit& fit, const Jobs& jobs) {
  constexpr int most_restarts = 3;
  const auto tests = tests_of(bench.data(), Role::calibration);
  const auto move_to = [&](Values x) {
    fit.x = std::move(x);
    fit.score = mean_score(bench, tests, fit.model, fit.x);
  };
  int restarts = fit.evaluations > 0 ? most_restarts : 0;
  if (kind_of_set(bench) == Kind::history && restarts > 0)
    if (auto own = with_own_friction_where_it_explains(bench, fit, jobs)) {
      move_to(std::move(own->fit.x));
      restarts = 0;
    }
  Posterior open = posterior(bench, fit, jobs);
  bool as_drawn = false;  // from then on the plain score decides nothing
  for (int restart = 0; restart < restarts && !open.better.empty(); ++restart) {
    ModelFit from_there = fit;
    from_there.x = open.better;
    if (!as_drawn) settle(bench, from_there, Effort{}, jobs);
    as_drawn = as_drawn || !(from_there.score < fit.score);
    if (as_drawn && kind_of_set(bench) != Kind::history) break;
    if (as_drawn)
      move_to(open.better);
    else
      fit = std::move(from_there);
    open = posterior(bench, fit, jobs);
  }
  take_intervals(open, fit);
  return open;
}

}  // namespace freestand::measurement
