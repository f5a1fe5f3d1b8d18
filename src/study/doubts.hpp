// What a study may well have, but looks like a slip: numbers in another unit, a record with an offset, and vertical components
// left out of a pattern. One plain sentence each.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "study/realise.hpp"

namespace freestand::study {

// Between the samples of a coarser motion a floor of 5 Hz turns [s].
inline constexpr double coarsest_step_s = 0.1;

// Of its numbers, by their medians.
std::vector<std::string> doubts(const Study&);
// Of its records, as their median scale leaves them.
std::vector<std::string> doubts_of_records(const Study&, const MotionSet&);
// Both.
std::vector<std::string> doubts(const Study&, const MotionSet&);
// Tells both on stderr, but for what is among `told`, which it then is.
void tell_doubts(const Study&, const MotionSet&, std::set<std::string>& told);
// Of a case: one sample, whose numbers are no distributions.
std::vector<std::string> doubts(const Case&, const MotionSet&);

}  // namespace freestand::study
