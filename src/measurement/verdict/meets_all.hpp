// Where nothing is named though an effect meets all tests: what a reader of the table would ask.
#pragma once

#include <functional>
#include <string>

#include "measurement/verdict/diagnose.hpp"

namespace freestand::measurement {

// A sentence where the verdict is `unknown` and an effect of the catalogue, fitted to all tests together, is enough, while tests left out are
// missed by more than is adequate (levels.hpp): few tests do not fix its numbers. Of these the one with fewest numbers, and of those the closest. Else empty.
std::string meets_all_tests(const Diagnosis&, const std::function<bool(const Candidate&)>& enough);

}  // namespace freestand::measurement
