#include "measurement/fit/own_numbers.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

#include "measurement/fit/least_squares.hpp"
#include "measurement/levels.hpp"

namespace freestand::measurement {
namespace {

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
  OwnNumbers own;
  const auto size = [&](double value) { return free.logarithmic ? std::log(value) : value; };
  double mean = 0;
  constexpr double near = 1e-3;
  for (std::size_t i = 0; i < tests; ++i) {
    const double value = answers[i][0], left = answers[i][1];
    own.of_tests.push_back(value);
    own.misfit += left;
    if (judge.samples()[i] > 0) own.worst = std::max(own.worst, left / judge.samples()[i]);
    own.at_end |= to_unit(free, value) - to_unit(free, free.lower) < near ||
                  to_unit(free, free.upper) - to_unit(free, value) < near;
    mean += size(value) / static_cast<double>(tests);
  }
  for (const double value : own.of_tests)
    own.scatter += std::pow(size(value) - mean, 2) / std::max(static_cast<double>(tests) - 1, 1.0);
  own.scatter = std::sqrt(own.scatter);
  return own;
}

}  // namespace

OwnNumbers own_friction(const Bench& bench, const Judge& judge, const ModelFit& fit, const Jobs& jobs) {
  const Free factor = {.name = "factor", .lower = 0.5, .upper = 2, .low = 0.8, .high = 1.25, .logarithmic = true};
  return fitted_to_each(bench, judge, fit, &ModelSpec::friction_factor, factor, {0.93, 1.0, 1.07}, 0.1,
                        "friction of each test", jobs);
}

OwnNumbers own_clocks(const Bench& bench, const Judge& judge, const ModelFit& fit, const Jobs& jobs) {
  const double most = longest_lag_s;
  const Free behind = {.name = "behind", .unit = "s", .lower = -most, .upper = most, .low = -most, .high = most};
  return fitted_to_each(bench, judge, fit, &ModelSpec::clock_behind, behind, {-most / 4, 0, most / 4}, 0.1,
                        "clock of each test", jobs);
}

bool explain_tests(const OwnNumbers& own, double samples, double least_misfit) {
  const auto numbers = static_cast<double>(own.of_tests.size());
  return !own.at_end && own.worst <= adequate * adequate && own.misfit <= adequate * adequate * samples &&
         least_misfit - own.misfit > gsl_cdf_chisq_Pinv(1 - chance_level, numbers);
}

}  // namespace freestand::measurement
