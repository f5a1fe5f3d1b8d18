#include "measurement/fit/slopes.hpp"

#include <cmath>

namespace freestand::measurement {

Eigen::MatrixXd slopes_of(const Judge& judge, const Test& test, std::size_t i, const ModelSpec& model, const Values& x,
                          const Prediction& at) {
  // Histories of a slip are known to about 1e-8 of their size and bend over about 1e-2 of the box: the error is least where
  // both are alike.
  constexpr double step = 1e-4;
  Eigen::MatrixXd columns(judge.change(i, at, at).size(), static_cast<Eigen::Index>(x.size()));
  for (std::size_t k = 0; k < x.size(); ++k) {
    const Free& free = model.free[k];
    const double z = to_unit(free, x[k]);
    const bool inside = std::abs(to_unit(free, from_unit(free, z + step)) - z - step) < 1e-9;
    Values moved = x;
    moved[k] = from_unit(free, inside ? z + step : z - step);
    columns.col(static_cast<Eigen::Index>(k)) =
        judge.change(i, at, predict(model, test, moved)) / (inside ? step : -step);
  }
  return columns;
}

}  // namespace freestand::measurement
