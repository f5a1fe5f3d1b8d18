// Points drawn by importance: see posterior.hpp.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "measurement/fit/posterior.hpp"

namespace freestand::measurement {

// In G over s^2: chance gives a fit that is best no such lead over its neighbours but once in 600.
inline constexpr double told_lead = 10;

// G of points, all at once; an empty point has none.
using Misfits = std::function<std::vector<double>(const std::vector<Values>&)>;

// Fills of_mean, counted and better of a posterior whose dispersion and freedom are known. covariance: of the first points about the
// fit and the step from there, in the cube in which fits move.
void draw_by_importance(const ModelFit&, const Eigen::VectorXd& step, const Eigen::MatrixXd& covariance, const Misfits&,
                        Posterior&);

}  // namespace freestand::measurement
