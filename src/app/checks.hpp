// Checks of options, in words of their own: what the parser's say of a range is its two ends in hundreds of digits.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace freestand::app {

// "-1 is no time step (it is above 0): give another one"
CLI::Validator above_zero(const std::string& what);
// "3 is no confidence (it lies from 0.5 to 0.999): give another one"
CLI::Validator within(double least, double most, const std::string& what);
// "-1 is no number of a motion (0 or above): give another one"
CLI::Validator zero_or_above(const std::string& what);

}  // namespace freestand::app
