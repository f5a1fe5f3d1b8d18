// Where one effect is not enough: pairs of effects, grown from the best single ones, and where these fail from anywhere.
#pragma once

#include "measurement/verdict/effect_search.hpp"
#include "measurement/verdict/pairs.hpp"

namespace freestand::measurement {

class PairSearch : public EffectSearch {
 public:
  PairSearch(const Bench& bench, const ModelSpec& base, const Catalogue& catalogue, const DiagnosisOptions& options,
             const Jobs& jobs)
      : EffectSearch(bench, base, catalogue, options, jobs), pairs_(tests_) {}

 protected:
  // Adds candidates of two effects to those of one, where they are wanted, then of three and more, and judges them.
  void search_more();
  const Pairs& pairs() const { return pairs_; }
  // Not where it is enough once all that is stated was let off within its tolerances.
  bool one_more_wanted(const Candidate&);
  // Each other effect beside those of a candidate. False: none may join, or changes any prediction.
  bool join_others_to(const Candidate& whole);

 private:
  // Is the best candidate not enough as things are stated, or does one more effect help beside it?
  bool more_wanted();
  // Does a single effect explain all where something that is stated is off within its tolerance? The fit of the right one beside a width
  // that is off by a hundredth may be far worse than those of others, as things are stated.
  bool one_is_enough_as_deviated();
  // The base with a fault of the laboratory may come closer than with any effect alone: effects are joined to that.
  void join_effects_to_faults();
  std::vector<const Candidate*> singles_by_left_out() const;  // those that were fitted to the end
  // To the best one of several effects. False: nothing more is wanted or can join, or none of those that joined it has made a better one.
  bool add_one_more();
  void fit_pairs();
  // Fits them, and the best few of them to the end, which become candidates.
  void finish_pairs(std::vector<Candidate> pairs, const std::vector<FitTask>& tasks);
  // The base with one effect of the pair, as they stand in it.
  ModelFit part_of(const Candidate& pair, std::size_t which) const;
  // The seeds of the pairs were the best by themselves, which they need not be beside a second effect: one of the best
  // pair makes way for others that were not yet joined to the one that stays.
  bool exchange_in_best_pair();
  FitTask task_of_joining(const ModelFit&, const dynamics::Effect& other) const;
  void join(const std::vector<std::string>& names, const ModelFit& fit, const dynamics::Effect& other,
            std::vector<Candidate>& larger, std::vector<FitTask>& tasks);
  // Would one of the two do, from where the pair stands? Its own fit may have stuck elsewhere.
  bool fit_parts_of_best_pair();
  // Or with something that is stated off, which the second effect may stand for?
  void look_for_deviations_of_parts();
  // Single effects that the tests can see, and all pairs of them, to be fitted from anywhere.
  std::vector<FitTask> singles_and_pairs();
  // Nothing explains the tests: the effect is of no catalogue, or fits have stuck, or the best single effects, which pairs
  // are joined to, are not those of the pair: two that only do together look useless alone. All once more by strides.
  bool look_again();

  Pairs pairs_;
  std::vector<std::string> joined_;  // effects that all others were joined to last
};

}  // namespace freestand::measurement
