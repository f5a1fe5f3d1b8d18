#include "measurement/fit/model_fit.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

namespace freestand::measurement {
namespace {

constexpr std::size_t chunk = 16;  // screened points a job

struct Place {
  std::size_t task, part;
};

// A fitted point as a job returns it, and back.
Values packed(const Fitted& fitted) {
  Values values = fitted.x;
  values.push_back(fitted.score);
  values.push_back(fitted.evaluations);
  return values;
}

Fitted unpacked(Values values) {
  Fitted fitted;
  fitted.evaluations = static_cast<int>(values.back());
  values.pop_back();
  fitted.score = values.back();
  values.pop_back();
  fitted.x = std::move(values);
  return fitted;
}

std::vector<Values> points_of(const FitTask& task, const Effort& effort) {
  std::vector<Values> points = task.starts;
  if (!task.screened && !points.empty()) return points;
  const auto& free = task.model.free;
  for (auto& x : sobol_starts(free, effort.screened_per_number * std::max<std::size_t>(free.size(), 1)))
    points.push_back(std::move(x));
  return points;
}

// Scores of all points of all tasks.
std::vector<Values> screened_scores(const Bench& bench, const std::vector<FitTask>& tasks,
                                    const std::vector<std::vector<Values>>& points,
                                    const std::vector<std::size_t>& tests, Measure measure, const Jobs& jobs) {
  std::vector<Place> places;
  for (std::size_t t = 0; t < tasks.size(); ++t)
    for (std::size_t from = 0; from < points[t].size(); from += chunk) places.push_back({t, from});
  const auto answers = jobs("screening", places.size(), [&](std::size_t i) {
    const auto [t, from] = places[i];
    const auto first = points[t].begin() + static_cast<long>(from);
    const auto end = first + static_cast<long>(std::min(chunk, points[t].size() - from));
    return measure(bench, tests, tasks[t].model, {first, end});
  });
  std::vector<Values> scores(tasks.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    auto& of_task = scores[places[i].task];
    of_task.insert(of_task.end(), answers[i].begin(), answers[i].end());
  }
  return scores;
}

// Keeps the starts of the best `kept` fits.
void drop_worst(const std::vector<ModelFit>& fits, std::size_t kept, std::vector<Place>& places,
                std::vector<Values>& starts) {
  if (fits.size() <= kept) return;
  std::vector<double> scores;
  for (const ModelFit& fit : fits) scores.push_back(fit.score);
  std::nth_element(scores.begin(), scores.begin() + static_cast<long>(kept), scores.end());
  std::vector<Place> good_places;
  std::vector<Values> good_starts;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (fits[places[i].task].score >= scores[kept]) continue;
    good_places.push_back(places[i]);
    good_starts.push_back(std::move(starts[i]));
  }
  places = std::move(good_places);
  starts = std::move(good_starts);
}

TestError unpacked_error(const Values& v, std::size_t at) {
  return {.score = v[at], .noise_units = v[at + 1], .relative = v[at + 2], .probability = v[at + 3]};
}

void append(Values& values, const TestError& e) {
  values.insert(values.end(), {e.score, e.noise_units, e.relative, e.probability});
}

// 95 % intervals from the scatter of the fits with folds left out.
std::vector<Interval> jackknife(const ModelFit& fit) {
  std::vector<Interval> intervals;
  const auto n = static_cast<double>(fit.fold_x.size());
  for (std::size_t i = 0; i < fit.x.size(); ++i) {
    const Free& free = fit.model.free[i];
    double mean = 0, square = 0;
    for (const Values& x : fit.fold_x) mean += to_unit(free, x[i]) / n;
    for (const Values& x : fit.fold_x) square += std::pow(to_unit(free, x[i]) - mean, 2);
    const double half = n > 1 ? gsl_cdf_tdist_Pinv(0.975, n - 1) * std::sqrt((n - 1) / n * square) : 0;
    const double z = to_unit(free, fit.x[i]);
    intervals.push_back({from_unit(free, z - half), from_unit(free, z + half)});
  }
  return intervals;
}

}  // namespace

double ModelFit::mean_left_out() const {
  double sum = 0;
  for (const TestError& e : left_out) sum += e.score;
  return sum / static_cast<double>(std::max<std::size_t>(left_out.size(), 1));
}

Objective objective(const Bench& bench, const ModelSpec& model, std::vector<std::size_t> tests, Measure measure) {
  return [&bench, &model, tests = std::move(tests), measure](std::span<const double> x) {
    return measure(bench, tests, model, {Values(x.begin(), x.end())}).front();
  };
}

std::vector<std::size_t> fold_of(std::size_t n) {
  std::vector<std::size_t> folds;
  for (std::size_t i = 0; i < n; ++i) folds.push_back(n <= 12 ? i : i % 10);
  return folds;
}

std::vector<ModelFit> fit_models(const Bench& bench, const std::vector<FitTask>& tasks, const Effort& effort,
                                 const Jobs& jobs, Measure measure) {
  const auto tests = tests_of(bench.data(), Role::calibration);
  std::vector<std::vector<Values>> points;
  for (const FitTask& task : tasks) points.push_back(points_of(task, effort));
  const auto scores = screened_scores(bench, tasks, points, tests, measure, jobs);

  std::vector<Place> places;
  std::vector<Values> starts;
  std::vector<ModelFit> fits;
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    const auto best = best_apart(points[t], scores[t], tasks[t].model.free, effort.starts);
    fits.push_back({.model = tasks[t].model,
                    .x = best.front().x,
                    .score = best.front().score,
                    .evaluations = static_cast<int>(points[t].size()),
                    .known = tasks[t].known,
                    .by_strides = measure == mean_stride_scores});
    for (std::size_t k = 0; k < best.size(); ++k) {
      places.push_back({t, k});
      starts.push_back(best[k].x);
    }
  }
  drop_worst(fits, effort.descended, places, starts);
  const auto descents = jobs("descents", places.size(), [&](std::size_t i) {
    const ModelSpec& model = tasks[places[i].task].model;
    return packed(simplex(model.free, objective(bench, model, tests, measure), starts[i], 0.15, effort.budget));
  });
  for (std::size_t i = 0; i < places.size(); ++i) {
    ModelFit& fit = fits[places[i].task];
    const Fitted found = unpacked(descents[i]);
    fit.evaluations += found.evaluations;
    if (found.score < fit.score) fit.score = found.score, fit.x = found.x;
  }
  return fits;
}

void polish(const Bench& bench, std::vector<ModelFit*> fits, const Effort& effort, double step, const Jobs& jobs) {
  const auto tests = tests_of(bench.data(), Role::calibration);
  const auto answers = jobs("polishing", fits.size(), [&](std::size_t i) {
    const ModelFit& fit = *fits[i];
    return packed(simplex(fit.model.free, objective(bench, fit.model, tests), fit.x, step, effort.polish));
  });
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const Fitted found = unpacked(answers[i]);
    fits[i]->evaluations += found.evaluations;
    if (found.score < fits[i]->score) fits[i]->score = found.score, fits[i]->x = found.x;
  }
}

void refine(const Bench& bench, std::vector<ModelFit*> fits, const Effort& effort, const Jobs& jobs) {
  constexpr int most_rounds = 4;
  constexpr double gain = 0.02;
  for (int round = 0; round < most_rounds && !fits.empty(); ++round) {
    std::vector<double> before;
    for (const ModelFit* fit : fits) before.push_back(fit->score);
    polish(bench, fits, effort, 0.05, jobs);
    if (round > 0) polish(bench, fits, effort, 0.2, jobs);
    std::vector<ModelFit*> moving;
    for (std::size_t i = 0; i < fits.size(); ++i)
      if (fits[i]->score < before[i] - gain) moving.push_back(fits[i]);
    fits = std::move(moving);
  }
}

void leave_out(const Bench& bench, std::vector<ModelFit*> fits, const Effort& effort, const Jobs& jobs) {
  const auto tests = tests_of(bench.data(), Role::calibration);
  const Refit refit = [&](const ModelFit& fit, std::size_t, const std::vector<std::size_t>& seen) {
    std::vector<std::size_t> seen_tests;
    for (const std::size_t i : seen) seen_tests.push_back(tests[i]);
    return simplex(fit.model.free, objective(bench, fit.model, seen_tests), fit.x, 0.02, effort.fold_budget);
  };
  leave_out(bench, std::move(fits), refit, jobs);
}

void leave_out(const Bench& bench, std::vector<ModelFit*> fits, const Refit& refit, const Jobs& jobs) {
  evaluate(bench, fits, jobs);
  const auto tests = tests_of(bench.data(), Role::calibration);
  const auto fold = fold_of(tests.size());
  const std::size_t folds = fold.empty() ? 0 : *std::max_element(fold.begin(), fold.end()) + 1;
  if (folds < 2) return;
  const auto answers = jobs("leaving tests out", fits.size() * folds, [&](std::size_t i) {
    const ModelFit& fit = *fits[i / folds];
    const std::size_t k = i % folds;
    std::vector<std::size_t> seen, unseen;
    for (std::size_t t = 0; t < tests.size(); ++t)
      (fold[t] == k ? unseen : seen).push_back(fold[t] == k ? tests[t] : t);
    const Fitted found = refit(fit, k, seen);
    Values answer = packed(found);
    for (const TestError& error : test_errors(bench, unseen, fit.model, found.x)) append(answer, error);
    return answer;
  });
  for (std::size_t f = 0; f < fits.size(); ++f) {
    ModelFit& fit = *fits[f];
    fit.fold_x.clear();
    for (std::size_t k = 0; k < folds; ++k) {
      const Values& answer = answers[f * folds + k];
      const std::size_t head = fit.x.size() + 2;
      const Fitted found = unpacked(Values(answer.begin(), answer.begin() + static_cast<long>(head)));
      fit.evaluations += found.evaluations;
      fit.fold_x.push_back(found.x);
      std::size_t at = head;
      for (std::size_t t = 0; t < tests.size(); ++t)
        if (fold[t] == k) fit.left_out[t] = unpacked_error(answer, at), at += 4;
    }
    fit.left_out_refitted = true;
    fit.intervals = jackknife(fit);
  }
}

void evaluate(const Bench& bench, std::vector<ModelFit*> fits, const Jobs& jobs) {
  const auto tests = tests_of(bench.data(), Role::calibration);
  const auto answers = jobs("errors", fits.size(), [&](std::size_t i) {
    Values values;
    for (const TestError& error : test_errors(bench, tests, fits[i]->model, fits[i]->x)) append(values, error);
    return values;
  });
  for (std::size_t i = 0; i < fits.size(); ++i) {
    fits[i]->calibration.clear();
    for (std::size_t t = 0; t < tests.size(); ++t) fits[i]->calibration.push_back(unpacked_error(answers[i], 4 * t));
    fits[i]->left_out = fits[i]->calibration;
  }
}

Pooled pooled(const Bench& bench, const std::vector<std::size_t>& tests, const std::vector<TestError>& errors) {
  const Kind judged = tests.empty() ? Kind::history : kind(bench.test(tests.front()));
  std::vector<double> squares;
  for (const TestError& e : errors)
    squares.push_back(judged == Kind::history ? e.noise_units * e.noise_units : e.score);
  const auto n = static_cast<double>(squares.size());
  double mean = 0, variance = 0;
  for (const double s : squares) mean += s / n;
  for (const double s : squares) variance += (s - mean) * (s - mean) / std::max(n - 1, 1.0);
  const double se = std::sqrt(variance / std::max(n, 1.0));
  if (judged == Kind::outcome) return {mean, se};
  const double root = std::sqrt(mean);
  return {root, root > 0 ? se / (2 * root) : 0};
}

}  // namespace freestand::measurement
