// From fitted candidates to a verdict. Constants: levels.hpp. Histories and peaks in the same steps:
//
//   helps     the largest gain of all effects tried is more than data from the base would give
//   best      of one effect the candidate that misses least, of those that miss the tests left out by less than the base, and not merely
//             by a history that the floor's noise turns elsewhere.
//             It gives way to a larger one, or one with odd numbers, only where that misses the tests left out by less, its
//             lead is more than data from the smaller would give it, and so is the gain of one more effect, among all
//             that may join
//   rivals    those whose own data would give the best its lead, and those that miss tests left out by less; where none is enough but by its own error, those
//             of which that is so too
//             Where the best is enough only if what is stated is off within its tolerances, all are judged so
//   enough    histories: its misfit is one that data from itself may have, or its own error is no larger than the noise, in each test too. What the laboratory states
//             wrongly is named only by the former: a number that is put right leaves noise alone
//             peaks: tests left out are missed by no more than twice what one test misses another by, in the mean square (chance_of_peaks.hpp)
//
// Of the best and its rivals, and of all candidates where none helps, the one of least left-out error is told as the best.
// What leaves less still, and what does as well with odd numbers, has a remark that says why it is not named.
#pragma once

#include <functional>

#include "measurement/verdict/candidates.hpp"

namespace freestand::measurement {

// What is asked of simulations, each answered by a chance.
struct Questions {
  std::function<Chance(const Candidate& best, const Candidate& rival)> lead;
  std::function<Chance(const Candidate&)> enough;
  std::function<Chance(const Candidate&)> another;  // histories: does one more effect help beside these?
  std::function<Chance(const Candidate&)> steady;   // histories: does it help where its own replays do not fan out?
  std::function<double(const Candidate&)>
      beside;  // histories: what it misses where all that is stated is off as suits it best
};

// May an effect help, by Diagnosis::chances? Yes where that was not asked.
bool effect_may_help(const Diagnosis&);
// A friction of its own in each test takes the base to the noise, and the best candidate misses the tests by more than so
// many numbers gain by chance.
bool only_friction_scatters(const Diagnosis&);

// Fills verdict, reason, effects, best, rivals, chances, differences, sentences, and orders the candidates.
void decide(const Bench&, Diagnosis&, const Questions&);

}  // namespace freestand::measurement
