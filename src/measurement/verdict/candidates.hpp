// Fitted candidates beside one another: their errors on tests left out, their misfits, their order.
#pragma once

#include "measurement/verdict/diagnose.hpp"

namespace freestand::measurement {

// Paired difference of the left-out scores, a - b, in the mean, and its standard error.
Pooled paired_difference(const std::vector<TestError>& a, const std::vector<TestError>& b);
// Do the numbers that come after the `known` ones lie where they are met in practice?
bool practical(const ModelFit&, std::size_t known);
// Are all effects of one among those of the other, which has more?
bool is_part(const Candidate& part, const Candidate& whole);

// Fills misfits, explained and delta_bic of base and candidates.
void judge_histories(const Bench&, const Judge&, Diagnosis&, const Jobs&);

// Of the base and of what was fitted to the end, with the fit to all tests.
double least_misfit(const Diagnosis&);

// Remarks of candidates that do as well as the best one and are not named.
inline constexpr const char
    *odd_numbers = "with numbers that are not met in practice",
    *needless_effects = "with more effects, whose gain may be chance",
    *no_closer = "with numbers that bring the fit to all tests no closer, the floor's noise allowed for",
    *chance_lead = "whose lead may be chance",
    *stands_for_tolerances = "with more effects, whose gain may be that of what is stated, off within its tolerances",
    *lead_of_tolerances = "whose lead may be that of what is stated, off within its tolerances",
    *further_off = "which misses all tests by more, beyond chance, where what is stated is off within its tolerances",
    *leaves_more = "which leaves more than chance even where what is stated is off within its tolerances",
    *by_luck = "by a history that the floor's noise alone turns elsewhere";

// Orders the candidates, with the best of them first, and marks their differences to it. none: as they are, of the base.
void put_in_order(const Bench&, const Candidate* best, Diagnosis&);

}  // namespace freestand::measurement
