#include "measurement/verdict/decide.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/digits.hpp"
#include "measurement/laboratory/laboratory.hpp"
#include "measurement/verdict/answers.hpp"

namespace freestand::measurement {
namespace {

class Decision {
 public:
  Decision(const Bench& bench, Diagnosis& d, const Questions& ask)
      : bench_(bench), d_(d), ask_(ask), histories_(kind_of_set(bench) == Kind::history) {}

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
  static std::string joined(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, " and "));
  }
  static std::string whole(const Candidate& c) { return c.effects.empty() ? "the model as it is" : joined(c.effects); }
  void say(std::string sentence) { d_.sentences.push_back(std::move(sentence)); }
  double pooled_left_out(const Candidate& c) const {
    return pooled(bench_, tests_of(bench_.data(), Role::calibration), c.fit.left_out).error;
  }

  // Where friction scatters, a test left out is missed by what its own friction does: there with that allowed for.
  double left_out(const Candidate& c) const { return d_.friction_scatter > 0 ? c.explained : pooled_left_out(c); }
  std::string scatter_allowed_for() const {
    return d_.friction_scatter > 0 ? fmt::format(" (friction that differs from test to test by {:.2g} % allowed for)",
                                                 100 * d_.friction_scatter)
                                   : "";
  }

  // What does as well as the best one and is not named, with the reason, which stands beside each in the table too.
  std::string but_for(const Candidate& best) {
    std::map<std::string, std::vector<std::string>> told;
    for (Candidate& c : d_.candidates) {
      if (c.rival || !fitted_to_the_end(c) || c.effects == best.effects) continue;
      const bool odd = !c.practical && c.effects.size() <= best.effects.size() && !brings_nothing(c);
      if (odd ? !as_good(best, c) : !is_ahead(c, best)) continue;
      c.remark = odd ? odd_numbers : brings_nothing(c) ? no_closer : was_luck(c) ? by_luck : needless_effects;
      told[c.remark].push_back(fmt::format("{} ({})", joined(c.effects), three_digits(left_out(c))));
    }
    std::string text;
    for (const auto& [remark, names] : told)
      text += fmt::format("{}{}, {}", text.empty() ? ", but for " : "; ", fmt::join(names, ", "), remark);
    return text;
  }
  // By what the table shows of both.
  bool is_ahead(const Candidate& a, const Candidate& b) const {
    return std::stod(three_digits(left_out(a))) < std::stod(three_digits(left_out(b)));
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

  // More numbers that do not even bring the fitted tests closer than those without them gain nothing on tests left out
  // but by luck: one fit with a test left out stayed where another strayed.
  bool brings_nothing(const Candidate& c) const {
    if (!histories_) return false;
    double least = d_.base.misfit_of_fit;
    for (const Candidate& part : d_.candidates)
      if (part.visible && is_part(part, c)) least = std::min(least, part.misfit_of_fit);
    return least - c.misfit_of_fit < (c.laboratory ? gain_of_one_number() : gain_of_chance());
  }
  static bool fitted_to_the_end(const Candidate& c) { return c.visible && c.fit.left_out_refitted; }
  bool is_judged(const Candidate& c) const { return fitted_to_the_end(c) && !brings_nothing(c); }
  // A test that alone tells of an effect is missed without it by whatever the fold's fit took instead: how the fits to all
  // tests miss, and what their leads are worth by simulation, says which effect it is.
  double missed_by(const Candidate& c) const { return histories_ ? c.misfit_of_fit : c.fit.mean_left_out(); }

  // Of those that do better than the base. The simplest first: of each number of effects, those with numbers as met in practice, then those without; and of these the
  // ones that miss least. Each takes the place of the best so far if it overtakes it.
  const Candidate* find_best() {
    std::vector<const Candidate*> order;
    for (const Candidate& c : d_.candidates)
      if (is_judged(c)) order.push_back(&c);
    const auto kind = [](const Candidate* c) { return std::pair(c->effects.size(), !c->practical); };
    std::stable_sort(order.begin(), order.end(), [&](const Candidate* a, const Candidate* b) {
      return std::pair(kind(a), missed_by(*a)) < std::pair(kind(b), missed_by(*b));
    });
    const Candidate* best = nullptr;
    for (const Candidate* c : order)
      if (better_than_base(*c) && (!best || overtakes(*c, *best))) best = c;
    return best;
  }

  const Candidate* least_left_out() const {
    const Candidate* best = nullptr;
    for (const Candidate& c : d_.candidates)
      if (fitted_to_the_end(c) && (!best || left_out(c) < left_out(*best))) best = &c;
    return best;
  }

  bool overtakes(const Candidate& larger, const Candidate& best) {
    if (missed_by(larger) >= missed_by(best) || left_out(larger) >= left_out(best)) return false;
    if (histories_ && larger.effects.size() > best.effects.size()) {
      const Candidate* part = best_part(larger);
      if (part && is_chance(d_, another_question, whole(*part), [&] { return ask_.another(*part); })) return false;
    }
    return !by_chance(larger, best);
  }

  // What a candidate would be without one of its effects.
  const Candidate* best_part(const Candidate& whole) const {
    const Candidate* best = nullptr;
    for (const Candidate& c : d_.candidates)
      if (c.visible && c.effects.size() + 1 == whole.effects.size() && is_part(c, whole) &&
          (!best || c.misfit_of_fit < best->misfit_of_fit))
        best = &c;
    return best;
  }

  double samples() const { return total(d_.samples); }

  void mark_rivals(const Candidate& best) {
    for (Candidate& c : d_.candidates)
      c.rival = &c == &best || (c.practical && is_judged(c) && better_than_base(c) &&
                                c.effects.size() <= best.effects.size() && as_good(best, c));
    drop_needless();
  }

  // None is named alone over one that misses the tests left out by less, by what the table shows of both; nor with a lead
  // that data from the other would give it in more than one set of twenty.
  bool as_good(const Candidate& best, const Candidate& rival) {
    if (is_ahead(rival, best) || missed_by(rival) <= missed_by(best)) return true;
    return enough(best) && (by_chance(best, rival) || (within_tolerances(best) && enough(rival)));
  }
  // Enough, but only if what the laboratory states is off within its tolerances: so may others be.
  bool within_tolerances(const Candidate& c) const {
    const Chance* chance = answer(d_, misfit_question, whole(c));
    return chance && chance->within_tolerances;
  }

  bool by_chance(const Candidate& best, const Candidate& rival) {
    return is_chance(d_, lead_question, lead_of(best, rival), [&] { return ask_.lead(best, rival); });
  }
  static std::string lead_of(const Candidate& best, const Candidate& rival) {
    return fmt::format("{} before {}", joined(best.effects), joined(rival.effects));
  }
  // Which of these it was that makes the rival as good.
  std::string why_as_good(const Candidate& best, const Candidate& rival) const {
    const std::string name = joined(rival.effects), other = joined(best.effects);
    const Chance* lead = answer(d_, lead_question, lead_of(best, rival));
    if (lead && !lead->apart())
      return fmt::format("{} imitates {} (such tests tell them apart in {:.2g} % of sets, as chance does)", name, other,
                         100 * lead->told_apart);
    if (lead && lead->chance()) return fmt::format("chance may have put {} behind (p {:.2g})", name, lead->p);
    if (is_ahead(rival, best))
      return fmt::format("{} misses the tests left out by less than {}, which fits all tests more closely", name,
                         other);
    if (missed_by(rival) <= missed_by(best)) return fmt::format("{} fits all tests as closely as {}", name, other);
    return fmt::format("{} is enough as well if what is stated is off within its tolerances", name);
  }

  // Also by the plain error: a base that strayed after one test that the floor's noise had turned elsewhere looks worse to
  // the covariance of its own replays than it is. And by more than its own replays stray. An effect that one test alone tells of cannot
  // be foretold without it, and gains in the fit to all.
  bool better_than_base(const Candidate& best) {
    if (!histories_) return left_out(best) < left_out(d_.base) && help() && !help()->chance();
    const bool foretold = left_out(best) < left_out(d_.base) && best.misfit < d_.base.misfit &&
                          gain_beyond_strays(d_.base.misfits, best.misfits) > 0;
    const bool told_by_one =
        is_missed_like_base(best) && gain_beyond_strays(d_.base.misfits_of_fit, best.misfits_of_fit) > gain_of_chance();
    if (!foretold && !told_by_one) return false;
    const bool gains = d_.base.misfit_of_fit - best.misfit_of_fit > gain_of_chance();
    // What is stated wrongly is one of few, and takes a model to the noise that is refuted as it stands: it need not also gain more than
    // the effects do in data that fan out.
    if (best.laboratory) return (gains || !enough(d_.base)) && enough(best);
    return (help() ? !help()->chance() : gains) && !helps_by_luck(best);
  }
  bool helps_by_luck(const Candidate& c) {
    return is_chance(d_, steady_question, whole(c), [&] { return ask_.steady(c); });
  }
  bool was_luck(const Candidate& c) const {
    const Chance* chance = answer(d_, steady_question, whole(c));
    return chance && chance->chance();
  }
  // On tests left out, by what the table shows.
  bool is_missed_like_base(const Candidate& c) const {
    return three_digits(left_out(c)) == three_digits(left_out(d_.base));
  }
  const Chance* help() const { return help_of(d_); }
  static double gain_of_one_number() { return gsl_cdf_chisq_Pinv(1 - chance_level, 1); }
  double gain_of_chance() const { return help() ? help()->usual : gain_of_one_number(); }  // no effect was tried

  double gain_beyond_strays(const std::vector<double>& from, const std::vector<double>& to) const {
    double gain = 0;
    for (std::size_t i = 0; i < to.size(); ++i)
      gain += from[i] > to[i] ? std::max(from[i] - to[i] - d_.strays[i], 0.0) : from[i] - to[i];
    return gain;
  }

  // A pair that holds a rival single effect, which is enough, is no rival of its own.
  void drop_needless() {
    for (Candidate& c : d_.candidates) {
      if (!c.rival || c.effects.size() < 2) continue;
      for (const Candidate& single : d_.candidates)
        if (single.rival && is_part(single, c) && enough(single)) c.rival = false;
    }
  }

  // A number that is stated wrongly, and no law that comes near: put right it leaves noise alone.
  bool enough(const Candidate& c) {
    return !histories_ || is_chance(d_, misfit_question, whole(c), [&] { return ask_.enough(c); }) ||
           (c.explained <= adequate && !c.laboratory);
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

  std::vector<const Candidate*> rivals_by_left_out() const {
    std::vector<const Candidate*> rivals;
    for (const Candidate& c : d_.candidates)
      if (c.rival) rivals.push_back(&c);
    std::stable_sort(rivals.begin(), rivals.end(),
                     [&](const Candidate* a, const Candidate* b) { return left_out(*a) < left_out(*b); });
    return rivals;
  }

  // They become the verdict.
  void name_rivals(const std::vector<const Candidate*>& rivals, const std::string& ahead, const Candidate& chosen) {
    std::vector<std::string> told, reasons;
    for (const Candidate* rival : rivals) {
      told.push_back(fmt::format("{} ({})", joined(rival->effects), three_digits(left_out(*rival))));
      if (rival != &chosen) reasons.push_back(why_as_good(chosen, *rival));
      for (const auto& effect : rival->effects)
        if (!rival->laboratory && std::find(d_.effects.begin(), d_.effects.end(), effect) == d_.effects.end())
          d_.effects.push_back(effect);
    }
    const Candidate& best = *rivals.front();
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
    else {
      const std::string allowed = d_.friction_scatter > 0 ? scatter_allowed_for() : floor_noise_allowed_for(best);
      say(fmt::format(
          "with {} the left-out error falls from {} to {}{}; every other effect of those fitted to the end "
          "misses the tests left out by more{}, beyond chance{}",
          joined(best.effects), three_digits(left_out(d_.base)), three_digits(left_out(best)),
          told_by_few(best) + allowed, allowed.empty() ? "" : " with that allowed for", ahead + what_remains(best)));
    }
  }

  void friction_scatters() {
    const Candidate* best = nullptr;
    for (const Candidate& c : d_.candidates)
      if (c.visible && !c.laboratory && (!best || c.misfit_of_fit < best->misfit_of_fit)) best = &c;
    const OwnNumbers& own = *d_.own_friction;
    d_.verdict = Verdict::none;
    say(fmt::format(
        "friction differs from test to test by {:.2g} % (standard deviation): with a friction of its own in each "
        "test the model leaves {:.2f} where noise explains 1{}",
        100 * own.scatter, std::sqrt(own.misfit / samples()),
        best ? fmt::format(", and the effect that comes closest, {}, leaves {:.2f}", joined(best->effects),
                           std::sqrt(best->misfit_of_fit / samples()))
             : ""));
  }

  void nothing_suffices(const Candidate& best, const std::string& ahead) {
    d_.verdict = Verdict::unknown;
    d_.reason = Reason::none_suffices;
    say(
        fmt::format("the effect that foretells tests left out best, {}, still leaves an error of {:.2f} where noise "
                    "explains 1: look at the recovered force, and write its law as a formula{}",
                    joined(best.effects), best.explained,
                    ahead.empty() ? "" : " (every other misses the tests left out by more" + ahead + ")"));
  }

  void nothing_helps(const Candidate* best) {
    if (enough(d_.base)) {
      d_.verdict = Verdict::none;
      const bool gains = histories_ && help() && !help()->chance();
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
      say(fmt::format(
          "the model misses the measurements by {:.3g} where noise explains 1, and no effect of the "
          "catalogue {}{}: look at the recovered force",
          d_.base.explained,
          help() && !help()->chance() ? "predicts the tests left out any better" : "lowers that by more than chance",
          but_by_luck()));
    }
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

  const Bench& bench_;
  Diagnosis& d_;
  const Questions& ask_;
  bool histories_;
};

}  // namespace

bool effect_may_help(const Diagnosis& d) { return !help_of(d) || !help_of(d)->chance(); }

bool only_friction_scatters(const Diagnosis& d) {
  return d.own_friction && d.friction_of_base && explain_tests(*d.own_friction, total(d.samples), least_misfit(d));
}

void decide(const Bench& bench, Diagnosis& d, const Questions& ask) { Decision(bench, d, ask).take(); }

}  // namespace freestand::measurement
