#include "measurement/verdict/chance_of_foretelling.hpp"

#include <cmath>

#include "base/random.hpp"

namespace freestand::measurement {
namespace {

// Mean square of what is between two histories of a test [noise units]; as a model that gives none is scored where either is missing.
double mean_square_between(const Bench& bench, const Prediction& a, const Prediction& b) {
  if (a.failed() || b.failed()) return failed_error * failed_error;
  double sum = 0, count = 0;
  for (int c = 0; c < channel_count; ++c) {
    const auto channel = static_cast<Channel>(c);
    const auto &of_a = a.channel(channel), &of_b = b.channel(channel);
    if (bench.noise(channel) <= 0) continue;
    for (std::size_t k = 0; k < of_a.size(); ++k) sum += std::pow((of_a[k] - of_b[k]) / bench.noise(channel), 2);
    count += static_cast<double>(of_a.size());
  }
  return count > 0 ? sum / count : 0;
}

Chance chance_against(const Bench& bench, const ModelFit& base, const std::function<Values(std::size_t fold)>& numbers,
                      const ModelFit& with, std::size_t tries, const Jobs& jobs) {
  const auto tests = tests_of(bench.data(), Role::calibration);
  const auto folds = fold_of(tests.size());
  // ln D of each history of the base. A measured one would have the sensors' noise beside.
  const auto distances = jobs("how far the base's histories lie", tests.size(), [&](std::size_t i) {
    const Prediction foretold = predict(with.model, bench.test(tests[i]), with.fold_x[folds[i]]);
    Values all;
    predict(bench.replays_asked(base.model, tests[i], numbers(folds[i])), [&](std::size_t, const Prediction& one) {
      all.push_back(std::log(1 + mean_square_between(bench, foretold, one)));
    });
    return all;
  });
  Chance chance{.question = foretelling_question, .about = {}, .tries = tries};
  for (const TestError& left_out : with.left_out) chance.observed -= 2 * std::log(left_out.noise_units);
  weigh(chance, [&](std::uint64_t s) {
    double sum = 0;
    for (std::size_t i = 0; i < distances.size(); ++i)
      if (!distances[i].empty()) sum -= distances[i][random::bits(30, s, i).first % distances[i].size()];
    return sum;
  });
  return chance;
}

}  // namespace

Chance chance_of_foretelling(const Bench& bench, const ModelFit& base, const ModelFit& with, std::size_t tries,
                             const Jobs& jobs) {
  const Chance as_fitted = chance_against(
      bench, base, [&](std::size_t) { return base.x; }, with, tries, jobs);
  const Chance without = chance_against(
      bench, base,
      [&](std::size_t fold) {
        return Values(with.fold_x[fold].begin(), with.fold_x[fold].begin() + static_cast<long>(base.x.size()));
      },
      with, tries, jobs);
  return as_fitted.p > without.p ? as_fitted : without;
}

}  // namespace freestand::measurement
