#include "measurement/verdict/law_search.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

#include "base/digits.hpp"
#include "measurement/levels.hpp"
#include "measurement/verdict/candidates.hpp"
#include "measurement/verdict/decide.hpp"
#include "measurement/verdict/pair_search.hpp"

namespace freestand::measurement {
namespace {

// By what was asked of the best for the verdict.
bool is_enough_by_chance(const Diagnosis& d) {
  if (!d.best) return false;
  const std::string about = fmt::format("{}", fmt::join(d.candidates[*d.best].effects, " and "));
  return std::any_of(d.chances.begin(), d.chances.end(),
                     [&](const Chance& c) { return c.question == misfit_question && c.about == about && c.chance(); });
}

bool several_are_enough(const Diagnosis& d) {
  return d.verdict == Verdict::missing && is_enough_by_chance(d) && d.candidates[*d.best].effects.size() > 1;
}

class LawSearch : PairSearch {
 public:
  LawSearch(const Bench& bench, const ModelSpec& base, const Catalogue& forms, const DiagnosisOptions& options,
            const Jobs& jobs, Diagnosis& diagnosis)
      : PairSearch(bench, base, forms, options, jobs), diagnosis_(diagnosis) {
    out_.base = diagnosis.base;
    // An effect that is enough only if friction scatters beside it is held against laws that need no scatter.
    if (beside_scatter())
      out_.base.fit.model.friction_of_test.clear();
    else
      out_.friction_scatter = diagnosis.friction_scatter;
  }

  // The base with the friction of each test as it was found beside a law.
  void know(const OwnNumbers& friction) {
    FitTask task{.model = base_, .screened = false};
    task.starts = {out_.base.fit.x};
    out_.base.fit = std::move(fit_models(bench_, {task}, quick(), jobs_)[0]);
    leave_out({&out_.base.fit});
    out_.friction_scatter = friction.scatter;
  }

  // Where no form is enough, nor any effect: the friction of each test, if one is with that.
  std::optional<OwnFriction> friction_beside_a_law() {
    fit_forms();
    if (diagnosis_.verdict != Verdict::unknown || out_.friction_scatter > 0 || chance_of_misfit_of(best().fit).chance())
      return {};
    std::vector<const ModelFit*> fits;
    for (const Candidate& c : out_.candidates)
      if (c.visible) fits.push_back(&c.fit);
    if (fits.empty()) return {};
    OwnFriction own = closest_with_own_friction(fits);
    const double least = std::min(least_misfit(diagnosis_), least_misfit(out_));
    if (!explain_tests(own.of_tests, total(diagnosis_.samples), least)) return {};
    return own;
  }

  void fit_forms() {
    const Singles forms = single_effects();
    fit(forms);
    // Long histories have many valleys beside the one that the law lies in.
    if (!chance_of_misfit_of(best().fit).chance())
      fit_again_by_strides(forms.tasks, forms.tasks.size(), options_.pair_finals, options_.effort);
    judge();
  }

  void propose() {
    if (!forms_may_help()) return;
    // A law of two variables: one form's factor on friction, or force, beside another's.
    const Candidate one = best();
    if (!one.effects.empty() && one_more_wanted(one) && join_others_to(one)) judge();
    const Candidate* form = simplest_that_leads();
    if (!form) return;
    const bool better = better_than_the_catalogue(*form);
    if (!better && !does_for_several(*form)) return;
    if (diagnosis_.verdict == Verdict::unknown && !earns_its_numbers(*form)) return;
    diagnosis_.proposal = *form;
    if (diagnosis_.verdict != Verdict::unknown) withdraw(*form);
    diagnosis_.sentences.push_back(fmt::format(
        "a law of no catalogue does {}: {}; it brings the left-out error from {} to {}{} (proposed_law.yaml, "
        "which `freestand add` takes)",
        better ? "better" : "as well", law_of(*form), three_digits(left_out(out_.base.fit)),
        three_digits(left_out(form->fit)),
        out_.friction_scatter > 0
            ? fmt::format(", friction that differs from test to test by {:.2g} % known", 100 * out_.friction_scatter)
            : ""));
  }

 private:
  bool beside_scatter() const { return diagnosis_.friction_scatter > 0 && base_.friction_of_test.empty(); }

  void withdraw(const Candidate& form) {
    const bool several = several_are_enough(diagnosis_);
    diagnosis_.sentences.insert(
        diagnosis_.sentences.begin(),
        several ? fmt::format("{} together would be enough, with {} numbers; one law does with {}",
                              fmt::join(diagnosis_.effects, " and "),
                              diagnosis_.candidates[*diagnosis_.best].fit.x.size(), form.fit.x.size())
                : fmt::format("{} is not enough: in data made from it{} hardly any misfit is as large",
                              fmt::join(diagnosis_.effects, " or "),
                              beside_scatter() ? ", with friction that scatters," : ""));
    diagnosis_.verdict = Verdict::unknown;
    diagnosis_.reason = several ? Reason::one_law : Reason::none_suffices;
    diagnosis_.effects.clear();
    for (Candidate& c : diagnosis_.candidates) c.rival = false;
  }

  static std::string law_of(const Candidate& c) {
    std::vector<std::string> laws;
    const auto& terms = c.fit.model.effects;
    for (std::size_t i = terms.size() - c.effects.size(); i < terms.size(); ++i) laws.push_back(terms[i].effect->law);
    return fmt::format("{}", fmt::join(laws, " and "));
  }

  bool forms_may_help() {
    std::vector<const ModelFit*> tried;
    for (const Candidate& c : out_.candidates)
      if (c.visible) tried.push_back(&c.fit);
    if (tried.empty()) return false;
    Chance chance = chance_of_gain(bench_, judge_of(out_.base.fit), out_.base.fit, tried, jobs_);
    chance.about = fmt::format("{} forms of laws", tried.size());
    diagnosis_.chances.push_back(chance);
    return !chance.chance();
  }

  bool leads(const Candidate& best, const Candidate& rival) {
    if (best.fit.mean_left_out() >= rival.fit.mean_left_out()) return false;
    Chance chance = chance_of_lead(bench_, judge_of(best.fit), best.fit, rival.fit, jobs_);
    chance.about = fmt::format("{} before {}", fmt::join(best.effects, " and "), fmt::join(rival.effects, " and "));
    diagnosis_.chances.push_back(chance);
    return !chance.chance();
  }

  double left_out(const ModelFit& fit) const {
    return pooled(bench_, tests_of(bench_.data(), Role::calibration), fit.left_out).error;
  }

  // Half of what the base leaves of tests left out, in the mean square, or a part of it in so many of them that it is no chance: where each
  // test differs from the others a law in their stead misses them all the same.
  bool earns_its_numbers(const Candidate& form) const {
    const auto &before = out_.base.fit.left_out, &after = form.fit.left_out;
    if (std::pow(left_out(form.fit), 2) <= std::pow(left_out(out_.base.fit), 2) / 2) return true;
    const Pooled gain = paired_difference(before, after);
    const auto n = static_cast<double>(after.size());
    return n > 1 && gain.error > gsl_cdf_tdist_Pinv(1 - chance_level, n - 1) * gain.standard_error;
  }

  const Candidate* simplest_that_leads() {
    std::vector<const Candidate*> forms;
    for (const Candidate& c : out_.candidates)
      if (c.visible && c.fit.left_out_refitted && c.misfit < out_.base.misfit &&
          left_out(c.fit) < left_out(out_.base.fit) && (!beside_scatter() || c.explained <= adequate))
        forms.push_back(&c);
    std::stable_sort(forms.begin(), forms.end(), [](const Candidate* a, const Candidate* b) {
      return std::pair(a->fit.x.size(), a->misfit) < std::pair(b->fit.x.size(), b->misfit);
    });
    const Candidate* best = nullptr;
    for (const Candidate* form : forms)
      if (!best || leads(*form, *best)) best = form;
    return best;
  }

  bool better_than_the_catalogue(const Candidate& form) {
    const Candidate* known = nullptr;
    for (const Candidate& c : diagnosis_.candidates)
      if (c.visible && c.fit.left_out_refitted && (!known || c.misfit < known->misfit)) known = &c;
    return !known || leads(form, *known);
  }

  bool does_for_several(const Candidate& form) {
    if (!several_are_enough(diagnosis_)) return false;
    const Candidate& several = diagnosis_.candidates[*diagnosis_.best];
    return form.fit.x.size() < several.fit.x.size() && !leads(several, form);
  }

  Diagnosis& diagnosis_;
};

}  // namespace

void propose_law(const Bench& bench, const ModelSpec& base, const std::vector<const dynamics::Effect*>& forms,
                 const DiagnosisOptions& options, const Jobs& jobs, Diagnosis& diagnosis) {
  if (kind_of_set(bench) != Kind::history || diagnosis.reason == Reason::data) return;
  if (diagnosis.verdict == Verdict::none) return;
  if (diagnosis.verdict != Verdict::unknown && is_enough_by_chance(diagnosis) && !several_are_enough(diagnosis)) return;
  ModelSpec from = base;
  if (diagnosis.verdict == Verdict::unknown || several_are_enough(diagnosis))
    from.friction_of_test = diagnosis.base.fit.model.friction_of_test;
  LawSearch search(bench, from, forms, options, jobs, diagnosis);
  const std::optional<OwnFriction> own = search.friction_beside_a_law();
  if (!own) return search.propose();
  from.friction_of_test = own->fit.model.friction_of_test;
  LawSearch again(bench, from, forms, options, jobs, diagnosis);
  again.know(own->of_tests);
  again.fit_forms();
  again.propose();
  if (!diagnosis.proposal) return;
  diagnosis.own_friction = own->of_tests;
  diagnosis.friction_of_base = false;
}

LawBand law_band(const ModelFit& fit, const LawAt& law) {
  LawBand band{law(fit.x), {}, {}};
  const std::size_t places = band.law.size();
  std::vector<double> mean(places, 0), square(places, 0);
  const auto n = static_cast<double>(fit.fold_x.size());
  for (const Values& x : fit.fold_x) {
    const std::vector<double> without = law(x);
    for (std::size_t i = 0; i < places; ++i) mean[i] += without[i] / n, square[i] += without[i] * without[i];
  }
  for (std::size_t i = 0; i < places; ++i) {
    const double spread = n > 1 ? std::sqrt((n - 1) / n * std::max(square[i] - n * mean[i] * mean[i], 0.0)) : 0;
    const double half = n > 1 ? gsl_cdf_tdist_Pinv(0.975, n - 1) * spread : 0;
    band.lower.push_back(band.law[i] - half);
    band.upper.push_back(band.law[i] + half);
  }
  return band;
}

}  // namespace freestand::measurement
