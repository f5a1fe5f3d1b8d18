// Numbers that a study may well have, but that look as if they were in another unit. One plain sentence each.
#pragma once

#include "study/realise.hpp"

namespace freestand::study {

// Of its numbers, by their medians.
std::vector<std::string> doubts(const Study&);
// Of its records, as their median scale leaves them.
std::vector<std::string> doubts(const Study&, const MotionSet&);

}  // namespace freestand::study
