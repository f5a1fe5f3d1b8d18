#include "measurement/decide.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "base/digits.hpp"

namespace freestand::measurement {
namespace {

double total(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

// n ln(mean e^2) + k ln n over all samples of the calibration tests.
double bic(const std::vector<double>& samples, const ModelFit& fit) {
  double n = 0, square = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    n += samples[i];
    square += samples[i] * fit.calibration[i].noise_units * fit.calibration[i].noise_units;
  }
  return n * std::log(square / n) + static_cast<double>(fit.x.size()) * std::log(n);
}

class Decision {
 public:
  Decision(const Bench& bench, Diagnosis& d) : bench_(bench), d_(d), histories_(kind_of_set(bench) == Kind::history) {}

  void take() {
    for (Candidate& c : d_.candidates) c.practical = practical(c.fit, d_.base.fit.x.size());
    std::stable_sort(d_.candidates.begin(), d_.candidates.end(), [](const Candidate& a, const Candidate& b) {
      return a.visible != b.visible ? a.visible : a.fit.mean_left_out() < b.fit.mean_left_out();
    });
    const Candidate* best = find_best();
    if (best && better_than_base(*best)) {
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
    return least - c.misfit_of_fit < chance_misfit;
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
  // And so much that b may be named without a: beyond the paired error of the tests left out, at the noise or not.
  bool parted(const Candidate& a, const Candidate& b) const { return worse(a, b) && worse_left_out(a, b); }
  double samples() const { return total(d_.samples); }

  void mark_rivals(const Candidate& best) {
    for (Candidate& c : d_.candidates)
      c.rival = &c == &best || (c.visible && c.fit.left_out_refitted && c.practical && !brings_nothing(c) &&
                                c.effects.size() <= best.effects.size() && !parted(c, best));
    drop_needless();
  }

  // Also by the plain error: a base that strayed after one test that the floor's noise had turned elsewhere looks worse to
  // the covariance of its own replays than it is. And by more than its own replays stray.
  bool better_than_base(const Candidate& best) const {
    return worse(d_.base, best) && (!histories_ || gain_beyond_strays(best) > chance_misfit);
  }

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
        if (std::find(d_.effects.begin(), d_.effects.end(), effect) == d_.effects.end()) d_.effects.push_back(effect);
    }
    const Candidate& best = *rivals.front();
    d_.verdict = rivals.size() > 1 ? Verdict::ambiguous : Verdict::missing;
    if (rivals.size() > 1)
      say(
          fmt::format("{} cannot be told apart on these tests: by their errors on tests left out, in brackets, chance "
                      "may have put either first",
                      joined(told)));
    else
      say(
          fmt::format("{} brings the left-out error from {} to {}; every other effect of those fitted to the end "
                      "misses the tests left out by more, beyond chance{}",
                      joined(best.effects), three_digits(pooled_left_out(d_.base)), three_digits(pooled_left_out(best)),
                      but_for(best)));
    return &best;
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
  bool histories_;
};

}  // namespace

const char* name(Verdict verdict) {
  constexpr const char* names[] = {"none", "missing", "ambiguous", "unknown"};
  return names[static_cast<int>(verdict)];
}

const char* name(Reason reason) {
  constexpr const char* names[] = {"", "data", "none_helps", "none_suffices"};
  return names[static_cast<int>(reason)];
}

Pooled paired_difference(const std::vector<TestError>& a, const std::vector<TestError>& b) {
  const auto n = static_cast<double>(a.size());
  Pooled difference;
  for (std::size_t i = 0; i < a.size(); ++i) difference.error += (a[i].score - b[i].score) / n;
  double variance = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    variance += std::pow(a[i].score - b[i].score - difference.error, 2) / std::max(n - 1, 1.0);
  difference.standard_error = std::sqrt(variance / std::max(n, 1.0));
  return difference;
}

bool worse_left_out(const Candidate& a, const Candidate& b) {
  const Pooled difference = paired_difference(a.fit.left_out, b.fit.left_out);
  const double n = static_cast<double>(a.fit.left_out.size());
  return difference.error > gsl_cdf_tdist_Pinv(0.975, n - 1) * difference.standard_error && difference.error > 1e-9;
}

void put_in_order(const Bench& bench, const Candidate* best, Diagnosis& d) {
  const Candidate reference = best ? *best : d.base;
  const auto tests = tests_of(bench.data(), Role::calibration);
  const auto mark = [&](Candidate& c) {
    const Pooled difference = paired_difference(c.fit.left_out, reference.fit.left_out);
    c.difference = difference.error;
    c.difference_se = difference.standard_error;
  };
  mark(d.base);
  for (Candidate& c : d.candidates) mark(c);
  const auto place = [&](const Candidate& c) {
    const bool to_the_end = c.fit.left_out_refitted;
    return std::tuple(!c.visible, c.effects != reference.effects, !c.rival, !to_the_end,
                      pooled(bench, tests, to_the_end ? c.fit.left_out : c.fit.calibration).error);
  };
  std::stable_sort(d.candidates.begin(), d.candidates.end(),
                   [&](const Candidate& a, const Candidate& b) { return place(a) < place(b); });
  if (best) d.best = 0;
}

bool practical(const ModelFit& fit, std::size_t known) {
  for (std::size_t i = known; i < fit.x.size(); ++i) {
    const Free& free = fit.model.free[i];
    if (free.logarithmic && (fit.x[i] < free.low / 3 || fit.x[i] > 3 * free.high)) return false;
  }
  return true;
}

Kind kind_of_set(const Bench& bench) {
  const auto tests = tests_of(bench.data(), Role::calibration);
  return tests.empty() ? Kind::history : kind(bench.test(tests.front()));
}

void judge_histories(const Bench&, const Judge& judge, Diagnosis& d, const Jobs& jobs) {
  std::vector<Candidate*> all = {&d.base};
  for (Candidate& c : d.candidates) all.push_back(&c);
  d.samples = judge.samples();
  const double n = total(d.samples);
  const double base_bic = bic(d.samples, d.base.fit);
  const auto answers = jobs("judging", all.size(), [&](std::size_t i) {
    if (!all[i]->visible) return Values{};  // never fitted: its numbers are the base's alone
    Values misfits = judge.misfit(all[i]->fit);
    misfits.push_back(total(judge.misfit_of_fit(all[i]->fit)));
    return misfits;
  });
  for (std::size_t i = 0; i < all.size(); ++i) {
    Candidate& c = *all[i];
    if (!c.visible) {
      c.misfits = d.base.misfits;
      c.misfit = d.base.misfit;
      c.misfit_of_fit = d.base.misfit_of_fit;
      c.explained = d.base.explained;
      continue;
    }
    c.misfits.assign(answers[i].begin(), answers[i].end() - 1);
    c.misfit = total(c.misfits);
    c.misfit_of_fit = answers[i].back();
    c.explained = std::sqrt(c.misfit / n);
    c.delta_bic = bic(d.samples, c.fit) - base_bic;
  }
}

void decide(const Bench& bench, Diagnosis& d) { Decision(bench, d).take(); }

}  // namespace freestand::measurement
