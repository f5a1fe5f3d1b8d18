// Where a fit to histories ends. The simplex stops in long bent valleys, and it knows of the floor's noise nothing: one
// test whose motion that noise turns elsewhere pulls all numbers along. Near the answer the histories are smooth in the
// numbers, so that derivatives serve:
//
//   S(x) = mean over tests of ln(G/n),   G = r^T C^-1 r   (judge.hpp; C = 1 where no replays are given)
//
// is made least by Levenberg and Marquardt's method (GSL's multifit_nlinear) on f = sqrt(n/G0) C^-1/2 r of all tests, G0
// being G where the round began: ln lies below its tangents, so that each round that lowers f^2 lowers S.
#pragma once

#include "measurement/fit/judge.hpp"

namespace freestand::measurement {

// All of its tests.
std::vector<std::size_t> all_of(const Judge&);

// G of these of the judge's tests: the sum of squares of what is fitted.
std::vector<double> misfits(const Judge&, const std::vector<std::size_t>& of_judge, const ModelSpec&,
                            std::span<const double> x);

// S over these of the judge's tests.
double least_squares_score(const Judge&, const std::vector<std::size_t>& of_judge, const ModelSpec&,
                           std::span<const double> x);

// Of S: a round that gains no more is the last. So G of all tests may end above its least by that share of the samples.
inline constexpr double least_gain = 1e-5;

// From x downhill, in at most `rounds`. score: S.
Fitted least_squares(const Judge&, const std::vector<std::size_t>& of_judge, const ModelSpec&, const Values& x,
                     int rounds);

// Of fits that end near the noise: each from where it stands, and without each fold from where that stood, downhill in S by what
// this judge allows the floor's noise, so that rivals are fitted by the misfit that they are judged by. Fits that stay above the
// noise stay where they are: a model that is wrong would only hide behind replays. Errors and intervals as by leave_out().
void weigh_floor_noise(const Bench&, const Judge&, std::vector<ModelFit*>, const Jobs&);

// Each fit from where it stands downhill in S without replays; score is the mean score there.
void descend_by_derivatives(const Bench&, std::vector<ModelFit*>, const Jobs&);

// The fit taken to the least S, at first without replays; then, if that ends at the noise, with replays of the floor's
// noise under the fit itself, without what they fan out. With errors of tests left out, by the same method,
// and intervals that hold all that one number alone may do before G rises by 3.84; far from the noise, before the scores
// of the tests together rise by 0.05. Peaks: leave_out(), and intervals that hold all that one number alone may do before
// the sum of their squares rises by 3.84 times their mean square. Outcomes: leave_out() alone.
void settle(const Bench&, ModelFit&, const Effort&, const Jobs&);

// Intervals of fits to histories or peaks, by the scores as settle() does far from the noise. A jackknife whose refits
// all stay where the fit is has none of its own.
void widen_by_score(const Bench&, std::vector<ModelFit*>, const Jobs&);

}  // namespace freestand::measurement
