// What rounding can have done: printed inputs stand for all numbers that round to them.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "report/item.hpp"

namespace freestand::report {

// An input as it is printed, to a multiple of `unit`.
struct Rounded {
  double value = 0, unit = 0;
};

// From the least to the largest of f over draws of the inputs, uniform within half a unit of what is printed, and of f at the
// printed inputs. A thousand draws: what none of them reaches, rounding alone does not explain. The same on every machine.
Range reach(std::span<const Rounded> inputs, const std::function<double(std::span<const double>)>& f);

}  // namespace freestand::report
