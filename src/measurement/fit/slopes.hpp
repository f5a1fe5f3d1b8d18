// Derivatives of a model's histories in its numbers.
#pragma once

#include "measurement/fit/judge.hpp"

namespace freestand::measurement {

// Of the judge's i-th test: a column for each number, per unit of the cube in which fits move (to_unit), as changes of independent
// numbers of the sensors' noise. `at`: the prediction with x. By differences, inwards where a bound is near.
Eigen::MatrixXd slopes_of(const Judge&, const Test&, std::size_t i, const ModelSpec&, const Values& x,
                          const Prediction& at);

}  // namespace freestand::measurement
