#include "measurement/verdict/decide.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/digits.hpp"
#include "measurement/laboratory/laboratory.hpp"
#include "measurement/verdict/answers.hpp"
#include "measurement/verdict/chance_of_peaks.hpp"
#include "measurement/verdict/comparison.hpp"
#include "measurement/verdict/specimens.hpp"

namespace freestand::measurement {
namespace {

class Decision : CandidateComparison {
 public:
  using CandidateComparison::CandidateComparison;

  void take() {
    for (Candidate& c : d_.candidates) c.practical = practical(c.fit, d_.base.fit.x.size());
    std::stable_sort(d_.candidates.begin(), d_.candidates.end(), [](const Candidate& a, const Candidate& b) {
      return a.visible != b.visible ? a.visible : a.fit.mean_left_out() < b.fit.mean_left_out();
    });
    const Candidate* best = find_best();
    if (histories_ && only_friction_scatters(d_)) {
      best = least_left_out();
      friction_scatters();
    } else if (best) {
      const Candidate* chosen = best;
      mark_rivals(*chosen);
      const std::vector<const Candidate*> rivals = rivals_by_left_out();
      const bool suffices =
          enough(*best) || std::any_of(rivals.begin(), rivals.end(), [&](const Candidate* c) { return enough(*c); });
      best = rivals.front();
      const std::string ahead = but_for(*best);
      if (suffices)
        name_rivals(rivals, ahead, *chosen);
      else
        nothing_suffices(*best, ahead);
    } else {
      best = least_left_out();
      nothing_helps(best);
    }
    put_in_order(bench_, best, d_);
  }

 private:
  void say(std::string sentence) { d_.sentences.push_back(std::move(sentence)); }
  std::string scatter_allowed_for() const {
    return d_.friction_scatter > 0 ? fmt::format(" (friction that differs from test to test by {:.2g} % allowed for)",
                                                 100 * d_.friction_scatter)
                                   : "";
  }

  std::string scatter_allowed_for(const Candidate& best) const {
    return fmt::format(
        ", the friction of each test being known (it differs by {:.2g} %; with the floor's noise allowed for, too, "
        "from {} "
        "to {})",
        100 * d_.friction_scatter, three_digits(d_.base.explained), three_digits(best.explained));
  }

  // What does as well as the best one and is not named, with the reason, which stands beside each in the table too.
  std::string but_for(const Candidate& best) {
    std::map<std::string, std::vector<std::string>> told;
    for (Candidate& c : d_.candidates) {
      if (c.rival || !fitted_to_the_end(c) || c.effects == best.effects) continue;
      const bool more = c.effects.size() > best.effects.size();
      const bool odd = !c.practical && !more && !brings_nothing(c);
      if (!(odd && as_good(best, c)) && !is_ahead(c, best)) continue;
      c.remark = odd                       ? odd_numbers
                 : brings_nothing(c)       ? no_closer
                 : was_luck(c)             ? by_luck
                 : refuted(best, c)        ? enough(c) ? further_off : leaves_more
                 : within_tolerances(best) ? more ? stands_for_tolerances : lead_of_tolerances
                 : more                    ? needless_effects
                                           : chance_lead;
      told[c.remark].push_back(fmt::format("{} ({})", joined(c.effects), three_digits(left_out(c))));
    }
    std::string text;
    for (const auto& [remark, names] : told)
      text += fmt::format("{}{}, {}", text.empty() ? ", but for " : "; ", fmt::join(names, ", "), remark);
    return text;
  }
  // The closest fit among those that were not judged on tests left out.
  std::string nothing_gained() const {
    const Candidate* closest = nullptr;
    for (const Candidate& c : d_.candidates)
      if (c.visible && c.fit.score < (closest ? closest->fit.score : d_.base.fit.score)) closest = &c;
    if (!closest) return "no effect lowers the error of the base";
    const auto tests = tests_of(bench_.data(), Role::calibration);
    return fmt::format(
        "no effect lowers the error of the base by enough to be judged on tests left out (the closest fit, "
        "{}, changes it from {} to {})",
        joined(closest->effects), three_digits(pooled(bench_, tests, d_.base.fit.calibration).error),
        three_digits(pooled(bench_, tests, closest->fit.calibration).error));
  }

  // Said where a model that is near enough still leaves more than chance.
  std::string what_remains(const Candidate& c) const {
    const Chance* chance = answer(d_, misfit_question, whole(c));
    if (!chance || chance->chance()) return "";
    return fmt::format(
        "; it still leaves {:.2f} where noise explains 1, more than chance (p {:.2g}), but no more than one reading "
        "strays by",
        c.explained, chance->p);
  }

  // Said where a test that alone tells of an effect is missed without it as before.
  std::string told_by_few(const Candidate& best) const {
    if (!histories_ || !is_missed_like_base(best)) return "";
    return fmt::format(
        " (the fit to all from {:.3g} to {:.3g}, with the floor's noise allowed for: too few tests tell of it for it "
        "to be "
        "foretold without one of them, so repeat these)",
        std::sqrt(d_.base.misfit_of_fit / samples()), std::sqrt(best.misfit_of_fit / samples()));
  }

  // Said where the floor's noise hides the difference.
  std::string floor_noise_allowed_for(const Candidate& best) const {
    if (!histories_ || pooled_left_out(d_.base) > 2 * pooled_left_out(best) || !told_by_few(best).empty()) return "";
    return fmt::format(" (with the floor's noise allowed for, from {} to {})", three_digits(d_.base.explained),
                       three_digits(best.explained));
  }

  // They become the verdict.
  void name_rivals(const std::vector<const Candidate*>& rivals, const std::string& ahead, const Candidate& chosen) {
    std::vector<std::string> told, reasons;
    for (const Candidate* rival : rivals) {
      told.push_back(within_tolerances(*rival)
                         ? joined(rival->effects) + " (with what is stated off within its tolerances)"
                         : fmt::format("{} ({})", joined(rival->effects), three_digits(left_out(*rival))));
      if (rival != &chosen) reasons.push_back(why_as_good(chosen, *rival));
      for (const auto& effect : rival->effects)
        if (!rival->laboratory && std::find(d_.effects.begin(), d_.effects.end(), effect) == d_.effects.end())
          d_.effects.push_back(effect);
    }
    const Candidate& best = *rivals.front();
    const auto within = std::ranges::find_if(rivals, [](const Candidate* c) {
      return c->laboratory && within_tolerance(c->fit.model.free.back(), c->fit.x.back());
    });
    if (d_.effects.empty() && within != rivals.end()) return needs_no_effect(**within);
    d_.verdict = d_.effects.empty() ? Verdict::bad_data : rivals.size() > 1 ? Verdict::ambiguous : Verdict::missing;
    for (const Candidate* rival : rivals)
      if (rival->laboratory)
        say(fmt::format("{}, if {}: check that first",
                        d_.effects.empty() ? "no effect is needed" : "no effect would be needed",
                        fault_sentence(rival->effects[0], rival->fit.x.back())));
    if (d_.verdict == Verdict::bad_data) {
      d_.reason = Reason::data;
      say(fmt::format("with that the left-out error falls from {} to {}", three_digits(pooled_left_out(d_.base)),
                      three_digits(pooled_left_out(best))));
    } else if (rivals.size() > 1)
      say(fmt::format("{} cannot be told apart on these tests (in brackets their errors on tests left out{}): {}{}",
                      joined(told), scatter_allowed_for(), fmt::join(reasons, ", "),
                      ahead.empty() ? "" : "; every other effect misses these tests by more" + ahead));
    else if (within_tolerances(best)) {
      say(fmt::format(
          "{} explains the tests where what is stated is off within its tolerances, and no other effect that "
          "was tried on tests left out does, beyond chance",
          joined(best.effects)));
    } else {
      const bool scatters = d_.friction_scatter > 0, falls = pooled_left_out(best) < pooled_left_out(d_.base);
      const std::string allowed =
          scatters ? falls ? scatter_allowed_for(best) : scatter_allowed_for() : floor_noise_allowed_for(best);
      const auto left = [&](const Candidate& c) {
        return three_digits(scatters && !falls ? left_out(c) : pooled_left_out(c));
      };
      say(fmt::format(
          "with {} the left-out error falls from {} to {}{}; every other effect that was tried on tests left "
          "out misses them by more{}, beyond chance{}",
          joined(best.effects), left(d_.base), left(best), told_by_few(best) + allowed,
          allowed.empty() ? "" : " with that allowed for", ahead + what_remains(best)));
    }
  }

  // What is stated is known to its tolerance alone: a deviation within that is no fault.
  void needs_no_effect(const Candidate& c) {
    d_.verdict = Verdict::none;
    d_.enough_if = fault_sentence(c.effects[0], c.fit.x.back());
    say(fmt::format("no effect is needed: if {}, within its tolerance, the left-out error falls from {} to {}",
                    d_.enough_if, three_digits(pooled_left_out(d_.base)), three_digits(pooled_left_out(c))));
  }

  void friction_scatters() {
    const Candidate* best = nullptr;
    for (const Candidate& c : d_.candidates)
      if (c.visible && !c.laboratory && (!best || c.misfit_of_fit < best->misfit_of_fit)) best = &c;
    const OwnNumbers& own = *d_.own_friction;
    d_.verdict = Verdict::none;
    const auto odd = test_of_other_friction(bench_, own);
    if (odd) say(told(*odd));
    const std::string differs =
        fmt::format("friction differs from test to test by {:.2g} % (standard deviation): ", 100 * own.scatter);
    say(fmt::format("{}with a friction of its own in each test the model leaves {:.2f} where noise explains 1{}",
                    odd ? "" : differs, std::sqrt(own.misfit / samples()),
                    best ? fmt::format(", and the effect that comes closest, {}, leaves {:.2f}", joined(best->effects),
                                       std::sqrt(best->misfit_of_fit / samples()))
                         : ""));
  }

  // Of peaks: how far a model misses tests left out beside what another test of the set tells of them.
  std::string beside_another_test(const Candidate& c) const {
    const double of_another =
        pooled(bench_, tests_of(bench_.data(), Role::calibration), errors_of_another_test(bench_)).error;
    const Chance* chance = answer(d_, misfit_question, whole(c));
    return fmt::format(
        "misses the peaks of tests left out by {} (ln), where one test misses another by {}, more than chance makes (p "
        "{:.2g})",
        three_digits(pooled_left_out(c)), three_digits(of_another), chance ? chance->p : 0);
  }
  static constexpr const char* check_the_tests =
      "check units, dimensions and signs, and which record belongs to which test";

  void nothing_suffices(const Candidate& best, const std::string& ahead) {
    d_.verdict = Verdict::unknown;
    d_.reason = Reason::none_suffices;
    if (!histories_)
      return say(fmt::format("the effect that foretells tests left out best, {}, {}: {}", joined(best.effects),
                             beside_another_test(best), check_the_tests));
    say(
        fmt::format("the effect that foretells tests left out best, {}, still leaves an error of {:.2f} where noise "
                    "explains 1: look at the recovered force, and write its law as a formula{}",
                    joined(best.effects), best.explained,
                    ahead.empty() ? "" : " (every other misses the tests left out by more" + ahead + ")"));
  }

  void nothing_helps(const Candidate* best) {
    if (enough(d_.base)) {
      d_.verdict = Verdict::none;
      const bool gains = help() && !help()->chance();
      say((best ? fmt::format("{}, {}{}, changes the left-out error from {} to {}{})",
                              gains ? "no effect is needed (the one that gains most, and more than chance"
                                    : "no effect beats the base by more than chance (the best",
                              joined(best->effects), best->practical ? "" : fmt::format(", {}", odd_numbers),
                              three_digits(left_out(d_.base)), three_digits(left_out(*best)), scatter_allowed_for())
                : nothing_gained()) +
          what_remains(d_.base));
    } else {
      d_.verdict = Verdict::unknown;
      d_.reason = Reason::none_helps;
      if (!histories_)
        return say(fmt::format("the model {}, and no effect of the catalogue lowers that by more than chance: {}",
                               beside_another_test(d_.base), check_the_tests));
      say(fmt::format(
          "the model misses the measurements by {:.3g} where noise explains 1{}, and no effect of the "
          "catalogue {}{}: look at the recovered force",
          d_.base.explained, in_few_tests(d_.base),
          help() && !help()->chance() ? "predicts the tests left out any better" : "lowers that by more than chance",
          but_by_luck()));
    }
  }

  // Which tests refute a model that is near enough in all others.
  std::string in_few_tests(const Candidate& c) const {
    const std::vector<std::size_t> missed = missed_tests(c), tests = tests_of(bench_.data(), Role::calibration);
    if (missed.empty() || 2 * missed.size() > tests.size()) return "";
    std::vector<std::string> ids;
    double most = 0;
    for (const std::size_t i : missed) {
      ids.push_back(bench_.test(tests[i]).id);
      most = std::max(most, std::sqrt(c.misfits_of_fit[i] / d_.samples[i]));
    }
    return fmt::format(" (in {} alone, by {:.3g}{}: check {} first)", joined(ids), most,
                       missed.size() > 1 ? " at most" : "", missed.size() > 1 ? "these" : "that one");
  }

  // What predicts the tests left out better than the base does, and no effect need be there for that.
  std::string but_by_luck() {
    std::vector<std::string> names;
    for (Candidate& c : d_.candidates)
      if (was_luck(c) && is_ahead(c, d_.base)) {
        c.remark = by_luck;
        names.push_back(fmt::format("{} ({})", joined(c.effects), three_digits(left_out(c))));
      }
    return names.empty() ? "" : fmt::format(", but for {}, {}", fmt::join(names, ", "), by_luck);
  }
};

}  // namespace

bool effect_may_help(const Diagnosis& d) { return !help_of(d) || !help_of(d)->chance(); }

bool only_friction_scatters(const Diagnosis& d) {
  return d.own_friction && d.friction_of_base && explain_tests(*d.own_friction, total(d.samples), least_misfit(d));
}

void decide(const Bench& bench, Diagnosis& d, const Questions& ask) { Decision(bench, d, ask).take(); }

}  // namespace freestand::measurement
