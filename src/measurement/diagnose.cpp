#include "measurement/diagnose.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <limits>
#include <optional>

#include "measurement/decide.hpp"
#include "measurement/diagnose_outcomes.hpp"
#include "measurement/left_out.hpp"
#include "measurement/outcome_fit.hpp"
#include "measurement/pairs.hpp"
#include "measurement/starts.hpp"
#include "measurement/strides.hpp"

namespace freestand::measurement {
namespace {

using Catalogue = std::vector<const dynamics::Effect*>;
constexpr double no_gain = 0.02;  // of the mean score: less is not worth a fit with tests left out

class Diagnoser {
 public:
  Diagnoser(const Bench& bench, const ModelSpec& base, const Catalogue& catalogue, const DiagnosisOptions& options,
            const Jobs& jobs)
      : bench_(bench),
        base_(base),
        catalogue_(catalogue),
        options_(options),
        jobs_(jobs),
        tests_(tests_of(bench.data(), Role::calibration).size()),
        pairs_(tests_) {}

  Diagnosis run() {
    fit_base();
    fit_singles();
    judge();
    if (second_effect_wanted()) {
      fit_pairs();
      judge();
      if (exchange_in_best_pair()) judge();
      if (fit_parts_of_best_pair()) judge();
      if (best().explained > may_be_stuck && look_again()) {
        judge();
        if (fit_parts_of_best_pair()) judge();
      }
    }
    look_for_strays();
    decide(bench_, out_);
    name_untried();
    return std::move(out_);
  }

 private:
  Effort wide() const {
    Effort effort = options_.effort;
    effort.screened_per_number *= 2;
    return effort;
  }

  Effort quick() const {
    Effort effort = options_.effort;
    effort.starts = 2;
    return effort;
  }

  void fit_base() {
    FitTask task{.model = base_};
    if (!options_.start.empty()) task.starts = {options_.start};
    auto fits = fit_models(bench_, {task}, wide(), jobs_);
    polish(bench_, {&fits[0]}, options_.effort, 0.05, jobs_);
    leave_out({&fits[0]});
    out_.base.fit = std::move(fits[0]);
  }

  void leave_out(std::vector<ModelFit*> fits) {
    search_left_out(bench_, base_, std::move(fits), options_.effort, jobs_);
  }

  ModelSpec narrowed(const ModelFit& fit) const {
    ModelSpec model = fit.model;
    narrow(model, fit.x, model.free.size());
    return model;
  }

  // What a model that is joined to this one knows of it without each fold.
  static std::vector<std::vector<Values>> known_of(const ModelFit& fit) {
    std::vector<std::vector<Values>> known;
    for (const Values& x : fit.fold_x) known.push_back({x});
    return known;
  }

  std::vector<bool> visible(const ModelFit& fit, const std::vector<const dynamics::Effect*>& effects) const {
    const auto vantage = vantage_points(fit);
    const auto answers = jobs_("looking for effects that the tests can see", effects.size(), [&](std::size_t i) {
      return Values{changes_predictions(bench_, fit, vantage, *effects[i]) ? 1.0 : 0.0};
    });
    std::vector<bool> seen;
    for (const Values& answer : answers) seen.push_back(answer[0] > 0);
    return seen;
  }

  void fit_singles() {
    std::vector<const dynamics::Effect*> effects;
    for (const auto* effect : catalogue_)
      if (goes_with(base_, *effect) && fewer_numbers_than(tests_, base_, *effect)) effects.push_back(effect);
    const std::vector<bool> seen = visible(out_.base.fit, effects);
    std::vector<FitTask> tasks;
    std::vector<std::size_t> of_task;
    const ModelSpec base = narrowed(out_.base.fit);
    for (std::size_t i = 0; i < effects.size(); ++i) {
      Candidate candidate{.effects = {effects[i]->name}, .fit = out_.base.fit, .visible = seen[i]};
      candidate.fit.model = with_effect(base_, *effects[i], bench_.reach());
      out_.candidates.push_back(std::move(candidate));
      if (!seen[i]) continue;
      tasks.push_back({.model = with_effect(base, *effects[i], bench_.reach()),
                       .starts = starts_of(*effects[i], out_.candidates.back().fit.model),
                       .known = known_of(out_.base.fit)});
      of_task.push_back(i);
    }
    auto fits = fit_models(bench_, tasks, options_.effort, jobs_);
    for (std::size_t k = 0; k < fits.size(); ++k) out_.candidates[of_task[k]].fit = std::move(fits[k]);
    finish(0);
  }

  std::vector<Values> starts_of(const dynamics::Effect& effect, const ModelSpec& model) const {
    auto starts = starts_anywhere(model, options_.effort.screened_per_number / 2);
    const std::size_t own = fitted_numbers(effect);
    const ModelFit& base = out_.base.fit;
    const auto ends = at_the_ends(base.model, base.x, base.x.size());
    for (Values& x : starts_from({base.x}, model, 48 * own)) starts.push_back(std::move(x));
    for (Values& x : starts_from(ends, model, 16 * own)) starts.push_back(std::move(x));
    starts.push_back(start_at_nothing(base, effect));
    return starts;
  }

  void name_untried() {
    std::vector<std::string> names;
    for (const auto* effect : catalogue_)
      if (goes_with(base_, *effect) && !fewer_numbers_than(tests_, base_, *effect)) names.push_back(effect->name);
    if (const auto& pairs = pairs_.refused(); !pairs.empty())
      names.push_back(fmt::format("{} pair{}, as {} with {}", pairs.size(), pairs.size() == 1 ? "" : "s",
                                  pairs.begin()->first, pairs.begin()->second));
    if (!names.empty())
      out_.sentences.push_back(
          fmt::format("not tried, since they have more numbers than so few tests can fix: {}", fmt::join(names, ", ")));
  }

  // Polishes and leaves out, for the best candidates from `first` on that gain anything on the base.
  void finish(std::size_t first) {
    std::vector<ModelFit*> gaining, rest;
    for (std::size_t i = first; i < out_.candidates.size(); ++i) {
      Candidate& c = out_.candidates[i];
      if (c.visible) (c.fit.score < out_.base.fit.score - no_gain ? gaining : rest).push_back(&c.fit);
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

  const Candidate& best() const {
    const Candidate* found = &out_.base;
    for (const Candidate& c : out_.candidates)
      if (c.visible && c.fit.left_out_refitted && c.fit.mean_left_out() < found->fit.mean_left_out()) found = &c;
    return *found;
  }

  void judge() {
    if (kind_of_set(bench_) == Kind::history) {
      const ModelFit& reference = best().fit;
      const Judge judge(bench_, reference.model, reference.x, jobs_);
      out_.noise_floor = judge.expected();
      judge_histories(bench_, judge, out_, jobs_);
    }
  }

  void look_for_strays() {
    if (kind_of_set(bench_) != Kind::history) return;
    out_.strays = Judge(bench_, out_.base.fit.model, out_.base.fit.x, jobs_).strays();
  }

  bool second_effect_wanted() const {
    if (tests_ < 4 || kind_of_set(bench_) != Kind::history) return false;
    const double at = best().explained, base = out_.base.explained;
    return base > base_at_noise && at > may_hide_another;
  }

  void fit_pairs() {
    std::vector<const Candidate*> order;
    for (const Candidate& c : out_.candidates)
      if (c.visible && c.fit.left_out_refitted) order.push_back(&c);
    std::stable_sort(order.begin(), order.end(), [](const Candidate* a, const Candidate* b) {
      return a->fit.mean_left_out() < b->fit.mean_left_out();
    });
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
          join(seed->effects[0], seed->fit, *others[i], pairs, tasks);
    }
    finish_pairs(std::move(pairs), tasks);
  }

  // Fits them, and the best few of them to the end, which become candidates.
  void finish_pairs(std::vector<Candidate> pairs, const std::vector<FitTask>& tasks) {
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

  // The base with one effect of the pair, as they stand in it.
  ModelFit part_of(const Candidate& pair, std::size_t which) const {
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

  // The seeds of the pairs were the best by themselves, which they need not be beside a second effect: one of the best
  // pair makes way for others that were not yet joined to the one that stays.
  bool exchange_in_best_pair() {
    const Candidate best_pair = best();
    if (best_pair.effects.size() < 2) return false;
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
        if (seen[i]) join(name, part, *others[i], pairs, tasks);
    }
    if (pairs.empty()) return false;
    finish_pairs(std::move(pairs), tasks);
    return true;
  }

  void join(const std::string& name, const ModelFit& fit, const dynamics::Effect& other, std::vector<Candidate>& pairs,
            std::vector<FitTask>& tasks) {
    pairs_.add(name, other.name);
    pairs.push_back({.effects = {name, other.name}, .fit = fit});
    tasks.push_back({.model = with_effect(narrowed(fit), other, bench_.reach())});
    tasks.back().starts = starts_from({fit.x}, tasks.back().model, 24 * fitted_numbers(other));
    tasks.back().screened = false;
    tasks.back().known = known_of(fit);
    pairs.back().fit.model = tasks.back().model;
  }

  // Would one of the two do, from where the pair stands? Its own fit may have stuck elsewhere.
  bool fit_parts_of_best_pair() {
    const Candidate pair = best();
    if (pair.effects.size() < 2) return false;
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
      if (fits[i].score > singles[i]->fit.score - no_gain) continue;
      singles[i]->fit = std::move(fits[i]);
      better.push_back(&singles[i]->fit);
    }
    polish(bench_, better, options_.effort, 0.05, jobs_);
    leave_out(better);
    return !better.empty();
  }

  // Single effects that the tests can see, and all pairs of them, to be fitted from anywhere.
  std::vector<FitTask> singles_and_pairs() {
    std::vector<const dynamics::Effect*> seen;
    for (const Candidate& c : out_.candidates)
      if (c.effects.size() == 1 && c.visible) seen.push_back(&of_catalogue(c.effects[0]));
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

  // Nothing explains the tests: the effect is of no catalogue, or fits have stuck, or the best single effects, which pairs
  // are joined to, are not those of the pair: two that only do together look useless alone. All once more by strides.
  bool look_again() {
    const std::vector<FitTask> tasks = singles_and_pairs();
    Effort effort = quick();
    effort.descended = 2 * options_.stride_finals;
    auto fits = fit_by_strides(bench_, tasks, options_.stride_finals, effort, jobs_);
    std::vector<std::size_t> places;
    for (StrideFit& found : fits) {
      if (const auto place = improved(found.fit)) places.push_back(*place);
      if (places.size() == options_.pair_finals) break;
    }
    std::vector<ModelFit*> better;
    for (const std::size_t i : places) better.push_back(&out_.candidates[i].fit);
    refine(bench_, better, options_.effort, jobs_);
    leave_out(better);
    return !better.empty();
  }

  // Place of the candidate that the fit is better than, or of a new one.
  std::optional<std::size_t> improved(ModelFit& fit) {
    std::vector<std::string> effects;
    for (std::size_t i = base_.effects.size(); i < fit.model.effects.size(); ++i)
      effects.push_back(fit.model.effects[i].effect->name);
    if (fit.score > out_.base.fit.score - no_gain) return {};
    for (std::size_t i = 0; i < out_.candidates.size(); ++i) {
      Candidate& known = out_.candidates[i];
      if (!std::is_permutation(known.effects.begin(), known.effects.end(), effects.begin(), effects.end())) continue;
      if (fit.score > known.fit.score - no_gain) return {};
      known.effects = effects;
      known.fit = std::move(fit);
      return i;
    }
    out_.candidates.push_back({.effects = effects, .fit = std::move(fit)});
    return out_.candidates.size() - 1;
  }

  const dynamics::Effect& of_catalogue(const std::string& name) const {
    return **std::find_if(catalogue_.begin(), catalogue_.end(),
                          [&](const auto* effect) { return effect->name == name; });
  }

  const Bench& bench_;
  const ModelSpec& base_;
  const Catalogue& catalogue_;
  const DiagnosisOptions& options_;
  const Jobs& jobs_;
  std::size_t tests_;
  Pairs pairs_;
  Diagnosis out_;
};

}  // namespace

Diagnosis diagnose(const Bench& bench, const ModelSpec& base, const Catalogue& catalogue,
                   const DiagnosisOptions& options, const Jobs& jobs) {
  const std::size_t tests = tests_of(bench.data(), Role::calibration).size();
  if (tests < 3 || tests <= base.free.size())
    throw Error(
        fmt::format("{} has {} calibration tests for {} numbers to be calibrated (a diagnosis leaves tests out, "
                    "and needs three and more than there are numbers): add tests, or fix numbers",
                    bench.data().name, tests, base.free.size()),
        Exit::data);
  if (outcomes_only(bench.data())) return diagnose_outcomes(bench, base, catalogue, options.start, {}, jobs);
  return Diagnoser(bench, base, catalogue, options, jobs).run();
}

}  // namespace freestand::measurement
