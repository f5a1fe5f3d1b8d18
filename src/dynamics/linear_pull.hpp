// Forces along the floor in proportion to the slip and to its speed, X = -stiffness u - drag u', as the kernels of whole blocks take them.
#pragma once

#include <optional>

#include "dynamics/laws.hpp"

namespace freestand::dynamics {

struct LinearPull {
  double stiffness, drag;  // per mass [1/s2], [1/s]
};

// Nothing where the laws are more than such a force, or another one.
std::optional<LinearPull> linear_pull(const Laws& laws);

}  // namespace freestand::dynamics
