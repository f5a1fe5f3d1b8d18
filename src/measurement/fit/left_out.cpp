#include "measurement/fit/left_out.hpp"

#include <algorithm>
#include <numeric>

#include "measurement/fit/least_squares.hpp"
#include "measurement/fit/starts.hpp"

namespace freestand::measurement {
namespace {

using Tests = std::vector<std::size_t>;
constexpr std::size_t per_number = 24, anywhere = 8;  // points looked at for each number
constexpr std::size_t descended = 2;                  // of them
constexpr int rounds = 3;                             // of derivatives
constexpr double missed = 0.02;  // of the mean score, one percent of the error: a search that ends above what is known

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
    if (wide.effects.size() > base.effects.size() && own == fitted_numbers(last_effect(wide)))
      starts.push_back(start_at_nothing({.model = wide, .x = x}, last_effect(wide)));
    if (x.size() != base.free.size()) continue;
    add(starts_from(at_the_ends(wide, x, x.size()), wide, anywhere * own));
    add(starts_anywhere(wide, anywhere));
  }
  return starts;
}

// The fit of one model to the tests of one fold.
class FoldSearch {
 public:
  FoldSearch(const Bench& bench, const ModelSpec& model, const Tests& seen, const Effort& effort)
      : bench_(bench), judge_(bench), model_(model), seen_(seen), effort_(effort) {
    const auto calibration = tests_of(bench.data(), Role::calibration);
    for (const std::size_t i : seen) tests_.push_back(calibration[i]);
  }

  double score(std::span<const double> x) const { return mean_score(bench_, tests_, model_, x); }

  // From the best of these starts downhill.
  Fitted from_best_of(const std::vector<Values>& starts, bool by_strides) const {
    const Measure measure = by_strides ? mean_stride_scores : mean_scores;
    const Objective rough = objective(bench_, model_, tests_, measure);
    const std::vector<double> scores = measure(bench_, tests_, model_, starts);
    Fitted best{{}, 1e300};
    int evaluations = static_cast<int>(starts.size());
    for (const Fitted& start : best_apart(starts, scores, model_.free, descended)) {
      Fitted found = simplex(model_.free, rough, start.x, 0.15, effort_.fold_budget);
      evaluations += found.evaluations;
      if (by_strides) found.score = score(found.x);
      if (found.score < best.score) best = std::move(found);
    }
    best = to_the_bottom(best.x, 0.05);
    best.evaluations += evaluations;
    return best;
  }

  // Of histories by derivatives, which lead to the bottom of bent valleys, as long as a round gains what is worth another.
  Fitted to_the_bottom(const Values& x, double step) const {
    if (kind(bench_.test(tests_.front())) != Kind::history) {
      const Objective plain = [&](std::span<const double> at) { return score(at); };
      return simplex(model_.free, plain, x, step, effort_.fold_budget);
    }
    Fitted best{x, score(x), 1};
    for (int round = 0; round < rounds; ++round) {
      Fitted found = least_squares(judge_, seen_, model_, best.x, 1);
      best.evaluations += found.evaluations + 1;
      found.score = score(found.x);
      const double gain = best.score - found.score;
      if (gain > 0) best.x = std::move(found.x), best.score = found.score;
      if (gain < missed) break;
    }
    return best;
  }

 private:
  const Bench& bench_;
  Judge judge_;
  const ModelSpec& model_;
  const Tests& seen_;
  const Effort& effort_;
  Tests tests_;
};

}  // namespace

void descend_left_out(const Bench& bench, std::vector<ModelFit*> fits, const Effort& effort, const Jobs& jobs) {
  const Refit refit = [&](const ModelFit& fit, std::size_t, const Tests& seen) {
    return FoldSearch(bench, fit.model, seen, effort).to_the_bottom(fit.x, 0.02);
  };
  leave_out(bench, std::move(fits), refit, jobs);
}

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
    const FoldSearch search(bench, near, seen, effort);
    Fitted found = search.from_best_of(starts_of(wide, base, known), fit.by_strides);
    if (found.score <= search.score(fit.x) + missed) return found;
    const Fitted other = search.to_the_bottom(fit.x, 0.02);
    found.evaluations += other.evaluations;
    if (other.score < found.score) found.x = other.x, found.score = other.score;
    return found;
  };
  leave_out(bench, std::move(fits), refit, jobs);
}

}  // namespace freestand::measurement
