// From fitted candidates to a verdict.
#pragma once

#include "measurement/diagnose.hpp"

namespace freestand::measurement {

// sqrt(G/samples) above which a model is not at the noise; below which a second effect is not looked for; of a base
// below which nothing is missing whatever fits better.
inline constexpr double at_noise = 1.3, may_be_stuck = 1.05, may_hide_another = 1.015, base_at_noise = 1.01;
// Differences of G that chance makes between two models.
inline constexpr double chance_misfit = 30;

// Paired difference of the left-out scores, a - b, in the mean, and its standard error.
Pooled paired_difference(const std::vector<TestError>& a, const std::vector<TestError>& b);
// Do the numbers that come after the `known` ones lie where they are met in practice?
bool practical(const ModelFit&, std::size_t known);

Kind kind_of_set(const Bench&);  // of its first calibration test

// Fills misfits, explained and delta_bic of base and candidates.
void judge_histories(const Bench&, const Judge&, Diagnosis&, const Jobs&);

// Does a miss the tests left out by more than b, beyond chance? Of paired differences of their scores, Student's t at
// 97.5 %: one that is as good in truth is held to be worse in one set of forty.
bool worse_left_out(const Candidate& a, const Candidate& b);

// Orders the candidates, with the best of them first, and marks their differences to it. none: as they are, of the base.
void put_in_order(const Bench&, const Candidate* best, Diagnosis&);

// Fills verdict, reason, effects, best, rivals, differences, sentences, and orders the candidates.
void decide(const Bench&, Diagnosis&);

}  // namespace freestand::measurement
