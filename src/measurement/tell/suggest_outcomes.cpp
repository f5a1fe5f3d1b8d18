#include "measurement/tell/suggest_outcomes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "measurement/predict/placements.hpp"

namespace freestand::measurement {
namespace {

constexpr std::size_t most_motions = 30;
constexpr double scales[] = {1, -1, 1.25, -1.25, 0.8, -0.8};
constexpr double most_repeats = 1e6;

// Tests from the least sure on.
std::vector<std::size_t> unsure_first(const Bench& bench, const ModelFit& fit) {
  std::vector<std::pair<double, std::size_t>> order;
  const auto tests = tests_of(bench.data(), Role::calibration);
  for (std::size_t t = 0; t < tests.size(); ++t)
    order.emplace_back(std::abs(fit.calibration[t].probability - 0.5), tests[t]);
  std::sort(order.begin(), order.end());
  order.resize(std::min(order.size(), most_motions));
  std::vector<std::size_t> chosen;
  for (const auto& [distance, test] : order) chosen.push_back(test);
  return chosen;
}

// Of the pair of models that is hardest to part: shares of n tests each differ by two of their standard errors.
double repeats(const std::vector<double>& p) {
  double most = 1;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = i + 1; j < p.size(); ++j) {
      const double variance = std::max(0.02, p[i] * (1 - p[i]) + p[j] * (1 - p[j])), apart = std::abs(p[i] - p[j]);
      most = std::max(most, apart > 0 ? std::min(most_repeats, 4 * variance / (apart * apart)) : most_repeats);
    }
  return std::ceil(most);
}

}  // namespace

OutcomeSuggestion suggest_outcomes(const Bench& bench, const std::vector<ModelFit>& models,
                                   const std::vector<std::string>& names, const Jobs& jobs) {
  Dataset planned = bench.data();
  planned.tests.clear();
  for (const std::size_t i : unsure_first(bench, models.front()))
    for (const double scale : scales) {
      planned.tests.push_back(bench.test(i));
      planned.tests.back().scale *= scale;
    }
  const Bench trials(planned, 0);
  const auto answers = jobs("looking for a motion that parts them", trials.size(), [&](std::size_t i) {
    Values probabilities;
    for (const ModelFit& fit : models)
      probabilities.push_back(overturning_probabilities(trials, {i}, fit.model, fit.x).front());
    return probabilities;
  });
  std::size_t best = 0;
  for (std::size_t i = 0; i < answers.size(); ++i)
    if (repeats(answers[i]) < repeats(answers[best])) best = i;
  OutcomeSuggestion s{.test = planned.tests[best].id,
                      .scale = scales[best % std::size(scales)],
                      .probability = answers[best],
                      .repeats = static_cast<int>(repeats(answers[best]))};
  std::vector<std::string> odds;
  for (std::size_t m = 0; m < names.size(); ++m)
    odds.push_back(fmt::format("{:.2f} with {}", s.probability[m], names[m]));
  s.sentence = fmt::format(
      "of the motions at hand the one of test {} times {:.3g}{} parts them best: the probability of overturning is {}; "
      "about {} repeats would do",
      s.test, s.scale, s.scale < 0 ? " (turned round)" : "", fmt::join(odds, ", "), s.repeats);
  return s;
}

}  // namespace freestand::measurement
