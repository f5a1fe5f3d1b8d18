#include "measurement/fit/slopes.hpp"

#include <cmath>

namespace freestand::measurement {

Eigen::MatrixXd slopes_of(const Judge& judge, const Test& test, std::size_t i, const ModelSpec& model, const Values& x,
                          const Prediction& at) {
  // Histories of a slip are known to about 1e-8 of their size and bend over about 1e-2 of the box: the error is least where
  // both are alike.
  constexpr double step = 1e-4;
  Eigen::MatrixXd columns(judge.change(i, at, at).size(), static_cast<Eigen::Index>(x.size()));
  std::vector<Asked> moved;
  std::vector<double> by;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const Free& free = model.free[k];
    const double z = to_unit(free, x[k]);
    const bool inside = std::abs(to_unit(free, from_unit(free, z + step)) - z - step) < 1e-9;
    by.push_back(inside ? step : -step);
    moved.push_back({model, test, x});
    moved.back().x[k] = from_unit(free, z + by.back());
  }
  predict(moved, [&](std::size_t k, const Prediction& there) {
    columns.col(static_cast<Eigen::Index>(k)) = judge.change(i, at, there) / by[k];
  });
  return columns;
}

}  // namespace freestand::measurement
