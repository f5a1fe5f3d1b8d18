#include "measurement/fit/own_numbers.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

#include "measurement/fit/least_squares.hpp"
#include "measurement/levels.hpp"

namespace freestand::measurement {
namespace {

bool at_its_end(const Free& free, double value) {
  constexpr double near = 1e-3;
  return to_unit(free, value) - to_unit(free, free.lower) < near ||
         to_unit(free, free.upper) - to_unit(free, value) < near;
}

// Places of the coefficients of friction that are numbers of the fit, where the kinetic one is.
std::vector<std::size_t> friction_numbers(const ModelSpec& model) {
  std::vector<std::size_t> places;
  if (model.mu_k.free >= 0) places.push_back(static_cast<std::size_t>(model.mu_k.free));
  if (!places.empty() && model.mu_s && model.mu_s->free >= 0)
    places.push_back(static_cast<std::size_t>(model.mu_s->free));
  return places;
}

constexpr double tells = 1;  // rise of the misfit G by which a test tells of a number: one standard deviation

// The tests that tell of their own friction from both sides: one that stands still bounds it from below alone, or not at all. All, where hardly one does.
std::vector<std::size_t> telling(const Judge& judge, const ModelSpec& model, const Values& x, std::size_t first,
                                 const std::vector<double>& least) {
  constexpr double step = 1.05;
  Values more = x, less = x;
  for (std::size_t k = first; k < x.size(); ++k) more[k] *= step, less[k] /= step;
  const std::vector<double> above = misfits(judge, all_of(judge), model, more),
                            below = misfits(judge, all_of(judge), model, less);
  std::vector<std::size_t> tell;
  for (std::size_t k = 0; k < least.size(); ++k)
    if (std::min(above[k], below[k]) > least[k] + tells) tell.push_back(k);
  return tell.size() < 2 ? all_of(judge) : tell;
}

// From the number of each test, and the misfit that it leaves there. tell: the tests that tell of it, by which it scatters.
OwnNumbers summary_of(const Judge& judge, const Free& free, const std::vector<double>& of_tests,
                      const std::vector<double>& misfits, const std::vector<std::size_t>& tell) {
  OwnNumbers own{.of_tests = of_tests};
  const auto size = [&](double value) { return free.logarithmic ? std::log(value) : value; };
  const auto tests = static_cast<double>(tell.size());
  double mean = 0;
  for (std::size_t i = 0; i < of_tests.size(); ++i) {
    own.misfit += misfits[i];
    if (judge.samples()[i] > 0) own.worst = std::max(own.worst, misfits[i] / judge.samples()[i]);
    own.at_end |= at_its_end(free, of_tests[i]);
  }
  for (const std::size_t i : tell) mean += size(of_tests[i]) / tests;
  for (const std::size_t i : tell) own.scatter += std::pow(size(of_tests[i]) - mean, 2) / std::max(tests - 1, 1.0);
  own.scatter = std::sqrt(own.scatter);
  return own;
}

OwnNumbers fitted_to_each(const Bench& bench, const Judge& judge, const ModelFit& fit, Number ModelSpec::*number,
                          const Free& free, const std::vector<double>& starts, double step, const char* task,
                          const Jobs& jobs) {
  constexpr int budget = 60;
  ModelSpec model = fit.model;
  model.*number = {.free = static_cast<int>(fit.x.size())};
  const std::size_t tests = tests_of(bench.data(), Role::calibration).size();
  const auto answers = jobs(task, tests, [&](std::size_t i) {
    const Objective left = [&](std::span<const double> own) {
      Values x = fit.x;
      x.push_back(own[0]);
      return misfits(judge, {i}, model, x).front();
    };
    Fitted best{{}, 1e300};
    for (const double start : starts) {
      const Fitted found = simplex({free}, left, {start}, step, budget);
      if (found.score < best.score) best = found;
    }
    return Values{best.x[0], best.score};
  });
  std::vector<double> values, left;
  for (const Values& answer : answers) values.push_back(answer[0]), left.push_back(answer[1]);
  return summary_of(judge, free, values, left, all_of(judge));
}

}  // namespace

OwnNumbers own_friction(const Bench& bench, const Judge& judge, const ModelFit& fit, const Jobs& jobs) {
  return fitted_to_each(bench, judge, fit, &ModelSpec::friction_factor, friction_of_one_test, {0.93, 1.0, 1.07}, 0.1,
                        "friction of each test", jobs);
}

OwnFriction fitted_with_own_friction(const Bench& bench, const Judge& judge, const ModelFit& fit,
                                     const OwnNumbers& start, const Jobs& jobs) {
  constexpr int rounds = 3;
  const auto tests = tests_of(bench.data(), Role::calibration);
  const std::size_t shared = fit.x.size();
  ModelSpec model = fit.model;
  Values x = fit.x;
  for (std::size_t k = 0; k < tests.size(); ++k) {
    model.friction_of_test[bench.test(tests[k]).id] = {.free = static_cast<int>(x.size())};
    model.free.push_back(friction_of_one_test);
    x.push_back(start.of_tests[k]);
  }
  x = jobs("friction of each test", 1, [&](std::size_t) {
        return least_squares(judge, all_of(judge), model, x, rounds).x;
      }).front();
  const std::vector<double> least = misfits(judge, all_of(judge), model, x);
  const std::vector<std::size_t> tell = telling(judge, model, x, shared, least);
  const std::vector<std::size_t> frictions = friction_numbers(fit.model);
  double of_all = 0;
  for (const std::size_t k : tell)
    if (!frictions.empty()) of_all += std::log(x[shared + k]) / static_cast<double>(tell.size());
  for (const std::size_t k : frictions)
    of_all = std::clamp(of_all, std::log(model.free[k].lower / x[k]), std::log(model.free[k].upper / x[k]));
  // Of one that stands still nothing is known: it has that of all, unless it moves with that.
  Values common = x;
  for (std::size_t k = 0; k < tests.size(); ++k)
    if (!std::ranges::count(tell, k)) common[shared + k] = std::exp(of_all);
  const std::vector<double> left = misfits(judge, all_of(judge), model, common);
  std::vector<double> own, misfit;
  for (std::size_t k = 0; k < tests.size(); ++k) {
    const bool as_all = left[k] < least[k] + tells;
    own.push_back((as_all ? common : x)[shared + k] * std::exp(-of_all));
    misfit.push_back(as_all ? left[k] : least[k]);
  }
  OwnFriction found{fit, summary_of(judge, friction_of_one_test, own, misfit, tell)};
  x.resize(shared);
  for (const std::size_t k : frictions) x[k] *= std::exp(of_all);
  for (std::size_t k = 0; k < tests.size(); ++k)
    found.fit.model.friction_of_test[bench.test(tests[k]).id] = {.value = own[k]};
  found.fit.x = std::move(x);
  return found;
}

OwnNumbers own_clocks(const Bench& bench, const Judge& judge, const ModelFit& fit, const Jobs& jobs) {
  const double most = longest_lag_s;
  const Free behind = {.name = "behind", .unit = "s", .lower = -most, .upper = most, .low = -most, .high = most};
  return fitted_to_each(bench, judge, fit, &ModelSpec::clock_behind, behind, {-most / 4, 0, most / 4}, 0.1,
                        "clock of each test", jobs);
}

std::optional<OwnFriction> with_own_friction_where_it_explains(const Bench& bench, const ModelFit& fit,
                                                               const Jobs& jobs) {
  if (tests_of(bench.data(), Role::calibration).size() < 3) return {};  // two that differ are no scatter
  const Judge judge(bench, fit.model, fit.x, jobs, fanned_out);
  const double samples = total(judge.samples()), left = total(judge.misfit_of_fit(fit));
  if (left <= adequate * adequate * samples) return {};
  const OwnNumbers held = own_friction(bench, judge, fit, jobs);
  OwnFriction found = fitted_with_own_friction(bench, judge, fit, held, jobs);
  if (!explain_tests(found.of_tests, samples, left)) return {};
  for (const std::size_t k : friction_numbers(fit.model))  // tests that are alike, and another range than theirs
    if (at_its_end(fit.model.free[k], found.fit.x[k])) return {};
  return found;
}

bool explain_tests(const OwnNumbers& own, double samples, double least_misfit) {
  const auto numbers = static_cast<double>(own.of_tests.size());
  return !own.at_end && own.worst <= adequate * adequate && own.misfit <= adequate * adequate * samples &&
         least_misfit - own.misfit > gsl_cdf_chisq_Pinv(1 - chance_level, numbers);
}

}  // namespace freestand::measurement
