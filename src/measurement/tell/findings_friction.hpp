// What is said where friction differs from test to test (TestComparison::own_friction): it is no effect, and nobody knows it of a test before.
#pragma once

#include "measurement/tell/compare.hpp"

namespace freestand::measurement {

// "; with a friction of its own in each test, 0.9 to 1.05 times that of all, the model leaves 0.98 where noise explains 1: ...", of tests of
// one role. Root mean square over them [noise units].
std::string told_with_own_friction(const std::vector<const TestComparison*>&, Role);

// Does it explain all histories that the floor's noise does not drown?
bool only_friction_differs(const std::vector<TestComparison>&);

}  // namespace freestand::measurement
