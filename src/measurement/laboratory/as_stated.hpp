// A fitted model beside all that the laboratory may state wrongly: how much of what it misses goes with deviations from that within their
// tolerances (Dataset::tolerance)? A block that rocks tells its width to a ten thousandth, as nobody measures it, and an effect
// that does a little of what another width would do is none.
#pragma once

#include <string>
#include <vector>

#include "measurement/fit/judge.hpp"

namespace freestand::measurement {

// The numbers of the fit, and behind them those that are stated, where both together are likeliest: G and the squares of the deviations (over
// their standard deviations) are least. These squares are observations like others, one more and one more number each, so that what is
// left compares with chance as G alone does.
struct AsStated {
  ModelSpec model;
  Values x;
  std::vector<std::string> names;  // of what is stated: the faults of laboratory.hpp
  double gain = 0;                 // by how much that lies below G of the fit
  std::vector<bool> is_off;        // by more than chance
};
AsStated as_stated(const Bench&, const Judge&, const ModelFit&, const Jobs&);

// Columns of all its numbers, as slopes_of() gives them, those of what is stated per standard deviation; by how many of these it is off.
Eigen::MatrixXd slopes_as_stated(const AsStated&, const Judge&, const Test&, std::size_t i, const Prediction& at);
Eigen::VectorXd deviations(const AsStated&);
// The fit's and the deviations' normal equations: deviations are 0 +- 1 beforehand.
Eigen::MatrixXd with_tolerance(Eigen::MatrixXd gram, const AsStated&);

}  // namespace freestand::measurement
