#include "measurement/verdict/pair_search.hpp"

#include <algorithm>

#include "measurement/fit/starts.hpp"
#include "measurement/verdict/decide.hpp"

namespace freestand::measurement {

void PairSearch::search_more() {
  if (!more_wanted() || one_is_enough_as_deviated()) return;
  fit_pairs();
  judge();
  if (exchange_in_best_pair()) judge();
  if (fit_parts_of_best_pair()) judge();
  if (best().explained > adequate && !chance_of_misfit_of(best().fit).chance() && look_again()) {
    judge();
    if (fit_parts_of_best_pair()) judge();
  }
  look_for_deviations_of_parts();
  while (add_one_more()) judge();
}

bool PairSearch::one_more_wanted(const Candidate& c) {
  const auto wanted = [&] { return !chance_of_misfit_of(c.fit).chance() || !chance_of_another(c).chance(); };
  return wanted() && (!look_for_deviations(c) || wanted());
}

bool PairSearch::more_wanted() {
  if (tests_ < 4 || kind_of_set(bench_) != Kind::history || only_friction_scatters(out_)) return false;
  if (!effect_may_help(out_) && chance_of_misfit_of(out_.base.fit).chance()) return false;
  return one_more_wanted(best()) || chance_of_misfit_of(best().fit).within_tolerances;
}

bool PairSearch::one_is_enough_as_deviated() {
  out_.deviations_sought = true;
  for (const Candidate* c : singles_by_left_out()) look_for_deviations(*c);
  join_effects_to_faults();
  bool is_enough = false;
  for (const Candidate* c : singles_by_left_out())
    is_enough = is_enough || (chance_of_misfit_of(c->fit).chance() && chance_of_another(*c).chance());
  return is_enough;
}

void PairSearch::join_effects_to_faults() {
  std::vector<const Candidate*> faults;
  std::vector<Candidate*> singles;
  for (Candidate& c : out_.candidates) {
    if (c.laboratory && gains(c.fit.score, out_.base.fit.score)) faults.push_back(&c);
    if (!c.laboratory && c.visible && c.effects.size() == 1) singles.push_back(&c);
  }
  std::stable_sort(faults.begin(), faults.end(),
                   [](const Candidate* a, const Candidate* b) { return a->fit.score < b->fit.score; });
  faults.resize(std::min(faults.size(), options_.fault_seeds));
  std::vector<FitTask> tasks;
  std::vector<Candidate*> of_task;
  for (const Candidate* fault : faults)
    for (Candidate* single : singles) {
      tasks.push_back(task_of_joining(fault->fit, of_catalogue(single->effects[0])));
      of_task.push_back(single);
    }
  auto fits = fit_models(bench_, tasks, quick(), jobs_);
  for (std::size_t i = 0; i < fits.size(); ++i) add_deviation(of_task[i]->effects, std::move(fits[i]));
  std::vector<ModelFit*> enough;
  for (Candidate* single : singles)
    if (!single->fit.left_out_refitted && chance_of_misfit_of(single->fit).chance()) enough.push_back(&single->fit);
  if (enough.empty()) return;
  refine(bench_, enough, options_.effort, jobs_);
  leave_out(enough);
  judge();
}

std::vector<const Candidate*> PairSearch::singles_by_left_out() const {
  std::vector<const Candidate*> order;
  for (const Candidate& c : out_.candidates)
    if (c.visible && c.fit.left_out_refitted && !c.laboratory && c.effects.size() == 1) order.push_back(&c);
  std::stable_sort(order.begin(), order.end(), [](const Candidate* a, const Candidate* b) {
    return a->fit.mean_left_out() < b->fit.mean_left_out();
  });
  return order;
}

bool PairSearch::add_one_more() {
  const Candidate whole = best();
  if (whole.effects.size() < 2 || whole.effects == joined_ || !one_more_wanted(whole)) return false;
  joined_ = whole.effects;
  return join_others_to(whole);
}

bool PairSearch::join_others_to(const Candidate& whole) {
  std::vector<const dynamics::Effect*> others;
  for (const auto* effect : catalogue_)
    if (goes_with(whole.fit.model, *effect) && fewer_numbers_than(tests_, whole.fit.model, *effect))
      others.push_back(effect);
  const std::vector<bool> seen = visible(whole.fit, others);
  std::vector<Candidate> larger;
  std::vector<FitTask> tasks;
  for (std::size_t i = 0; i < others.size(); ++i)
    if (seen[i]) join(whole.effects, whole.fit, *others[i], larger, tasks);
  if (larger.empty()) return false;
  finish_pairs(std::move(larger), tasks);
  return true;
}

void PairSearch::fit_pairs() {
  std::vector<const Candidate*> order = singles_by_left_out();
  order.resize(std::min(order.size(), options_.pair_seeds));
  std::vector<Candidate> pairs;
  std::vector<FitTask> tasks;
  for (const Candidate* seed : order) {
    std::vector<const dynamics::Effect*> others;
    for (const auto* effect : catalogue_)
      if (pairs_.may_be(seed->fit.model, seed->effects[0], *effect)) others.push_back(effect);
    const std::vector<bool> seen = visible(seed->fit, others);
    for (std::size_t i = 0; i < others.size(); ++i)
      if (seen[i] && !pairs_.tried(seed->effects[0], others[i]->name))
        join(seed->effects, seed->fit, *others[i], pairs, tasks);
  }
  finish_pairs(std::move(pairs), tasks);
}

void PairSearch::finish_pairs(std::vector<Candidate> pairs, const std::vector<FitTask>& tasks) {
  auto fits = fit_models(bench_, tasks, quick(), jobs_);
  for (std::size_t i = 0; i < fits.size(); ++i) pairs[i].fit = std::move(fits[i]);
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Candidate& a, const Candidate& b) { return a.fit.score < b.fit.score; });
  pairs.resize(std::min(pairs.size(), options_.pair_finals));
  const std::size_t first = out_.candidates.size();
  for (Candidate& pair : pairs) out_.candidates.push_back(std::move(pair));
  std::vector<ModelFit*> finals;
  for (std::size_t i = first; i < out_.candidates.size(); ++i) finals.push_back(&out_.candidates[i].fit);
  polish(bench_, finals, options_.effort, 0.15, jobs_);
  finish(first);
}

ModelFit PairSearch::part_of(const Candidate& pair, std::size_t which) const {
  const auto& effect = of_catalogue(pair.effects[which]);
  const std::size_t base = base_.free.size(), own = fitted_numbers(effect);
  const auto numbers = [&](Values x) {
    const Values mine(which == 0 ? x.begin() + static_cast<long>(base) : x.end() - static_cast<long>(own), x.end());
    x.resize(base);
    x.insert(x.end(), mine.begin(), mine.begin() + static_cast<long>(own));
    return x;
  };
  ModelFit part{.model = with_effect(base_, effect, bench_.reach()), .x = numbers(pair.fit.x)};
  for (const Values& x : pair.fit.fold_x) part.fold_x.push_back(numbers(x));
  return part;
}

bool PairSearch::exchange_in_best_pair() {
  const Candidate best_pair = best();
  if (best_pair.effects.size() != 2) return false;
  std::vector<Candidate> pairs;
  std::vector<FitTask> tasks;
  for (const std::size_t stays : {0, 1}) {
    const ModelFit part = part_of(best_pair, stays);
    const std::string& name = best_pair.effects[stays];
    std::vector<const dynamics::Effect*> others;
    for (const auto* effect : catalogue_)
      if (!pairs_.tried(name, effect->name) && pairs_.may_be(part.model, name, *effect)) others.push_back(effect);
    const std::vector<bool> seen = visible(part, others);
    for (std::size_t i = 0; i < others.size(); ++i)
      if (seen[i]) join({name}, part, *others[i], pairs, tasks);
  }
  if (pairs.empty()) return false;
  finish_pairs(std::move(pairs), tasks);
  return true;
}

FitTask PairSearch::task_of_joining(const ModelFit& fit, const dynamics::Effect& other) const {
  FitTask task{.model = with_effect(narrowed(fit), other, bench_.reach()), .screened = false};
  task.starts = starts_from({fit.x}, task.model, 24 * fitted_numbers(other));
  return task;
}

void PairSearch::join(const std::vector<std::string>& names, const ModelFit& fit, const dynamics::Effect& other,
                      std::vector<Candidate>& larger, std::vector<FitTask>& tasks) {
  if (names.size() == 1) pairs_.add(names[0], other.name);
  larger.push_back({.effects = names, .fit = fit});
  larger.back().effects.push_back(other.name);
  tasks.push_back(task_of_joining(fit, other));
  tasks.back().known = known_of(fit);
  larger.back().fit.model = tasks.back().model;
}

bool PairSearch::fit_parts_of_best_pair() {
  const Candidate pair = best();
  if (pair.effects.size() != 2) return false;
  std::vector<FitTask> tasks;
  std::vector<Candidate*> singles;
  const std::size_t base = base_.free.size();
  for (Candidate& c : out_.candidates) {
    if (c.effects.size() != 1 || !c.visible) continue;
    const bool first = c.effects[0] == pair.effects[0];
    if (!first && c.effects[0] != pair.effects[1]) continue;
    const ModelFit part = part_of(pair, first ? 0 : 1);
    tasks.push_back({.model = c.fit.model, .starts = {c.fit.x, part.x}, .screened = false, .known = known_of(part)});
    for (std::size_t k = 0; k < part.fold_x.size(); ++k) tasks.back().known[k].push_back(out_.base.fit.fold_x[k]);
    for (Values& end : at_the_ends(c.fit.model, part.x, base)) tasks.back().starts.push_back(std::move(end));
    singles.push_back(&c);
  }
  auto fits = fit_models(bench_, tasks, options_.effort, jobs_);
  std::vector<ModelFit*> better;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (!gains(fits[i].score, singles[i]->fit.score)) continue;
    singles[i]->fit = std::move(fits[i]);
    better.push_back(&singles[i]->fit);
  }
  polish(bench_, better, options_.effort, 0.05, jobs_);
  leave_out(better);
  return !better.empty();
}

void PairSearch::look_for_deviations_of_parts() {
  const Candidate& pair = best();
  if (pair.effects.size() != 2) return;
  for (const std::size_t i : {0, 1}) look_for_deviations_from({pair.effects[i]}, part_of(pair, i));
}

std::vector<FitTask> PairSearch::singles_and_pairs() {
  std::vector<const dynamics::Effect*> seen;
  for (const Candidate& c : out_.candidates)
    if (c.effects.size() == 1 && c.visible && !c.laboratory) seen.push_back(&of_catalogue(c.effects[0]));
  std::vector<FitTask> tasks;
  const auto take = [&](ModelSpec model) {
    tasks.push_back({.model = std::move(model), .screened = false});
    tasks.back().starts = starts_from({Values{}}, tasks.back().model, 16 * tasks.back().model.free.size());
  };
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const ModelSpec single = with_effect(base_, *seen[i], bench_.reach());
    for (std::size_t k = i + 1; k < seen.size(); ++k)
      if (pairs_.may_be(single, seen[i]->name, *seen[k])) take(with_effect(single, *seen[k], bench_.reach()));
    take(single);
  }
  return tasks;
}

bool PairSearch::look_again() {
  const std::vector<FitTask> tasks = singles_and_pairs();
  Effort effort = quick();
  effort.descended = 2 * options_.stride_finals;
  return fit_again_by_strides(tasks, options_.stride_finals, options_.pair_finals, effort);
}

}  // namespace freestand::measurement
