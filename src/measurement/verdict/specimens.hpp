// Is a friction that differs from test to test one that differs from specimen to specimen, or that of a single test? Specimens are told by
// their dimensions.
#pragma once

#include <optional>
#include <string>

#include "measurement/fit/own_numbers.hpp"

namespace freestand::measurement {

// A sentence where the logarithms of the tests' frictions differ between specimens by more than chance, beside how they scatter within them
// (analysis of variance, F test); else empty.
std::string friction_of_specimens(const Bench&, const OwnNumbers& friction);

// The one test, if any, whose friction's logarithm is odd_one() of all.
struct TestOfOtherFriction {
  std::string id;
  double times_the_others = 1;   // over their geometric mean
  double scatter_of_others = 0;  // standard deviation of ln mu
  double p = 1;
  std::size_t tests = 0;  // of all
};
std::optional<TestOfOtherFriction> test_of_other_friction(const Bench&, const OwnNumbers& friction);
std::string told(const TestOfOtherFriction&);  // a sentence

// A sentence where the calibration tests are of several specimens, one of which may have an effect that another has not: which tests are
// of which; else empty.
std::string several_specimens(const Bench&);

}  // namespace freestand::measurement
