#include "measurement/decide.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

#include "base/digits.hpp"
#include "measurement/laboratory.hpp"

namespace freestand::measurement {
namespace {

// Where it was asked whether any effect helps: the answer.
const Chance* help_of(const Diagnosis& d) {
  const auto found =
      std::find_if(d.chances.begin(), d.chances.end(), [](const Chance& c) { return c.question == help_question; });
  return found == d.chances.end() ? nullptr : &*found;
}

class Decision {
 public:
  Decision(const Bench& bench, Diagnosis& d, const Lead& lead)
      : bench_(bench), d_(d), lead_(lead), histories_(kind_of_set(bench) == Kind::history) {}

  void take() {
    for (Candidate& c : d_.candidates) c.practical = practical(c.fit, d_.base.fit.x.size());
    std::stable_sort(d_.candidates.begin(), d_.candidates.end(), [](const Candidate& a, const Candidate& b) {
      return a.visible != b.visible ? a.visible : a.fit.mean_left_out() < b.fit.mean_left_out();
    });
    const Candidate* best = find_best();
    if (histories_ && only_friction_scatters(d_)) {
      friction_scatters();
    } else if (best && better_than_base(*best)) {
      mark_rivals(*best);
      if (good_enough(*best))
        best = name_rivals();
      else
        nothing_suffices(*best);
    } else {
      nothing_helps(best);
    }
    put_in_order(bench_, best, d_);
  }

 private:
  static std::string joined(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, " and "));
  }
  void say(std::string sentence) { d_.sentences.push_back(std::move(sentence)); }
  double pooled_left_out(const Candidate& c) const {
    return pooled(bench_, tests_of(bench_.data(), Role::calibration), c.fit.left_out).error;
  }

  // Effects that do as well as the best one, with numbers three times beyond where they are met.
  std::string but_for(const Candidate& best) const {
    std::vector<std::string> odd;
    for (const Candidate& c : d_.candidates)
      if (c.visible && c.fit.left_out_refitted && !c.practical && c.effects.size() <= best.effects.size() &&
          c.effects != best.effects && !brings_nothing(c) && !parted(c, best))
        odd.push_back(joined(c.effects));
    return odd.empty() ? ""
                       : fmt::format(", but for {} with numbers that are not met in practice", fmt::join(odd, ", "));
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
      if (part.effects.size() < c.effects.size() && part.visible &&
          std::find(c.effects.begin(), c.effects.end(), part.effects[0]) != c.effects.end())
        least = std::min(least, part.misfit_of_fit);
    return least - c.misfit_of_fit < gain_of_chance();
  }

  // Of the candidates, by misfit (histories) or left-out score; simple and practical ones first where the rest cannot be
  // told from them.
  const Candidate* find_best() const {
    const Candidate* best = nullptr;
    for (const Candidate& c : d_.candidates) {
      if (!c.visible || !c.fit.left_out_refitted || brings_nothing(c)) continue;
      if (!best) {
        best = &c;
        continue;
      }
      const double gain = histories_ ? best->misfit - c.misfit : best->fit.mean_left_out() - c.fit.mean_left_out();
      const bool simpler = c.effects.size() < best->effects.size() || (c.practical && !best->practical);
      const bool harder = c.effects.size() > best->effects.size() || (!c.practical && best->practical);
      if (harder ? worse(*best, c) : simpler ? !worse(c, *best) : gain > 0) best = &c;
    }
    return best;
  }

  // By the misfit that allows for the floor's noise: is that of a larger by more than chance?
  bool misfits_more(const Candidate& a, const Candidate& b) const {
    const double left = std::max(0.0, b.misfit - samples() - 3 * std::sqrt(2 * samples()));
    return a.misfit - b.misfit > chance_misfit + 0.5 * left;
  }

  // Is a worse than b? The misfit knows the noise only as it is stated; so of two histories' models that both are at the
  // noise, tests left out must say it too, test by test, and never may their table say the contrary.
  bool worse(const Candidate& a, const Candidate& b) const {
    if (!histories_) return worse_left_out(a, b);
    return misfits_more(a, b) && pooled_left_out(a) > pooled_left_out(b) &&
           (a.explained > std::max(at_noise, 1.1 * b.explained) || worse_left_out(a, b));
  }
  // And so much that b may be named without a: where it is asked, by a lead that data from a would not give it (by_chance);
  // else beyond the paired error of the tests left out, at the noise or not.
  bool parted(const Candidate& a, const Candidate& b) const {
    if (lead_) return (!histories_ || a.misfit > b.misfit) && pooled_left_out(a) > pooled_left_out(b);
    return worse(a, b) && worse_left_out(a, b);
  }
  double samples() const { return total(d_.samples); }

  void mark_rivals(const Candidate& best) {
    for (Candidate& c : d_.candidates)
      c.rival = &c == &best || (c.visible && c.fit.left_out_refitted && c.practical && !brings_nothing(c) &&
                                c.effects.size() <= best.effects.size() && (!parted(c, best) || by_chance(best, c)));
    drop_needless();
  }

  // Would data from the rival give the best its lead in more than one set of twenty?
  bool by_chance(const Candidate& best, const Candidate& rival) {
    if (!lead_ || !good_enough(best)) return false;
    Chance chance = lead_(best, rival);
    chance.about = fmt::format("{} before {}", joined(best.effects), joined(rival.effects));
    d_.chances.push_back(chance);
    return chance.chance();
  }

  // Also by the plain error: a base that strayed after one test that the floor's noise had turned elsewhere looks worse to
  // the covariance of its own replays than it is. And by more than its own replays stray.
  bool better_than_base(const Candidate& best) const {
    if (!help()) return worse(d_.base, best) && (!histories_ || gain_beyond_strays(best) > chance_misfit);
    if (!histories_) return best.fit.mean_left_out() < d_.base.fit.mean_left_out() && !help()->chance();
    return best.misfit < d_.base.misfit && gain_beyond_strays(best) > 0 &&
           (best.laboratory ? d_.base.misfit_of_fit - best.misfit_of_fit > help()->usual : !help()->chance());
  }

  const Chance* help() const { return help_of(d_); }
  double gain_of_chance() const { return help() ? help()->usual : chance_misfit; }

  double gain_beyond_strays(const Candidate& best) const {
    double gain = 0;
    for (std::size_t i = 0; i < best.misfits.size(); ++i) {
      const double here = d_.base.misfits[i] - best.misfits[i];
      gain += here > 0 ? std::max(here - d_.strays[i], 0.0) : here;
    }
    return gain;
  }

  // Beyond what its own replays stray, sensor and floor noise explain the base.
  bool base_at_the_noise() const {
    if (good_enough(d_.base)) return true;
    double beyond = samples();
    for (std::size_t i = 0; i < d_.base.misfits.size(); ++i)
      beyond += std::max(d_.base.misfits[i] - d_.samples[i] - d_.strays[i], 0.0);
    return beyond <= at_noise * at_noise * samples();
  }

  // A pair that holds a rival single effect, which is enough, is no rival of its own.
  void drop_needless() {
    for (Candidate& c : d_.candidates) {
      if (!c.rival || c.effects.size() < 2) continue;
      for (const Candidate& single : d_.candidates)
        if (single.rival && single.effects.size() == 1 && good_enough(single) &&
            std::find(c.effects.begin(), c.effects.end(), single.effects[0]) != c.effects.end())
          c.rival = false;
    }
  }

  bool good_enough(const Candidate& c) const { return !histories_ || c.explained <= at_noise; }

  // Said where the floor's noise hides the difference.
  std::string floor_noise_allowed_for(const Candidate& best) const {
    if (!histories_ || pooled_left_out(d_.base) > 2 * pooled_left_out(best)) return "";
    return fmt::format(" (with the floor's noise allowed for, from {} to {})", three_digits(d_.base.explained),
                       three_digits(best.explained));
  }

  // The rivals become the verdict. Returns the one of least left-out error.
  const Candidate* name_rivals() {
    std::vector<const Candidate*> rivals;
    for (const Candidate& c : d_.candidates)
      if (c.rival) rivals.push_back(&c);
    std::stable_sort(rivals.begin(), rivals.end(),
                     [&](const Candidate* a, const Candidate* b) { return pooled_left_out(*a) < pooled_left_out(*b); });
    std::vector<std::string> told;
    for (const Candidate* rival : rivals) {
      told.push_back(fmt::format("{} ({})", joined(rival->effects), three_digits(pooled_left_out(*rival))));
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
      say(
          fmt::format("{} cannot be told apart on these tests: by their errors on tests left out, in brackets, chance "
                      "may have put either first",
                      joined(told)));
    else
      say(
          fmt::format("{} brings the left-out error from {} to {}{}; every other effect of those fitted to the end "
                      "misses the tests left out by more, beyond chance{}",
                      joined(best.effects), three_digits(pooled_left_out(d_.base)), three_digits(pooled_left_out(best)),
                      floor_noise_allowed_for(best), but_for(best)));
    return &best;
  }

  void friction_scatters() {
    const Candidate* best = nullptr;
    for (const Candidate& c : d_.candidates)
      if (c.visible && !c.laboratory && (!best || c.misfit_of_fit < best->misfit_of_fit)) best = &c;
    const OwnFriction& own = *d_.own_friction;
    d_.verdict = Verdict::none;
    say(fmt::format(
        "friction differs from test to test by {:.2g} % (standard deviation): with a friction of its own in each "
        "test the model leaves {:.2f} where noise explains 1{}",
        100 * own.scatter, std::sqrt(own.misfit / samples()),
        best ? fmt::format(", and the best effect, {}, leaves {:.2f}", joined(best->effects),
                           std::sqrt(best->misfit_of_fit / samples()))
             : ""));
  }

  void nothing_suffices(const Candidate& best) {
    d_.verdict = Verdict::unknown;
    d_.reason = Reason::none_suffices;
    say(
        fmt::format("the best effect, {}, still leaves an error of {:.2f} where noise explains 1: none of the "
                    "catalogue is the one; look at the recovered force, and write its law as a formula",
                    joined(best.effects), best.explained));
  }

  void nothing_helps(const Candidate* best) {
    if (base_at_the_noise()) {
      d_.verdict = Verdict::none;
      say(best ? fmt::format(
                     "no effect beats the base by more than chance (the best, {}, changes the left-out error from "
                     "{:.4g} to {:.4g})",
                     joined(best->effects), pooled_left_out(d_.base), pooled_left_out(*best))
               : nothing_gained());
    } else {
      d_.verdict = Verdict::unknown;
      d_.reason = Reason::none_helps;
      say(
          fmt::format("the model misses the measurements by {:.3g} where noise explains 1, and no effect of the "
                      "catalogue lowers that by more than chance: look at the recovered force",
                      d_.base.explained));
    }
  }

  const Bench& bench_;
  Diagnosis& d_;
  const Lead& lead_;
  bool histories_;
};

}  // namespace

const char* name(Verdict verdict) {
  constexpr const char* names[] = {"none", "missing", "ambiguous", "unknown", "bad_data"};
  return names[static_cast<int>(verdict)];
}

const char* name(Reason reason) {
  constexpr const char* names[] = {"", "data", "none_helps", "none_suffices"};
  return names[static_cast<int>(reason)];
}

bool effect_may_help(const Diagnosis& d) { return !help_of(d) || !help_of(d)->chance(); }

bool only_friction_scatters(const Diagnosis& d) {
  if (!d.own_friction) return false;
  const double n = total(d.samples), own = d.own_friction->misfit;
  double least = d.base.misfit_of_fit;
  for (const Candidate& c : d.candidates)
    if (c.visible && c.fit.left_out_refitted) least = std::min(least, c.misfit_of_fit);
  const auto numbers = static_cast<double>(d.own_friction->factors.size());
  return own <= at_noise * at_noise * n && least - own > gsl_cdf_chisq_Pinv(1 - chance_level, numbers);
}

void decide(const Bench& bench, Diagnosis& d, const Lead& lead) { Decision(bench, d, lead).take(); }

}  // namespace freestand::measurement
