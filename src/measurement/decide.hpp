// From fitted candidates to a verdict.
#pragma once

#include <functional>

#include "measurement/candidates.hpp"

namespace freestand::measurement {

// sqrt(G/samples) above which a model is not at the noise; below which a second effect is not looked for; of a base
// below which nothing is missing whatever fits better.
inline constexpr double at_noise = 1.3, may_be_stuck = 1.05, may_hide_another = 1.015, base_at_noise = 1.01;
// Differences of G that chance makes between two models, where that is not computed (chance.hpp).
inline constexpr double chance_misfit = 30;

// May an effect help, by Diagnosis::chances? Yes where that was not asked.
bool effect_may_help(const Diagnosis&);
// A friction of its own in each test takes the base to the noise, and the best candidate misses the tests by more than so
// many numbers gain by chance.
bool only_friction_scatters(const Diagnosis&);

// Fills verdict, reason, effects, best, rivals, chances, differences, sentences, and orders the candidates. lead: the
// chance that the lead of a best candidate over a rival has; none: not asked.
using Lead = std::function<Chance(const Candidate& best, const Candidate& rival)>;
void decide(const Bench&, Diagnosis&, const Lead& lead = {});

}  // namespace freestand::measurement
