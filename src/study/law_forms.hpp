// Forms of laws that stand in no catalogue, each in one variable, with free numbers: what the diagnosis proposes a law from.
#pragma once

#include <string>
#include <vector>

#include "dynamics/effect.hpp"

namespace freestand::study {

struct LawForm {
  std::string variable;       // as tables of recovered friction call it
  std::string factor, force;  // formulas (formula/formula.hpp), one of them: of friction, and force per mass [m/s2]
  dynamics::Effect effect;
  std::string friction() const { return factor.empty() ? "" : "mu*(" + factor + ")"; }
};

const std::vector<LawForm>& law_forms();

// One law of several: the product of their factors, the sum of their forces, their numbers in this order.
LawForm together(const std::vector<LawForm>&);

// The entry of a study's `effects`, as `freestand add` takes it, its numbers to be calibrated around these values. Where the law would make
// friction negative, farther than was measured, there is none.
std::string entry_of(const LawForm&, const std::vector<double>& values);

// The law at these places of its variable, all else at rest: friction coefficient where mu is that of the base's number, or
// force per mass [m/s2].
std::vector<double> law_at(const LawForm&, const std::vector<double>& places, double mu,
                           const std::vector<double>& values);

}  // namespace freestand::study
