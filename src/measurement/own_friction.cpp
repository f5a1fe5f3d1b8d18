#include "measurement/own_friction.hpp"

#include <cmath>
#include <numeric>

namespace freestand::measurement {

OwnFriction own_friction(const Bench& bench, const Judge& judge, const ModelFit& fit, const Jobs& jobs) {
  constexpr int budget = 60;
  ModelSpec model = fit.model;
  model.friction_factor = {.free = static_cast<int>(fit.x.size())};
  const std::vector<Free> factor = {
      {.name = "factor", .lower = 0.5, .upper = 2, .low = 0.8, .high = 1.25, .logarithmic = true}};
  const std::size_t tests = tests_of(bench.data(), Role::calibration).size();
  const auto answers = jobs("friction of each test", tests, [&](std::size_t i) {
    const Objective misfit = [&](std::span<const double> f) {
      Values x = fit.x;
      x.push_back(f[0]);
      const auto r = judge.whitened(i, model, x);
      return std::inner_product(r.begin(), r.end(), r.begin(), 0.0);
    };
    Fitted best{{}, 1e300};
    for (const double start : {0.93, 1.0, 1.07}) {
      const Fitted found = simplex(factor, misfit, {start}, 0.1, budget);
      if (found.score < best.score) best = found;
    }
    return Values{best.x[0], best.score};
  });
  OwnFriction own;
  double mean = 0;
  for (const Values& answer : answers) {
    own.factors.push_back(answer[0]);
    own.misfit += answer[1];
    mean += std::log(answer[0]) / static_cast<double>(tests);
  }
  for (const double f : own.factors)
    own.scatter += std::pow(std::log(f) - mean, 2) / std::max(static_cast<double>(tests) - 1, 1.0);
  own.scatter = std::sqrt(own.scatter);
  return own;
}

}  // namespace freestand::measurement
