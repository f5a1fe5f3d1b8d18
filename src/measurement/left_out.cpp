#include "measurement/left_out.hpp"

#include <algorithm>
#include <numeric>

#include "measurement/least_squares.hpp"
#include "measurement/starts.hpp"

namespace freestand::measurement {
namespace {

using Tests = std::vector<std::size_t>;
constexpr std::size_t per_number = 24, anywhere = 8;  // points looked at for each number
constexpr std::size_t descended = 2;                  // of them

const dynamics::Effect& last_effect(const ModelSpec& model) { return *model.effects.back().effect; }

// Of a model that nothing is known of, points of the whole range. Else those of the effect's own numbers beside what is
// known, the effect at nothing; and of the first effect also beside the base's numbers at their ends, and anywhere.
std::vector<Values> starts_of(const ModelSpec& wide, const ModelSpec& base, const std::vector<Values>& known) {
  if (known.empty()) return starts_anywhere(wide, per_number);
  std::vector<Values> starts;
  const auto add = [&](std::vector<Values> more) { starts.insert(starts.end(), more.begin(), more.end()); };
  for (const Values& x : known) {
    const std::size_t own = wide.free.size() - x.size();
    add(starts_from({x}, wide, std::max<std::size_t>(1, per_number * own)));
    if (own == 0) continue;
    if (own == fitted_numbers(last_effect(wide)))
      starts.push_back(start_at_nothing({.model = wide, .x = x}, last_effect(wide)));
    if (x.size() != base.free.size()) continue;
    add(starts_from(at_the_ends(wide, x, x.size()), wide, anywhere * own));
    add(starts_anywhere(wide, anywhere));
  }
  return starts;
}

// From the best of these starts downhill; of histories at last by derivatives, which lead to the bottom of bent valleys.
Fitted searched(const Bench& bench, const ModelSpec& model, const std::vector<Values>& starts, const Tests& seen,
                bool by_strides, const Effort& effort) {
  const auto calibration = tests_of(bench.data(), Role::calibration);
  Tests tests;
  for (const std::size_t i : seen) tests.push_back(calibration[i]);
  const Objective plain = [&](std::span<const double> x) { return mean_score(bench, tests, model, x); };
  const Objective rough = [&](std::span<const double> x) {
    return by_strides ? mean_stride_score(bench, tests, model, x) : plain(x);
  };
  std::vector<double> scores;
  for (const Values& x : starts) scores.push_back(rough(x));
  Fitted best{{}, 1e300};
  int evaluations = static_cast<int>(starts.size());
  for (const Fitted& start : best_apart(starts, scores, model.free, descended)) {
    Fitted found = simplex(model.free, rough, start.x, 0.15, effort.fold_budget);
    evaluations += found.evaluations;
    if (by_strides) found.score = plain(found.x);
    if (found.score < best.score) best = std::move(found);
  }
  best = simplex(model.free, plain, best.x, 0.05, effort.fold_budget);
  evaluations += best.evaluations;
  if (kind(bench.test(tests.front())) == Kind::history) {
    best = least_squares(Judge(bench), seen, model, best.x, 1);
    evaluations += best.evaluations;
  }
  best.evaluations = evaluations;
  return best;
}

}  // namespace

void search_left_out(const Bench& bench, const ModelSpec& base, std::vector<ModelFit*> fits, const Effort& effort,
                     const Jobs& jobs) {
  const auto calibration = tests_of(bench.data(), Role::calibration);
  const Refit refit = [&](const ModelFit& fit, std::size_t fold, const Tests& seen) {
    Tests tests;
    for (const std::size_t i : seen) tests.push_back(calibration[i]);
    const Reach reach = bench.reach(tests);
    const std::vector<Values> known = fit.known.empty() ? std::vector<Values>{} : fit.known[fold];
    const ModelSpec wide = within_reach(fit.model, base, {}, reach);
    const ModelSpec near = known.empty() ? wide : within_reach(fit.model, base, known.front(), reach);
    return searched(bench, near, starts_of(wide, base, known), seen, fit.by_strides, effort);
  };
  leave_out(bench, std::move(fits), refit, jobs);
}

}  // namespace freestand::measurement
