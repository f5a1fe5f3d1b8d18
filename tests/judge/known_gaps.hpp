// Where two answers are as good: the laws, or the stepper, leave open which one holds. Disagreements there are counted by name and printed; nothing
// else is excused. A gap that is mended is taken out.
#pragma once

#include <string>

#include "judge/judge.hpp"

namespace freestand::test {

// Name of the gap that a disagreement falls into; empty: of none.
std::string known_gap(const JudgedCase&, const Judgement&);

}  // namespace freestand::test
