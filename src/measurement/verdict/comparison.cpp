#include "measurement/verdict/comparison.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/digits.hpp"
#include "measurement/verdict/answers.hpp"

namespace freestand::measurement {
namespace {

std::string lead_of(const Candidate& best, const Candidate& rival) {
  return fmt::format("{} before {}", joined(best.effects), joined(rival.effects));
}

double gain_of_one_number() { return gsl_cdf_chisq_Pinv(1 - chance_level, 1); }

}  // namespace

std::string joined(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " and ")); }

std::string whole(const Candidate& c) { return c.effects.empty() ? "the model as it is" : joined(c.effects); }

bool enough_within_tolerances(const Diagnosis& d, const Candidate& c) {
  const Chance* chance = answer(d, misfit_question, whole(c));
  return chance && chance->within_tolerances;
}

const Candidate* CandidateComparison::find_best() {
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
  return histories_ ? complete_instead_of(best) : best;
}

// What suits the tests best as things are stated need not where they are off, and the right effect may be no better than the base, as they are.
// A complete one comes before more effects and before one that is not enough; before one that is, where that leaves more than chance gives, both
// beside what is stated. (That another is enough may be no more than that the floor's noise turns its histories elsewhere.)
const Candidate* CandidateComparison::complete_instead_of(const Candidate* best) {
  if (!best && !d_.deviations_sought) return best;
  const std::size_t most = best ? best->effects.size() : std::numeric_limits<std::size_t>::max();
  const bool is_enough = best && enough(*best);
  const auto rank = [&](const Candidate* c) { return std::pair(c->effects.size(), ask_.beside(*c)); };
  const Candidate* found = best;
  for (const Candidate& c : d_.candidates) {
    if (&c == best || !fitted_to_the_end(c) || !c.practical || c.laboratory) continue;
    const bool is_simpler = c.effects.size() < most;
    if (!is_simpler && (c.effects.size() > most || (is_enough && !d_.deviations_sought))) continue;
    if (!complete(c) || !(better_than_base(c) || better_beside(c))) continue;
    const bool is_first = found == best && (is_simpler || !is_enough);
    if (is_first || (rank(&c) < rank(found) && (found != best || !by_chance(c, *best)))) found = &c;
  }
  return found;
}

const Candidate* CandidateComparison::least_left_out() const {
  const Candidate* best = nullptr;
  for (const Candidate& c : d_.candidates)
    if (fitted_to_the_end(c) && (!best || left_out(c) < left_out(*best))) best = &c;
  return best;
}

bool CandidateComparison::overtakes(const Candidate& larger, const Candidate& best) {
  if (missed_by(larger) >= missed_by(best) || left_out(larger) >= left_out(best)) return false;
  if (histories_ && larger.effects.size() > best.effects.size())
    if (const Candidate* part = best_part(larger); part && another_is_chance(*part)) return false;
  return !by_chance(larger, best);
}

bool CandidateComparison::complete(const Candidate& c) { return enough(c) && another_is_chance(c); }

bool CandidateComparison::another_is_chance(const Candidate& c) {
  return is_chance(d_, another_question, whole(c), [&] { return ask_.another(c); });
}

const Candidate* CandidateComparison::best_part(const Candidate& whole) const {
  const Candidate* best = nullptr;
  for (const Candidate& c : d_.candidates)
    if (c.visible && c.effects.size() + 1 == whole.effects.size() && is_part(c, whole) &&
        (!best || c.misfit_of_fit < best->misfit_of_fit))
      best = &c;
  return best;
}

void CandidateComparison::mark_rivals(const Candidate& best) {
  for (Candidate& c : d_.candidates)
    c.rival = &c == &best || (c.practical && is_judged(c) && (better_than_base(c) || better_beside(c)) &&
                              c.effects.size() <= best.effects.size() && as_good(best, c));
  drop_needless();
}

std::vector<const Candidate*> CandidateComparison::rivals_by_left_out() const {
  std::vector<const Candidate*> rivals;
  for (const Candidate& c : d_.candidates)
    if (c.rival) rivals.push_back(&c);
  std::stable_sort(rivals.begin(), rivals.end(),
                   [&](const Candidate* a, const Candidate* b) { return left_out(*a) < left_out(*b); });
  return rivals;
}

bool CandidateComparison::enough(const Candidate& c) {
  return leaves_chance(c) || (histories_ && c.explained <= adequate && !c.laboratory && missed_tests(c).empty());
}

std::vector<std::size_t> CandidateComparison::missed_tests(const Candidate& c) const {
  std::vector<std::size_t> missed;
  for (std::size_t i = 0; i < c.misfits_of_fit.size(); ++i)
    if (c.misfits_of_fit[i] > adequate * adequate * d_.samples[i]) missed.push_back(i);
  return missed;
}

bool CandidateComparison::leaves_chance(const Candidate& c) {
  return is_chance(d_, misfit_question, whole(c), [&] { return ask_.enough(c); });
}

bool CandidateComparison::only_near_enough(const Candidate& c) { return histories_ && enough(c) && !leaves_chance(c); }

double CandidateComparison::pooled_left_out(const Candidate& c) const {
  return pooled(bench_, tests_of(bench_.data(), Role::calibration), c.fit.left_out).error;
}

double CandidateComparison::left_out(const Candidate& c) const {
  return d_.friction_scatter > 0 ? c.explained : pooled_left_out(c);
}

bool CandidateComparison::is_ahead(const Candidate& a, const Candidate& b) const {
  return std::stod(three_digits(left_out(a))) < std::stod(three_digits(left_out(b)));
}

bool CandidateComparison::is_missed_like_base(const Candidate& c) const {
  return three_digits(left_out(c)) == three_digits(left_out(d_.base));
}

bool CandidateComparison::as_good(const Candidate& best, const Candidate& rival) {
  if (refuted(best, rival)) return false;
  if (is_ahead(rival, best) || missed_by(rival) <= missed_by(best)) return true;
  if (only_near_enough(best) && only_near_enough(rival)) return true;
  return enough(best) && by_chance(best, rival);
}

bool CandidateComparison::within_tolerances(const Candidate& c) const { return enough_within_tolerances(d_, c); }

// What leaves more than chance of all tests together cannot be the truth, though it may foretell better a test of which no other one tells.
bool CandidateComparison::refuted(const Candidate& best, const Candidate& rival) {
  if (!histories_ || !enough(best)) return false;
  if (within_tolerances(best)) return !enough(rival) || !by_chance(best, rival);
  return !enough(rival) && !by_chance(best, rival);
}

bool CandidateComparison::by_chance(const Candidate& best, const Candidate& rival) {
  return is_chance(d_, lead_question, lead_of(best, rival), [&] { return ask_.lead(best, rival); });
}

std::string CandidateComparison::why_as_good(const Candidate& best, const Candidate& rival) const {
  const std::string name = joined(rival.effects), other = joined(best.effects);
  const Chance* lead = answer(d_, lead_question, lead_of(best, rival));
  if (lead && !lead->apart())
    return fmt::format("{} imitates {} (such tests tell them apart in {:.2g} % of sets, as chance does)", name, other,
                       100 * lead->told_apart);
  if (lead && lead->chance()) return fmt::format("chance may have put {} behind (p {:.2g})", name, lead->p);
  if (is_ahead(rival, best))
    return fmt::format("{} misses the tests left out by less than {}, which fits all tests more closely", name, other);
  if (missed_by(rival) <= missed_by(best)) return fmt::format("{} fits all tests as closely as {}", name, other);
  return fmt::format("{} and {} both leave more than chance, but no more than one reading strays by", other, name);
}

bool CandidateComparison::better_than_base(const Candidate& best) {
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

bool CandidateComparison::better_beside(const Candidate& c) {
  return d_.deviations_sought && !enough(d_.base) && enough(c) && within_tolerances(c) && effect_may_help(d_) &&
         ask_.beside(d_.base) - ask_.beside(c) > gain_of_chance() && !helps_by_luck(c);
}

bool CandidateComparison::helps_by_luck(const Candidate& c) {
  return is_chance(d_, steady_question, whole(c), [&] { return ask_.steady(c); });
}

bool CandidateComparison::was_luck(const Candidate& c) const {
  const Chance* chance = answer(d_, steady_question, whole(c));
  return chance && chance->chance();
}

bool CandidateComparison::brings_nothing(const Candidate& c) const {
  if (!histories_ || within_tolerances(c)) return false;
  double least = d_.base.misfit_of_fit;
  for (const Candidate& part : d_.candidates)
    if (part.visible && is_part(part, c)) least = std::min(least, part.misfit_of_fit);
  return least - c.misfit_of_fit < (c.laboratory ? gain_of_one_number() : gain_of_chance());
}

// Of one number where no effect was tried.
double CandidateComparison::gain_of_chance() const { return help() ? help()->usual : gain_of_one_number(); }

double CandidateComparison::gain_beyond_strays(const std::vector<double>& from, const std::vector<double>& to) const {
  double gain = 0;
  for (std::size_t i = 0; i < to.size(); ++i)
    gain += from[i] > to[i] ? std::max(from[i] - to[i] - d_.strays[i], 0.0) : from[i] - to[i];
  return gain;
}

void CandidateComparison::drop_needless() {
  for (Candidate& c : d_.candidates) {
    if (!c.rival || c.effects.size() < 2) continue;
    for (const Candidate& single : d_.candidates)
      if (single.rival && is_part(single, c) && enough(single)) c.rival = false;
  }
}

}  // namespace freestand::measurement
