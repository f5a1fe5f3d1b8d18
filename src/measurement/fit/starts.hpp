// Points from which the fit of an effect starts, and at which one looks whether the tests can see it. The error surface
// has many valleys, and a model without the effect may have been led far astray: a block whose impacts lose more than
// Housner's is fitted best by one that slides, and there no impact is left to be seen.
#pragma once

#include "measurement/fit/model_fit.hpp"

namespace freestand::measurement {

// The first so many numbers of a model, but those of effects, start near where they stand in x: effects that are joined
// move them, but not anywhere.
void narrow(ModelSpec&, const Values& x, std::size_t numbers);

// The model with the ranges that its fit starts in: the numbers of the base that it grew from near `known`, where that is
// not empty; those of the effects that were joined to the base as far as these tests reach.
ModelSpec within_reach(const ModelSpec&, const ModelSpec& base, const Values& known, const Reach&);

// x with each of its first `numbers` in turn at either end of its range (friction at its upper end: nothing slips).
std::vector<Values> at_the_ends(const ModelSpec&, const Values& x, std::size_t numbers);

// The fit's numbers, and these at the ends.
std::vector<Values> vantage_points(const ModelFit&);

// Of a model that ends in the numbers of one more effect: each of the vantage points of the fit without it, with the
// effect's own numbers at `count` points of their range.
std::vector<Values> starts_from(const std::vector<Values>& vantage, const ModelSpec& with_effect, std::size_t count);

// Points of the whole range that the study allows.
std::vector<Values> starts_anywhere(const ModelSpec&, std::size_t per_number);

// The fit without the effect, with the effect at nothing.
Values start_at_nothing(const ModelFit&, const dynamics::Effect&);

// The tests' scores at a point change by more than this in the sum of logarithms where an effect is seen.
inline constexpr double seen_change = 1e-3;

// Does the effect change any prediction, anywhere in its range, from one of these points of the rest of the model?
bool changes_predictions(const Bench&, const ModelFit&, const std::vector<Values>& vantage, const dynamics::Effect&);

}  // namespace freestand::measurement
