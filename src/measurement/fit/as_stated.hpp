// A fitted model beside all that the laboratory may state wrongly: how much of what it misses goes with deviations from that within their
// tolerances (Dataset::tolerance)? A block that rocks tells its width to a ten thousandth, as nobody measures it, and an effect
// that does a little of what another width would do is none.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "measurement/fit/judge.hpp"

namespace freestand::measurement {

// The numbers of the fit, and behind them those that are stated.
struct AsStated {
  ModelSpec model;
  Values x;
  std::vector<std::string> names;  // of what is stated: the faults of stated_numbers.hpp
  double weight = 1;               // of the squares of the deviations beside G
  double misfit = 0;               // that sum
  std::vector<bool> is_off;        // by more than chance
};
// As stated.
AsStated with_stated_numbers(const Bench&, const ModelFit&);

// Where both together are likeliest: G and the squares of the deviations (over their standard deviations) are least. These squares are
// observations like others, one more and one more number each, so that what is left compares with chance as G alone does. Where the
// tests disagree by s noise units rather than one, they weigh s^2. Found downhill from the fit: a deviation by which a long rocking falls out of
// step is not, and is to be looked for by fits of their own (`elsewhere`: the fit's numbers with one that is stated), from which it is
// found downhill too.
AsStated as_stated(const Bench&, const Judge&, const ModelFit&, const Jobs&,
                   const std::vector<ModelFit>& elsewhere = {}, double weight = 1);

// "the width is 1.2 % smaller than stated": what is off by the most standard deviations, of what is off by more than chance; empty: nothing is.
std::string most_off(const AsStated&);

// Do all deviations together lie within what the tolerances make by chance?
bool within_tolerances(const AsStated&);

// A model that holds the fit's numbers first, and its numbers, moved as far as those of the fit were, with what is stated as it is here.
std::pair<ModelSpec, Values> moved_alike(const AsStated&, const ModelFit& fit, const ModelSpec& other, Values x);

// Columns of all its numbers, as slopes_of() gives them, those of what is stated per standard deviation; by how many of these it is off.
Eigen::MatrixXd slopes_as_stated(const AsStated&, const Judge&, const Test&, std::size_t i, const Prediction& at);
Eigen::VectorXd deviations(const AsStated&);
Eigen::VectorXd deviations(const AsStated&, const Values& x);  // at other numbers
// The fit's and the deviations' normal equations: deviations are 0 +- 1 beforehand.
Eigen::MatrixXd with_tolerance(Eigen::MatrixXd gram, const AsStated&);

}  // namespace freestand::measurement
