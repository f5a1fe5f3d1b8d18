// Free numbers, and the search for their best values. The error is not smooth (a slip that begins or not, an impact more or less), so no method with
// derivatives: points of a Sobol sequence are screened, and from the best few of them the simplex method of Nelder and
// Mead goes down (GSL's nmsimplex2), once more from where it stopped with a fresh, smaller simplex.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace freestand::measurement {

// A number that a fit may choose. A start lies within [low, high]; the answer within [lower, upper].
struct Free {
  std::string name;  // dotted, as in the study: friction.mu, effects.floor_tilt.angle_rad
  std::string unit = {};
  double lower = 0, upper = 0;
  double low = 0, high = 0;
  bool logarithmic = false;            // spread starts and steps over the logarithm
  std::vector<double> landmarks = {};  // values that the measurements themselves point to
};

// Free numbers <-> the unit cube between low and high, in which fits move; logarithmic ones by their logarithm.
double to_unit(const Free&, double x);
double from_unit(const Free&, double z);  // kept within [lower, upper]

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
