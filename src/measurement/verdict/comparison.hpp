// How candidates stand to the base and to one another: by their errors, and by what simulations answer where errors do not say it.
#pragma once

#include <string>
#include <vector>

#include "measurement/verdict/answers.hpp"
#include "measurement/verdict/decide.hpp"

namespace freestand::measurement {

std::string joined(const std::vector<std::string>& words);
// All effects of a candidate, as a question names them.
std::string whole(const Candidate&);
// Was it found enough, and only where something that the laboratory states is off within its tolerances?
bool enough_within_tolerances(const Diagnosis&, const Candidate&);

class CandidateComparison {
 public:
  CandidateComparison(const Bench& bench, Diagnosis& d, const Questions& ask)
      : bench_(bench), d_(d), ask_(ask), histories_(kind_of_set(bench) == Kind::history) {}

 protected:
  // Of those that do better than the base. The simplest first: of each number of effects, those with numbers as met in practice, then those without; and of these the
  // ones that miss least. Each takes the place of the best so far if it overtakes it.
  const Candidate* find_best();
  const Candidate* least_left_out() const;
  void mark_rivals(const Candidate& best);
  std::vector<const Candidate*> rivals_by_left_out() const;
  // A number that is stated wrongly, and no law that comes near: put right it leaves noise alone.
  bool enough(const Candidate&);
  // Of the calibration tests those of which the fit to all leaves more than one reading strays by: their places among these.
  std::vector<std::size_t> missed_tests(const Candidate&) const;

  // Errors on tests left out [noise units]. Where friction scatters, such a test is missed by what its own friction does: there with that
  // allowed for.
  double pooled_left_out(const Candidate&) const;
  double left_out(const Candidate&) const;
  // By what the table shows of both.
  bool is_ahead(const Candidate& a, const Candidate& b) const;
  // On tests left out, by what the table shows.
  bool is_missed_like_base(const Candidate&) const;
  // A test that alone tells of an effect is missed without it by whatever the fold's fit took instead: how the fits to all
  // tests miss, and what their leads are worth by simulation, says which effect it is.
  double missed_by(const Candidate& c) const { return histories_ ? c.misfit_of_fit : c.fit.mean_left_out(); }
  // None is named alone over one that misses the tests left out by less, by what the table shows of both; nor with a lead
  // that data from the other would give it in more than one set of twenty. But for one that is refuted.
  bool as_good(const Candidate& best, const Candidate& rival);
  // Enough, but only if what the laboratory states is off within its tolerances: so may others be.
  bool within_tolerances(const Candidate&) const;
  // Is the best enough if what the laboratory states is off within its tolerances, and the rival not even then, or behind by more than chance?
  bool refuted(const Candidate& best, const Candidate& rival);
  // Which of these it was that makes the rival as good.
  std::string why_as_good(const Candidate& best, const Candidate& rival) const;
  // More numbers that do not even bring the fitted tests closer than those without them gain nothing on tests left out
  // but by luck: one fit with a test left out stayed where another strayed.
  bool brings_nothing(const Candidate&) const;
  bool was_luck(const Candidate&) const;
  static bool fitted_to_the_end(const Candidate& c) { return c.visible && c.fit.left_out_refitted; }
  const Chance* help() const { return help_of(d_); }
  double samples() const { return total(d_.samples); }

  const Bench& bench_;
  Diagnosis& d_;
  const Questions& ask_;
  bool histories_;

 private:
  // Also by the plain error: a base that strayed after one test that the floor's noise had turned elsewhere looks worse to
  // the covariance of its own replays than it is. And by more than its own replays stray. An effect that one test alone tells of cannot
  // be foretold without it, and gains in the fit to all.
  bool better_than_base(const Candidate&);
  // Where something that is stated is off within its tolerances, in both: the base is not enough even so, this one is, and gains more than chance.
  bool better_beside(const Candidate&);
  const Candidate* complete_instead_of(const Candidate* best);  // null: none does better than the base
  // Its misfit is one that data from itself may have; or not, and its own error no larger than the noise. What is missing from two of the
  // latter may be what the one leads the other by.
  bool leaves_chance(const Candidate&);
  bool only_near_enough(const Candidate&);
  bool overtakes(const Candidate& larger, const Candidate& best);
  // Enough, with no other effect that helps beside it.
  bool complete(const Candidate&);
  bool another_is_chance(const Candidate&);
  // What a candidate would be without one of its effects.
  const Candidate* best_part(const Candidate& whole) const;
  bool by_chance(const Candidate& best, const Candidate& rival);
  bool helps_by_luck(const Candidate&);
  // A pair that holds a rival single effect, which is enough, is no rival of its own.
  void drop_needless();
  bool is_judged(const Candidate& c) const { return fitted_to_the_end(c) && !brings_nothing(c); }
  double gain_of_chance() const;
  double gain_beyond_strays(const std::vector<double>& from, const std::vector<double>& to) const;
};

}  // namespace freestand::measurement
