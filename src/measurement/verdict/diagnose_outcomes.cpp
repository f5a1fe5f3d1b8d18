#include "measurement/verdict/diagnose_outcomes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "measurement/levels.hpp"
#include "measurement/verdict/chance_of_outcomes.hpp"
#include "measurement/verdict/outcome_screen.hpp"

namespace freestand::measurement {
namespace {

using Catalogue = std::vector<const dynamics::Effect*>;

// -2 ln(likelihood) + k ln n; what happened is held to have at least a chance of a hundredth.
double bic(const ModelFit& fit) {
  double deviance = 0;
  for (const TestError& e : fit.calibration) deviance -= 2 * std::log(std::max(0.01, 1 - std::sqrt(e.score)));
  return deviance + static_cast<double>(fit.x.size()) * std::log(static_cast<double>(fit.calibration.size()));
}

std::string joined(const std::vector<std::string>& words, const char* by) {
  return fmt::format("{}", fmt::join(words, by));
}

class OutcomeDiagnoser {
 public:
  OutcomeDiagnoser(const Bench& bench, const OutcomeEffort& effort, const Jobs& jobs)
      : bench_(bench), effort_(effort), jobs_(jobs), tests_(tests_of(bench.data(), Role::calibration).size()) {}

  Diagnosis run(const ModelSpec& base, const Catalogue& catalogue, const Values& start) {
    out_.base.effects = {};
    base_ = tabulate_outcomes(bench_, base, start, effort_, jobs_);
    out_.base.fit = base_.fit;
    for (const TestError& e : out_.base.fit.calibration)
      out_.noise_floor.push_back(e.probability * (1 - e.probability));
    describe_base();
    join({}, out_.base.fit, catalogue);
    if (const Candidate* best = accepted(out_.base)) {
      const Candidate first = *best;
      join(first.effects, first.fit, catalogue);
      const Candidate* second = accepted(first);
      settle(second ? *second : first, second ? first : out_.base);
    } else {
      nothing_found();
    }
    describe_candidates();
    return std::move(out_);
  }

 private:
  void say(std::string sentence) { out_.sentences.push_back(std::move(sentence)); }
  static double left_out(const Candidate& c) { return c.fit.mean_left_out(); }
  static std::string label(const Candidate& c) { return joined(c.effects, " and "); }

  // Candidates of one effect more than `known`.
  void join(const std::vector<std::string>& known, const ModelFit& without, const Catalogue& catalogue) {
    Catalogue effects;
    for (const auto* effect : catalogue)
      if (goes_with(without.model, *effect) && without.x.size() + fitted_numbers(*effect) < tests_)
        effects.push_back(effect);
      else if (known.empty() && goes_with(without.model, *effect))
        untried_.push_back(effect->name);
    auto screened = screen_outcomes(bench_, without, effects, effort_, jobs_);
    std::vector<OutcomeTable*> promising, others;
    for (Screened& s : screened)
      if (s.visible()) (s.promising() ? promising : others).push_back(&s.table);
    auto fitted = tabulate_outcomes(bench_, without, promising, effort_, jobs_);
    auto read = read_outcomes(bench_, others, jobs_);
    std::size_t next_fitted = 0, next_read = 0;
    for (std::size_t i = 0; i < effects.size(); ++i) {
      const Screened& s = screened[i];
      Candidate c{.effects = known, .fit = without, .visible = s.visible()};
      c.effects.push_back(effects[i]->name);
      c.fit.left_out_refitted = false;
      if (c.visible) {
        if (s.promising())
          c.fit = (tables_[c.effects] = std::move(fitted[next_fitted++])).fit;
        else
          c.fit = std::move(read[next_read++]);
        c.practical = practical(c.fit, without.x.size());
        c.delta_bic = bic(c.fit) - bic(out_.base.fit);
        if (!s.promising())
          c.remark =
              fmt::format("on the {} tests that are least sure it gains {:.4f} +- {:.4f} even where it is fitted",
                          s.table.tests.size(), s.gain, s.gain_se);
      } else {
        c.fit.model = s.table.model;
        c.remark = "it changes no outcome";
      }
      if (known.empty() || c.visible) out_.candidates.push_back(std::move(c));
    }
  }
  const TabulatedFit& table_of(const Candidate& c) const { return c.effects.empty() ? base_ : tables_.at(c.effects); }
  static bool is_rankable(const Candidate& c, std::size_t effects) {
    return c.visible && c.fit.left_out_refitted && c.practical && c.effects.size() == effects;
  }
  bool is_chance(Chance chance, std::string about) {
    chance.about = std::move(about);
    out_.chances.push_back(std::move(chance));
    return out_.chances.back().chance();
  }
  bool enough(const Candidate& c) {
    const OutcomeMisfit misfit = outcome_misfit(bench_, table_of(c));
    misfits_[c.effects] = misfit;
    return is_chance(chance_of_misfit(misfit), c.effects.empty() ? "the model as it is" : label(c));
  }

  // The best candidate of one effect more, if the tests left out are missed by less with it, and any such effect gains more than chance.
  const Candidate* accepted(const Candidate& without) {
    const Candidate* best = nullptr;
    std::vector<const Candidate*> tried;
    std::vector<const TabulatedFit*> tables;
    for (const Candidate& c : out_.candidates)
      if (c.fit.left_out_refitted && c.effects.size() == without.effects.size() + 1) {
        tried.push_back(&c);
        tables.push_back(&table_of(c));
      }
    auto gains = gains_of_outcomes(bench_, table_of(without), tables, jobs_);
    std::vector<Eigen::VectorXf> of_practical;
    for (std::size_t i = 0; i < tried.size(); ++i) {
      if (is_rankable(*tried[i], tried[i]->effects.size())) {
        of_practical.push_back(gains[i]);
        if (!best || left_out(*tried[i]) < left_out(*best)) best = tried[i];
      }
      gains_[tried[i]->effects] = std::move(gains[i]);
    }
    if (!best) return nullptr;
    Chance chance = chance_of_gain_of_outcomes(of_practical);
    if (!without.effects.empty()) chance.question = another_question;
    const bool gained = !is_chance(
        std::move(chance), without.effects.empty() ? fmt::format("{} effects", of_practical.size()) : label(without));
    return gained && left_out(*best) < left_out(without) ? best : nullptr;
  }

  // `without`: what the best was accepted against.
  void settle(const Candidate chosen, const Candidate without) {
    std::vector<const Candidate*> rivals;
    for (Candidate& c : out_.candidates) {
      if (!is_rankable(c, chosen.effects.size()) || left_out(c) >= left_out(without)) continue;
      c.rival = c.effects == chosen.effects ||
                is_chance(chance_of_lead_of_outcomes(bench_, table_of(chosen), table_of(c), jobs_),
                          fmt::format("{} before {}", label(chosen), label(c)));
    }
    put_in_order(bench_, &chosen, out_);
    for (const Candidate& c : out_.candidates)
      if (c.rival) rivals.push_back(&c);
    const Pooled gain = paired_difference(without.fit.left_out, chosen.fit.left_out);
    say(fmt::format("{} lowers the left-out Brier score from {:.4f} to {:.4f}, by {:.4f} +- {:.4f}", label(chosen),
                    left_out(without), left_out(chosen), gain.error, gain.standard_error));
    for (const Candidate* rival : rivals) {
      if (rival->effects == chosen.effects) continue;
      say(fmt::format("{} cannot be told from it on these tests: its left-out score is {:.4f}, {:.4f} +- {:.4f} higher",
                      label(*rival), left_out(*rival), rival->difference, rival->difference_se));
    }
    name_those_ahead(chosen);
    if (std::any_of(rivals.begin(), rivals.end(), [&](const Candidate* c) { return enough(*c); }))
      name_rivals(rivals);
    else
      nothing_suffices(chosen);
  }

  void name_rivals(const std::vector<const Candidate*>& rivals) {
    for (const Candidate* c : rivals)
      for (const auto& effect : c->effects)
        if (std::find(out_.effects.begin(), out_.effects.end(), effect) == out_.effects.end())
          out_.effects.push_back(effect);
    out_.verdict = rivals.size() > 1 ? Verdict::ambiguous : Verdict::missing;
  }

  // The table shows them with less.
  void name_those_ahead(const Candidate& chosen) {
    for (Candidate& c : out_.candidates) {
      if (!c.visible || !c.fit.left_out_refitted || c.rival || left_out(c) >= left_out(chosen)) continue;
      c.remark = !c.practical ? odd_numbers : c.effects.size() > chosen.effects.size() ? needless_effects : chance_lead;
      say(fmt::format("{} leaves a left-out score of {:.4f}, {}", label(c), left_out(c), c.remark));
    }
  }

  void nothing_suffices(const Candidate& chosen) {
    out_.verdict = Verdict::unknown;
    out_.reason = Reason::none_suffices;
    for (Candidate& c : out_.candidates) c.rival = false;
    say(fmt::format("{} is not enough: {}; something more is missing, and it is no effect of the catalogue",
                    label(chosen), what_chance_leaves(misfits_.at(chosen.effects))));
  }

  void nothing_found() {
    const Candidate* best = nullptr;
    for (const Candidate& c : out_.candidates)
      if (c.visible && c.fit.left_out_refitted && (!best || left_out(c) < left_out(*best))) best = &c;
    put_in_order(bench_, best, out_);
    best = best ? &out_.candidates.front() : nullptr;
    if (!enough(out_.base)) {
      out_.verdict = Verdict::unknown;
      out_.reason = Reason::none_helps;
      say(fmt::format("the model is not enough: {}; something is missing, and it is no effect of the catalogue",
                      what_chance_leaves(misfits_.at({}))));
    }
    if (!best) return say("no effect promises to lower the Brier score of the base");
    const Pooled gain = paired_difference(out_.base.fit.left_out, best->fit.left_out);
    say(
        fmt::format("no effect lowers the left-out Brier score by more than chance: the best, {}, changes it from "
                    "{:.4f} to {:.4f}, a gain of {:.4f} +- {:.4f}",
                    label(*best), left_out(out_.base), left_out(*best), gain.error, gain.standard_error));
  }

  void describe_base() {
    const ModelFit& fit = out_.base.fit;
    std::size_t missed = 0;
    for (const TestError& e : fit.calibration) missed += e.score > 0.25;
    const Pooled right = expected_brier(fit.calibration);
    say(
        fmt::format("as it is, the model misses {} of {} tests; Brier score {:.4f}, {:.4f} left out; were its "
                    "probabilities right, chance alone would make {:.4f} +- {:.4f}",
                    missed, tests_, fit.score, fit.mean_left_out(), right.error, right.standard_error));
  }

  void describe_candidates() {
    std::vector<std::string> unseen, unpromising;
    for (const Candidate& c : out_.candidates) {
      if (!c.visible) {
        unseen.push_back(label(c));
        continue;
      }
      if (c.rival || c.effects.size() > 1) continue;
      if (!c.fit.left_out_refitted) {
        unpromising.push_back(label(c));
        continue;
      }
      const Pooled gain = paired_difference(out_.base.fit.left_out, c.fit.left_out);
      const Chance alone = chance_of_gain_of_outcomes({gains_.at(c.effects)});
      say(fmt::format(
          "{} {} the left-out Brier score of the base by {:.4f} +- {:.4f} (were it the only effect tried, "
          "outcomes from the base would give it as much in a share of {:.2g})",
          label(c), gain.error > 0 ? "lowers" : "raises", std::abs(gain.error), gain.standard_error, alone.p));
    }
    if (!unpromising.empty())
      say(fmt::format("not fitted to the end, since even where they were fitted they gained no more than chance: {}",
                      joined(unpromising, ", ")));
    if (!unseen.empty()) say(fmt::format("no outcome depends on {}", joined(unseen, ", ")));
    if (!untried_.empty())
      say(fmt::format("not tried, since they have more numbers than so few tests can fix: {}", joined(untried_, ", ")));
  }

  const Bench& bench_;
  const OutcomeEffort& effort_;
  const Jobs& jobs_;
  std::size_t tests_;
  TabulatedFit base_;
  std::map<std::vector<std::string>, TabulatedFit> tables_;    // of what was fitted to the end
  std::map<std::vector<std::string>, Eigen::VectorXf> gains_;  // of the same, over what they were joined to
  std::map<std::vector<std::string>, OutcomeMisfit> misfits_;  // of what was asked whether it is enough
  std::vector<std::string> untried_;
  Diagnosis out_;
};

}  // namespace

Pooled expected_brier(const std::vector<TestError>& errors) {
  Pooled expected;
  const auto n = static_cast<double>(std::max<std::size_t>(errors.size(), 1));
  for (const TestError& e : errors) {
    const double chance = e.probability * (1 - e.probability);
    expected.error += chance / n;
    expected.standard_error += chance * std::pow(1 - 2 * e.probability, 2);
  }
  expected.standard_error = std::sqrt(expected.standard_error) / n;
  return expected;
}

Diagnosis diagnose_outcomes(const Bench& bench, const ModelSpec& base, const Catalogue& catalogue, const Values& start,
                            const OutcomeEffort& effort, const Jobs& jobs) {
  return OutcomeDiagnoser(bench, effort, jobs).run(base, catalogue, start);
}

}  // namespace freestand::measurement
