// Is a model enough for tests that say only whether the specimen overturned? Of sets of outcomes from the model itself two things are
// asked, each blind to what the other sees: Brier's score, too large where the model is surer than it may be; and how many overturned beside how many
// it expects, to either side, where it is biased (of 40 tests with a chance of 0.35 each, 4 that fell leave a score of 0.15, where chance makes 0.23).
// Each has a p value, the share of the sets with as much, and what counts is the smaller one: p is the share of sets whose own smaller one is as
// small, so that one set in twenty from the model has p <= 0.05, or fewer, since outcomes are steps.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "measurement/levels.hpp"
#include "measurement/search.hpp"

namespace freestand::measurement {

struct OutcomeMisfit {
  double p = 1, of_score = 1, of_count = 1;              // of both together, and of each
  double reached = 1;                                    // the smaller of the two that one set in twenty has
  double score = 0, usual_score = 0, score_scatter = 0;  // Brier's; its mean and standard deviation by chance
  double fell = 0, expected = 0, count_scatter = 0;      // tests; standard deviation of fell less expected by chance

  double smaller() const { return of_score < of_count ? of_score : of_count; }
  bool chance() const { return p > chance_level; }
  // What is beyond chance, one of them at least where p is.
  bool surer() const { return !chance() && (of_score <= chance_level || of_score <= of_count); }
  bool other_count() const { return !chance() && (of_count <= chance_level || of_count < of_score); }
};

inline constexpr std::size_t outcome_simulations = 2000;  // a p value of 0.05 is known to 0.005

// Mean scores, and tests that fell less those expected: of what happened, and behind that of each set. fell: of what happened.
OutcomeMisfit weigh_outcomes(const Eigen::VectorXd& scores, const Eigen::VectorXd& beside, double fell);

// Of probabilities that were not fitted to these tests. by_draw: those of each draw of the model's numbers, of which they are the mean; the
// tests of a set all fall by one draw. Empty: the numbers are known.
OutcomeMisfit outcome_misfit(const Values& probability, const std::vector<bool>& fell,
                             const std::vector<Values>& by_draw = {});

// "it is surer than it may be: ...", or how many fell, or both. Empty where chance explains both.
std::string what_chance_leaves(const OutcomeMisfit&);

}  // namespace freestand::measurement
