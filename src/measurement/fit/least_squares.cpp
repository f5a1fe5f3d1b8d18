#include "measurement/fit/least_squares.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

namespace freestand::measurement {
namespace {

using Tests = std::vector<std::size_t>;
constexpr double difference = 2e-5;  // of the box, for derivatives
constexpr double slope_back = 1e3;   // of a residual beyond a bound, per box
constexpr int iterations = 12;       // of one round
constexpr int most_rounds = 6;
constexpr double noise_score = 0.4;  // of S: 1.2 noise units
constexpr double far_score = 4;      // of S without replays: what no floor's noise explains
constexpr double over_steps = 0.01;  // of the box: an event more or less in one test is a wall to derivatives

std::vector<const Test*> those(const Judge& judge, const Tests& tests) {
  std::vector<const Test*> all;
  for (const std::size_t i : tests) all.push_back(&judge.test(i));
  return all;
}

struct Problem {
  const Judge& judge;
  const Tests& tests;
  const ModelSpec& model;
  std::vector<double> weights;  // sqrt(n/G0), of each test
  std::size_t rows = 0;
  int evaluations = 0;

  Values point(const Values& z) const {
    Values x;
    for (std::size_t i = 0; i < model.free.size(); ++i) x.push_back(from_unit(model.free[i], z[i]));
    return x;
  }

  // Of all points at once.
  std::vector<Values> residuals(const std::vector<Values>& z) {
    std::vector<Values> x, all(z.size());
    for (const Values& at : z) x.push_back(point(at));
    predict(model, those(judge, tests), x, [&](std::size_t k, std::size_t place, const Prediction& prediction) {
      for (const double r : judge.whitened(tests[place], prediction)) all[k].push_back(weights[place] * r);
    });
    for (std::size_t k = 0; k < z.size(); ++k)
      for (std::size_t i = 0; i < x[k].size(); ++i)
        all[k].push_back(slope_back * (z[k][i] - to_unit(model.free[i], x[k][i])));
    evaluations += static_cast<int>(z.size());
    return all;
  }
};

Values values_of(const gsl_vector* z) {
  Values x;
  for (std::size_t i = 0; i < z->size; ++i) x.push_back(gsl_vector_get(z, i));
  return x;
}

int residuals(const gsl_vector* z, void* problem, gsl_vector* f) {
  const Values rows = static_cast<Problem*>(problem)->residuals({values_of(z)}).front();
  for (std::size_t row = 0; row < rows.size(); ++row) gsl_vector_set(f, row, rows[row]);
  return GSL_SUCCESS;
}

using Vector = std::unique_ptr<gsl_vector, decltype(&gsl_vector_free)>;
Vector vector(std::size_t n) { return {gsl_vector_alloc(n), gsl_vector_free}; }

// Differences inwards, where a bound is near.
int derivatives(const gsl_vector* z, void* problem, gsl_matrix* J) {
  auto& p = *static_cast<Problem*>(problem);
  std::vector<Values> points = {values_of(z)};
  Values steps;
  for (std::size_t i = 0; i < p.model.free.size(); ++i) {
    const double beyond = points[0][i] + difference;
    const bool inside = std::abs(to_unit(p.model.free[i], from_unit(p.model.free[i], beyond)) - beyond) < 1e-9;
    steps.push_back(inside ? difference : -difference);
    points.push_back(points[0]);
    points.back()[i] += steps.back();
  }
  const std::vector<Values> rows = p.residuals(points);
  for (std::size_t i = 0; i < steps.size(); ++i)
    for (std::size_t row = 0; row < rows[0].size(); ++row)
      gsl_matrix_set(J, row, i, (rows[i + 1][row] - rows[0][row]) * (1 / steps[i]));
  return GSL_SUCCESS;
}

// One round of Levenberg and Marquardt from x.
Values round_from(Problem& problem, const Values& x) {
  const std::size_t n = problem.model.free.size();
  Vector z = vector(n);
  for (std::size_t i = 0; i < n; ++i) gsl_vector_set(z.get(), i, to_unit(problem.model.free[i], x[i]));
  gsl_multifit_nlinear_fdf function{};
  function.f = residuals;
  function.df = derivatives;
  function.n = problem.rows;
  function.p = n;
  function.params = &problem;
  const auto parameters = gsl_multifit_nlinear_default_parameters();
  const std::unique_ptr<gsl_multifit_nlinear_workspace, decltype(&gsl_multifit_nlinear_free)> work(
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &parameters, problem.rows, n), gsl_multifit_nlinear_free);
  if (gsl_multifit_nlinear_init(z.get(), &function, work.get())) return x;
  int info = 0;
  gsl_multifit_nlinear_driver(iterations, 1e-6, 1e-9, 1e-9, nullptr, nullptr, &info, work.get());
  return problem.point(values_of(gsl_multifit_nlinear_position(work.get())));
}

}  // namespace

std::vector<std::size_t> all_of(const Judge& judge) {
  Tests all(judge.samples().size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::vector<double> misfits(const Judge& judge, const Tests& tests, const ModelSpec& model, std::span<const double> x) {
  std::vector<double> all;
  const std::vector<Values> point = {Values(x.begin(), x.end())};
  predict(model, those(judge, tests), point, [&](std::size_t, std::size_t k, const Prediction& prediction) {
    const auto r = judge.whitened(tests[k], prediction);
    all.push_back(std::inner_product(r.begin(), r.end(), r.begin(), 0.0));
  });
  return all;
}

double least_squares_score(const Judge& judge, const Tests& tests, const ModelSpec& model, std::span<const double> x) {
  const std::vector<double> of_tests = misfits(judge, tests, model, x);
  double sum = 0;
  for (std::size_t k = 0; k < tests.size(); ++k)
    if (const double n = judge.samples()[tests[k]]; n > 0) sum += std::log(std::max(of_tests[k] / n, 1e-6));
  return sum / static_cast<double>(std::max<std::size_t>(tests.size(), 1));
}

Fitted least_squares(const Judge& judge, const Tests& tests, const ModelSpec& model, const Values& x, int rounds) {
  Fitted best{x, least_squares_score(judge, tests, model, x), 1};
  gsl_error_handler_t* const handler = gsl_set_error_handler_off();
  for (int round = 0; round < rounds && !model.free.empty(); ++round) {
    Problem problem{judge, tests, model, {}, model.free.size()};
    const std::vector<double> of_tests = misfits(judge, tests, model, best.x);
    for (std::size_t k = 0; k < tests.size(); ++k) {
      const double n = judge.samples()[tests[k]];
      problem.weights.push_back(std::sqrt(n / std::max(of_tests[k], 1e-6 * n)));
      problem.rows += static_cast<std::size_t>(n);
    }
    const Values found = round_from(problem, best.x);
    const double score = least_squares_score(judge, tests, model, found), gain = best.score - score;
    best.evaluations += problem.evaluations + 2;
    if (gain > 0) best.x = found, best.score = score;
    if (gain < least_gain) break;
  }
  gsl_set_error_handler(handler);
  return best;
}

namespace {

// One piece of work that all processes need the answer of.
template <class Work>
Fitted once(const Jobs& jobs, Work&& work) {
  Values values = jobs("least squares", 1, [&](std::size_t) {
                    const Fitted found = work();
                    Values packed = {found.score, static_cast<double>(found.evaluations)};
                    packed.insert(packed.end(), found.x.begin(), found.x.end());
                    return packed;
                  }).front();
  return {Values(values.begin() + 2, values.end()), values[0], static_cast<int>(values[1])};
}

// Takes the fit to the least S with replays, if that is at the noise: a model that is wrong would only hide behind them. And if it misses
// less by the replays of where it came from, too: where the motion is chaotic, those of a worse fit fan out and leave nothing to miss.
bool weigh_floor_noise(const Bench& bench, ModelFit& fit, const Tests& tests, const Jobs& jobs) {
  Fitted found{fit.x, 0, 0};
  for (int again = 0; again < 2; ++again) {
    const Judge judge(bench, fit.model, found.x, jobs, fanned_out);
    const Objective score = [&](std::span<const double> x) { return least_squares_score(judge, tests, fit.model, x); };
    found = once(jobs, [&] {
      const Fitted smooth = least_squares(judge, tests, fit.model, found.x, most_rounds);
      if (again > 0) return smooth;
      Fitted over = simplex(fit.model.free, score, smooth.x, over_steps, 25 * static_cast<int>(fit.x.size() + 1));
      over.evaluations += smooth.evaluations;
      return over;
    });
    fit.evaluations += found.evaluations;
  }
  const Judge before(bench, fit.model, fit.x, jobs);
  const double stays = least_squares_score(before, tests, fit.model, fit.x);
  if (least_squares_score(before, tests, fit.model, found.x) > stays) return stays <= noise_score;
  if (found.score > noise_score) return false;
  fit.x = found.x;
  return true;
}

// How far the i-th number alone may go to one side before the misfit rises by so much.
double end_of_range(const Objective& total, double rise, const ModelFit& fit, std::size_t i, double side) {
  const Free& free = fit.model.free[i];
  const double least = total(fit.x), z = to_unit(free, fit.x[i]);
  const auto at = [&](double step) {
    Values x = fit.x;
    x[i] = from_unit(free, z + side * step);
    return x;
  };
  const double bound = std::abs(to_unit(free, side > 0 ? free.upper : free.lower) - z);
  double within = 0, beyond = std::min(1e-4, bound);
  while (total(at(beyond)) - least < rise) {
    within = beyond;
    if (beyond >= bound) return at(bound)[i];
    beyond = std::min(3 * beyond, bound);
  }
  for (int halving = 0; halving < 5; ++halving) {
    const double middle = 0.5 * (within + beyond);
    (total(at(middle)) - least < rise ? within : beyond) = middle;
  }
  return at(within)[i];
}

void widen(Interval& interval, double lower, double upper) {
  interval = {std::min(interval.lower, lower), std::max(interval.upper, upper)};
}

// Widens intervals to what the number alone may do. The jackknife is blind to a number that no test determines: no refit
// moves it.
void widen_intervals(const Objective& total, double rise, ModelFit& fit, const Jobs& jobs) {
  const auto ends = jobs("intervals", 2 * fit.x.size(), [&](std::size_t k) {
    return Values{end_of_range(total, rise, fit, k / 2, k % 2 == 0 ? -1 : 1)};
  });
  for (std::size_t i = 0; i < fit.intervals.size(); ++i) widen(fit.intervals[i], ends[2 * i][0], ends[2 * i + 1][0]);
}

constexpr double chi_square_95 = 3.84;  // of one degree of freedom

// Of a model that is far from the noise, or of peaks: peaks scatter by what the fit leaves of them, where tests that tell something are
// more than the numbers; else nobody knows by what, and any number may be. Of histories no likelihood is known: a twentieth of one test's
// squared error counts.
struct ByScore {
  Objective total;
  double rise;
  ByScore(const Bench& bench, const Tests& tests, const ModelFit& fit) {
    const auto n = static_cast<double>(tests.size());
    total = [&bench, &tests, &fit, n](std::span<const double> x) { return n * mean_score(bench, tests, fit.model, x); };
    rise = 0.05;
    if (kind(bench.test(tests.front())) == Kind::history) return;
    const double freedom = telling_tests(bench, tests, fit.model, fit.x).count() - static_cast<double>(fit.x.size());
    rise =
        freedom < 1 ? std::numeric_limits<double>::infinity() : std::max(chi_square_95 * n * fit.score / freedom, 1e-9);
  }
};

}  // namespace

void widen_by_score(const Bench& bench, std::vector<ModelFit*> fits, const Jobs& jobs) {
  const Tests tests = tests_of(bench.data(), Role::calibration);
  struct Place {
    std::size_t fit, number;
  };
  std::vector<Place> places;
  for (std::size_t f = 0; f < fits.size(); ++f)
    for (std::size_t i = 0; i < fits[f]->intervals.size(); ++i) places.push_back({f, i});
  const auto ends = jobs("intervals", 2 * places.size(), [&](std::size_t k) {
    const ModelFit& fit = *fits[places[k / 2].fit];
    const ByScore by(bench, tests, fit);
    return Values{end_of_range(by.total, by.rise, fit, places[k / 2].number, k % 2 == 0 ? -1 : 1)};
  });
  for (std::size_t p = 0; p < places.size(); ++p)
    widen(fits[places[p].fit]->intervals[places[p].number], ends[2 * p][0], ends[2 * p + 1][0]);
}

namespace {

struct Descent {
  Fitted at;
  double mean_score;
  void take(ModelFit& fit) && {
    fit.score = mean_score;
    fit.evaluations += at.evaluations;
    fit.x = std::move(at.x);
  }
};

// Each from where it stands downhill in S.
std::vector<Descent> descents(const Bench& bench, const Judge& judge, const std::vector<ModelFit*>& fits,
                              const Jobs& jobs) {
  const auto calibration = tests_of(bench.data(), Role::calibration);
  const Tests all = all_of(judge);
  std::vector<Descent> found;
  for (const Values& answer : jobs("least squares", fits.size(), [&](std::size_t i) {
         const ModelFit& fit = *fits[i];
         const Fitted at = least_squares(judge, all, fit.model, fit.x, most_rounds);
         Values packed = {at.score, static_cast<double>(at.evaluations),
                          mean_score(bench, calibration, fit.model, at.x)};
         packed.insert(packed.end(), at.x.begin(), at.x.end());
         return packed;
       }))
    found.push_back({{Values(answer.begin() + 3, answer.end()), answer[0], static_cast<int>(answer[1])}, answer[2]});
  return found;
}

}  // namespace

void descend_by_derivatives(const Bench& bench, std::vector<ModelFit*> fits, const Jobs& jobs) {
  auto found = descents(bench, Judge(bench), fits, jobs);
  for (std::size_t i = 0; i < fits.size(); ++i) std::move(found[i]).take(*fits[i]);
}

void weigh_floor_noise(const Bench& bench, const Judge& judge, std::vector<ModelFit*> fits, const Jobs& jobs) {
  std::erase_if(fits, [](const ModelFit* fit) { return fit->score > far_score; });
  auto found = descents(bench, judge, fits, jobs);
  std::vector<ModelFit*> near;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (found[i].at.score > noise_score) continue;
    std::move(found[i]).take(*fits[i]);
    near.push_back(fits[i]);
  }
  leave_out(
      bench, near,
      [&](const ModelFit& fit, std::size_t fold, const Tests& seen) {
        return least_squares(judge, seen, fit.model, fit.fold_x[fold], 1);
      },
      jobs);
}

void settle(const Bench& bench, ModelFit& fit, const Effort& effort, const Jobs& jobs) {
  const auto calibration = tests_of(bench.data(), Role::calibration);
  const Kind judged = calibration.empty() ? Kind::history : kind(bench.test(calibration.front()));
  if (calibration.empty() || judged != Kind::history) {
    leave_out(bench, {&fit}, effort, jobs);
    if (judged == Kind::peaks) widen_by_score(bench, {&fit}, jobs);
    return;
  }
  const Judge sensors(bench);
  const Tests all = all_of(sensors);
  const Fitted plain = once(jobs, [&] { return least_squares(sensors, all, fit.model, fit.x, most_rounds); });
  fit.evaluations += plain.evaluations;
  fit.x = plain.x;
  const bool near = plain.score < far_score && weigh_floor_noise(bench, fit, all, jobs);
  fit.score = mean_score(bench, calibration, fit.model, fit.x);
  if (!near) {
    leave_out(bench, {&fit}, effort, jobs);
    widen_by_score(bench, {&fit}, jobs);
    return;
  }
  const Judge judge(bench, fit.model, fit.x, jobs, fanned_out);
  leave_out(
      bench, {&fit},
      [&](const ModelFit& whole, std::size_t, const Tests& seen) {
        return least_squares(judge, seen, whole.model, whole.x, 1);
      },
      jobs);
  const Objective total = [&](std::span<const double> x) {
    const std::vector<double> of_tests = misfits(judge, all, fit.model, x);
    return std::accumulate(of_tests.begin(), of_tests.end(), 0.0);
  };
  widen_intervals(total, chi_square_95, fit, jobs);
}

}  // namespace freestand::measurement
