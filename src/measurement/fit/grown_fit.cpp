#include "measurement/fit/grown_fit.hpp"

#include <algorithm>
#include <optional>

#include "measurement/fit/least_squares.hpp"
#include "measurement/fit/outcome_fit.hpp"
#include "measurement/fit/starts.hpp"

namespace freestand::measurement {
namespace {

// The model without its last effect, where that effect's numbers are the last ones; else nothing.
std::optional<ModelSpec> without_last_effect(const ModelSpec& model) {
  if (model.effects.empty()) return {};
  ModelSpec without = model;
  for (const Number& number : model.effects.back().parameters)
    if (number.free >= 0) {
      if (without.free.empty()) return {};
      without.free.pop_back();
    }
  for (const Number& number : model.effects.back().parameters)
    if (number.free >= 0 && static_cast<std::size_t>(number.free) < without.free.size()) return {};
  without.effects.pop_back();
  return without;
}

// Where the fit without the effect stood, and with each of its numbers at the ends of what it may be, with the effect's own numbers all
// over their range: a wall or a tether that few tests reach is met only from there, and a block that slid for want of the effect does
// not rock where its friction stood.
std::vector<Values> starts_with(const ModelFit& before, const ModelSpec& after) {
  const std::size_t known = before.x.size(), own = after.free.size() - known;
  for (std::size_t i = 0; i < known; ++i)
    if (before.model.free[i].name != after.free[i].name) return {};
  std::vector<Values> starts = starts_from({before.x}, after, 96 * own);
  for (Values& x : starts_from(at_the_ends(before.model, before.x, known), after, 32 * own))
    starts.push_back(std::move(x));
  return starts;
}

// The numbers of `before` near where they stand, those of the effect where the tests reach, in so far as the study allows.
ModelSpec near(const ModelFit& before, ModelSpec after, const Reach& reach) {
  narrow(after, before.x, before.x.size());
  const EffectTerm& added = after.effects.back();
  for (std::size_t p = 0; p < added.parameters.size(); ++p) {
    if (added.parameters[p].free < 0) continue;
    Free& free = after.free[static_cast<std::size_t>(added.parameters[p].free)];
    const Free met = free_parameter(*added.effect, added.effect->parameters[p], reach);
    const double low = std::max(free.low, met.low), high = std::min(free.high, met.high);
    if (low >= high) continue;
    free.low = low;
    free.high = high;
    free.landmarks = met.landmarks;
  }
  return after;
}

}  // namespace

ModelFit fit_from(const Bench& bench, const ModelSpec& model, const Values& known, const Jobs& jobs) {
  if (outcomes_only(bench.data())) return fit_outcomes(bench, model, known, {}, jobs);
  Effort effort;
  effort.screened_per_number = 64;
  FitTask task{.model = model};
  if (!known.empty()) task.starts = {known};
  auto fits = fit_models(bench, {task}, effort, jobs);
  polish(bench, {&fits[0]}, effort, 0.05, jobs);
  settle(bench, fits[0], effort, jobs);
  return std::move(fits[0]);
}

ModelFit fit_with_effect(const Bench& bench, const ModelFit& before, const ModelSpec& after, const Jobs& jobs) {
  if (outcomes_only(bench.data())) return fit_outcomes(bench, after, {}, {}, jobs);
  Effort effort;
  effort.screened_per_number = 256;
  effort.starts = 6;
  auto fits = fit_models(bench, {{.model = after, .starts = starts_with(before, after)}}, effort, jobs);
  polish(bench, {&fits[0]}, effort, 0.15, jobs);
  refine(bench, {&fits[0]}, effort, jobs);
  settle(bench, fits[0], effort, jobs);
  return std::move(fits[0]);
}

ModelFit grown_fit(const Bench& bench, const ModelSpec& model, const Jobs& jobs) {
  const auto without = without_last_effect(model);
  if (!without || without->free.size() == model.free.size() || outcomes_only(bench.data()))
    return fit_from(bench, model, {}, jobs);
  const ModelFit before = grown_fit(bench, *without, jobs);
  return fit_with_effect(bench, before, near(before, model, bench.reach()), jobs);
}

}  // namespace freestand::measurement
