#include "measurement/verdict/effect_search.hpp"

#include <algorithm>
#include <cmath>

#include "measurement/fit/least_squares.hpp"
#include "measurement/fit/left_out.hpp"
#include "measurement/fit/starts.hpp"
#include "measurement/fit/strides.hpp"
#include "measurement/laboratory/laboratory.hpp"
#include "measurement/verdict/decide.hpp"

namespace freestand::measurement {
namespace {

// The numbers of a fit in the order of another model that has the same ones; else none.
Values numbers_of(const ModelFit& fit, const ModelSpec& model) {
  Values x;
  for (const Free& free : model.free)
    for (std::size_t i = 0; i < fit.x.size(); ++i)
      if (fit.model.free[i].name == free.name) x.push_back(fit.x[i]);
  return fit.x.size() == model.free.size() ? x : Values{};
}

// Those that the base lacks.
std::vector<std::string> effects_of(const ModelFit& fit, const ModelSpec& base) {
  std::vector<std::string> names;
  for (std::size_t i = base.effects.size(); i < fit.model.effects.size(); ++i)
    names.push_back(fit.model.effects[i].effect->name);
  return names;
}

}  // namespace

Effort EffectSearch::quick() const {
  Effort effort = options_.effort;
  effort.starts = 2;
  return effort;
}

// A fit without a fold is no worse on the tests that it saw than the fit to all, which is the best of all together: so it is no better on
// those left out. What leaves more of the tests that it was fitted to than another leaves of tests left out comes behind that; and where it
// leaves more by as much as a model that is near enough may (levels.hpp), it is no rival, and not searched for anew without each fold.
void EffectSearch::leave_out(std::vector<ModelFit*> fits) {
  const auto search = [&](const std::vector<ModelFit*>& some) {
    search_left_out(bench_, base_, some, options_.effort, jobs_);
  };
  if (fits.size() < 2 || kind_of_set(bench_) != Kind::history) return search(fits);
  std::stable_sort(fits.begin(), fits.end(), [](const ModelFit* a, const ModelFit* b) { return a->score < b->score; });
  search({fits.front()});
  const double least = std::min(fits.front()->mean_left_out(), best().fit.mean_left_out()) + 2 * std::log(adequate);
  const auto behind =
      std::partition_point(fits.begin() + 1, fits.end(), [&](const ModelFit* fit) { return fit->score <= least; });
  search({fits.begin() + 1, behind});
  descend_left_out(bench_, {behind, fits.end()}, options_.effort, jobs_);
}

ModelSpec EffectSearch::narrowed(const ModelFit& fit) const {
  ModelSpec model = fit.model;
  narrow(model, fit.x, model.free.size());
  return model;
}

std::vector<std::vector<Values>> EffectSearch::known_of(const ModelFit& fit) {
  std::vector<std::vector<Values>> known;
  for (const Values& x : fit.fold_x) known.push_back({x});
  return known;
}

std::vector<bool> EffectSearch::visible(const ModelFit& fit,
                                        const std::vector<const dynamics::Effect*>& effects) const {
  const auto vantage = vantage_points(fit);
  const auto answers = jobs_("looking for effects that the tests can see", effects.size(), [&](std::size_t i) {
    return Values{changes_predictions(bench_, fit, vantage, *effects[i]) ? 1.0 : 0.0};
  });
  std::vector<bool> seen;
  for (const Values& answer : answers) seen.push_back(answer[0] > 0);
  return seen;
}

void EffectSearch::finish(std::size_t first) {
  std::vector<ModelFit*> gaining, rest;
  for (std::size_t i = first; i < out_.candidates.size(); ++i) {
    Candidate& c = out_.candidates[i];
    if (c.visible) (gains(c.fit.score, out_.base.fit.score) ? gaining : rest).push_back(&c.fit);
  }
  std::stable_sort(gaining.begin(), gaining.end(),
                   [](const ModelFit* a, const ModelFit* b) { return a->score < b->score; });
  while (gaining.size() > options_.finals) {
    rest.push_back(gaining.back());
    gaining.pop_back();
  }
  refine(bench_, gaining, options_.effort, jobs_);
  leave_out(gaining);
  evaluate(bench_, rest, jobs_);
}

const Candidate& EffectSearch::best() const {
  const Candidate* found = &out_.base;
  for (const Candidate& c : out_.candidates)
    if (c.visible && c.fit.left_out_refitted && c.fit.mean_left_out() < found->fit.mean_left_out()) found = &c;
  return *found;
}

Judge EffectSearch::judge_of(const ModelFit& fit) const { return judge_of(fit.model, fit.x); }

Judge EffectSearch::judge_of(const ModelSpec& model, const Values& x) const {
  return {bench_, model, x, jobs_, every_sample, out_.friction_scatter};
}

Chance EffectSearch::chance_as_stated(const Judge& judge, const ModelFit& fit) const {
  return chance_of_misfit(bench_, judge, fit, total(judge.misfit_of_fit(fit)));
}

Chance EffectSearch::chance_of_misfit_of(const ModelFit& fit) const {
  const Judge judge = judge_of(fit);
  const Chance plain = chance_as_stated(judge, fit);
  if (plain.chance() || fit.model.effects.size() == base_.effects.size()) return plain;
  const Deviated deviated = stated_beside(fit);
  Chance allowed = chance_of_misfit(bench_, deviated.judge, fit, deviated.stated.misfit);
  allowed.within_tolerances = allowed.chance();
  return allowed;
}

EffectSearch::Deviated EffectSearch::stated_beside(const ModelFit& fit) const {
  const std::vector<std::string> effects = effects_of(fit, base_);
  const std::tuple asked(effects, fit.x, out_.friction_scatter);
  if (const auto known = beside_.find(asked); known != beside_.end()) {
    const auto& [first, stated] = known->second;
    return {stated, judge_of(first.model, first.x)};
  }
  const auto found = deviated_.find(effects);
  const AsStated first =
      as_stated(bench_, judge_of(fit), fit, jobs_, found == deviated_.end() ? std::vector<ModelFit>{} : found->second);
  Deviated deviated{{}, judge_of(first.model, first.x)};
  deviated.stated = as_stated(bench_, deviated.judge, fit, jobs_, {{.model = first.model, .x = first.x}});
  beside_.emplace(asked, std::pair(first, deviated.stated));
  return deviated;
}

AsStated EffectSearch::what_suits(const ModelFit& fit) const {
  const auto known = beside_.find({effects_of(fit, base_), fit.x, out_.friction_scatter});
  return known != beside_.end() ? known->second.second : stated_beside(fit).stated;
}

ModelFit EffectSearch::fit_beside(const ModelFit& fit) const {
  AsStated stated = what_suits(fit);
  return {.model = std::move(stated.model), .x = std::move(stated.x)};
}

bool EffectSearch::look_for_deviations(const Candidate& c) {
  if (c.effects.empty() || c.laboratory || deviated_.count(c.effects)) return false;
  return look_for_deviations_from(c.effects, c.fit);
}

bool EffectSearch::look_for_deviations_from(const std::vector<std::string>& effects, const ModelFit& fit) {
  constexpr std::size_t points = 24;  // of each number, as of an effect that joins another
  std::vector<FitTask> tasks;
  for (LaboratoryFault& fault : laboratory_faults(bench_, narrowed(fit), fit.x)) {
    tasks.push_back({.model = std::move(fault.model), .screened = false});
    tasks.back().starts = starts_from({fit.x}, tasks.back().model, points);
  }
  for (ModelFit& found : fit_models(bench_, tasks, quick(), jobs_)) add_deviation(effects, std::move(found));
  return !tasks.empty();
}

void EffectSearch::add_deviation(const std::vector<std::string>& effects, ModelFit found) {
  deviated_[effects].push_back(std::move(found));
  beside_.clear();
}

// Each as it would be at nothing, and as it was fitted beside them where it was.
Chance EffectSearch::chance_of_another(const Candidate& candidate) const {
  const ModelFit& without = candidate.fit;
  std::vector<ModelFit> fits;
  for (const auto* effect : catalogue_)
    if (goes_with(without.model, *effect) && fewer_numbers_than(tests_, without.model, *effect)) {
      ModelFit with{.model = with_effect(without.model, *effect, bench_.reach())};
      with.x = start_at_nothing(without, *effect);
      for (const Candidate& c : out_.candidates)
        if (c.visible && c.effects.size() == candidate.effects.size() + 1)
          if (const Values x = numbers_of(c.fit, with.model); x.size() == with.x.size()) with.x = x;
      fits.push_back(std::move(with));
    }
  std::vector<const ModelFit*> tried;
  for (const ModelFit& fit : fits) tried.push_back(&fit);
  if (tried.empty()) return {.question = another_question, .about = {}};
  const auto [stated, judge] = stated_beside(without);
  Chance chance = chance_of_gain(bench_, judge, without, tried, jobs_, &stated);
  chance.question = another_question;
  return chance;
}

OwnFriction EffectSearch::closest_with_own_friction(const std::vector<const ModelFit*>& fits) const {
  constexpr std::size_t fitted_together = 4;
  std::vector<std::pair<OwnNumbers, const ModelFit*>> held;
  for (const ModelFit* fit : fits) held.emplace_back(own_friction(bench_, judge_of(*fit), *fit, jobs_), fit);
  std::ranges::stable_sort(held, {}, [](const auto& one) { return one.first.misfit; });
  held.resize(std::min(held.size(), fitted_together));
  std::optional<OwnFriction> closest;
  for (const auto& [own, fit] : held) {
    OwnFriction found = fitted_with_own_friction(bench_, judge_of(*fit), *fit, own, jobs_);
    if (!closest || found.of_tests.misfit < closest->of_tests.misfit) closest = std::move(found);
  }
  return *closest;
}

void EffectSearch::judge() {
  if (kind_of_set(bench_) == Kind::history) {
    const Judge judge = judge_of(best().fit);
    std::vector<ModelFit*> fits;
    if (out_.base.fit.left_out_refitted) fits.push_back(&out_.base.fit);
    for (Candidate& c : out_.candidates)
      if (c.visible && c.fit.left_out_refitted) fits.push_back(&c.fit);
    weigh_floor_noise(bench_, judge, fits, jobs_);
    out_.noise_floor = judge.expected();
    judge_histories(bench_, judge, out_, jobs_);
  }
}

const dynamics::Effect& EffectSearch::of_catalogue(const std::string& name) const {
  return **std::find_if(catalogue_.begin(), catalogue_.end(), [&](const auto* effect) { return effect->name == name; });
}

Catalogue EffectSearch::untried() const {
  Catalogue effects;
  for (const auto* effect : catalogue_)
    if (goes_with(base_, *effect) && !tests_can_fix(*effect)) effects.push_back(effect);
  return effects;
}

EffectSearch::Singles EffectSearch::single_effects() {
  std::vector<const dynamics::Effect*> effects;
  for (const auto* effect : catalogue_)
    if (goes_with(base_, *effect) && tests_can_fix(*effect)) effects.push_back(effect);
  const std::vector<bool> seen = visible(out_.base.fit, effects);
  Singles singles;
  const ModelSpec base = narrowed(out_.base.fit);
  for (std::size_t i = 0; i < effects.size(); ++i) {
    Candidate candidate{.effects = {effects[i]->name}, .fit = out_.base.fit, .visible = seen[i]};
    candidate.fit.model = with_effect(base_, *effects[i], bench_.reach());
    out_.candidates.push_back(std::move(candidate));
    if (!seen[i]) continue;
    singles.tasks.push_back({.model = with_effect(base, *effects[i], bench_.reach()),
                             .starts = starts_of(*effects[i], out_.candidates.back().fit.model),
                             .known = known_of(out_.base.fit)});
    singles.places.push_back(out_.candidates.size() - 1);
  }
  return singles;
}

void EffectSearch::fit(const Singles& singles) {
  auto fits = fit_models(bench_, singles.tasks, options_.effort, jobs_);
  for (std::size_t k = 0; k < fits.size(); ++k) out_.candidates[singles.places[k]].fit = std::move(fits[k]);
  finish(0);
}

std::vector<Values> EffectSearch::starts_of(const dynamics::Effect& effect, const ModelSpec& model) const {
  auto starts = starts_anywhere(model, options_.effort.screened_per_number / 2);
  const std::size_t own = fitted_numbers(effect);
  const ModelFit& base = out_.base.fit;
  const auto ends = at_the_ends(base.model, base.x, base.x.size());
  for (Values& x : starts_from({base.x}, model, 48 * own)) starts.push_back(std::move(x));
  for (Values& x : starts_from(ends, model, 16 * own)) starts.push_back(std::move(x));
  starts.push_back(start_at_nothing(base, effect));
  return starts;
}

bool EffectSearch::fit_again_by_strides(const std::vector<FitTask>& tasks, std::size_t by_derivatives,
                                        std::size_t finals, const Effort& effort) {
  auto fits = fit_by_strides(bench_, tasks, by_derivatives, effort, jobs_);
  std::vector<std::size_t> places;
  for (StrideFit& found : fits) {
    if (const auto place = improved(found.fit)) places.push_back(*place);
    if (places.size() == finals) break;
  }
  std::vector<ModelFit*> better;
  for (const std::size_t i : places) better.push_back(&out_.candidates[i].fit);
  refine(bench_, better, options_.effort, jobs_);
  leave_out(better);
  return !better.empty();
}

std::optional<std::size_t> EffectSearch::improved(ModelFit& fit) {
  const std::vector<std::string> effects = effects_of(fit, base_);
  if (!gains(fit.score, out_.base.fit.score)) return {};
  for (std::size_t i = 0; i < out_.candidates.size(); ++i) {
    Candidate& known = out_.candidates[i];
    if (!std::is_permutation(known.effects.begin(), known.effects.end(), effects.begin(), effects.end())) continue;
    if (!gains(fit.score, known.fit.score)) return {};
    known.effects = effects;
    known.fit = std::move(fit);
    return i;
  }
  out_.candidates.push_back({.effects = effects, .fit = std::move(fit)});
  return out_.candidates.size() - 1;
}

}  // namespace freestand::measurement
