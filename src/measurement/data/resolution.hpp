// The steps in which a channel is read.
#pragma once

#include <vector>

namespace freestand::measurement {

// The step q, 0 where none shows: a staircase of at least ten treads of 2 to 50 equal readings with a riser at both ends, among four
// values or more, in which every change is a multiple of the least one. (A ramp has no treads, a pulse of few levels few values, and
// noise that is printed to many digits no multiples.)
double resolution(const std::vector<double>& samples);

// Standard deviation of what is rounded to such steps: q/sqrt(12), of errors spread evenly over a step.
double rounding(const std::vector<double>& samples);

}  // namespace freestand::measurement
