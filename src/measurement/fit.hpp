// Fits of free numbers. The error is not smooth (a slip that begins or not, an impact more or less), so no method with
// derivatives: points of a Sobol sequence are screened, and from the best few of them the simplex method of Nelder and
// Mead goes down (GSL's nmsimplex2), once more from where it stopped with a fresh, smaller simplex.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "measurement/model.hpp"

namespace freestand::measurement {

using Values = std::vector<double>;
using Objective = std::function<double(std::span<const double> x)>;

struct Fitted {
  Values x;
  double score = 0;
  int evaluations = 0;
};

// The n-th of the Sobol points in the box between low and high. Same dimension, same points.
std::vector<Values> sobol_starts(const std::vector<Free>&, std::size_t count);

// The best of these points by their scores: at most `keep` of them that lie more than a tenth of the box apart, best
// first.
std::vector<Fitted> best_apart(const std::vector<Values>& points, const std::vector<double>& scores,
                               const std::vector<Free>&, std::size_t keep);

// Downhill from x. step: edge of the first simplex, as a share of the box. At most `budget` evaluations.
Fitted simplex(const std::vector<Free>&, const Objective&, const Values& x, double step, int budget);

}  // namespace freestand::measurement
