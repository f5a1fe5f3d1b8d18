// After the verdict `unknown`, or where the best effect leaves more than data from it would: which law, of no catalogue, would do? Forms of laws in one variable (position, time, path,
// speed) with free numbers are fitted as effects are, each by tests left out. A form is proposed when
//
//   its gain over the base is more than chance among all forms tried (chance.hpp),
//   its lead over the best effect of the catalogue is more than data from that effect would give it; several effects together, which are
//   enough, give way to a form of fewer numbers over which their own lead may be chance: two laws imitate a third easily,
//   and over each form of fewer numbers, too: a term that does not earn its numbers is not proposed;
//   after `unknown` it lowers the error of tests left out: to half of it, in the mean square, or beyond chance from test to test (t test).
#pragma once

#include <functional>

#include "measurement/verdict/diagnose.hpp"

namespace freestand::measurement {

// Fills chances, and proposal and a sentence where a law is found: then the verdict is `unknown`. Histories only.
void propose_law(const Bench&, const ModelSpec& base, const std::vector<const dynamics::Effect*>& forms,
                 const DiagnosisOptions&, const Jobs&, Diagnosis&);

// A law over its variable, with the numbers of a fit, and 95 % by the jackknife over the fits with folds left out.
struct LawBand {
  std::vector<double> law, lower, upper;
};
using LawAt = std::function<std::vector<double>(const Values& x)>;
LawBand law_band(const ModelFit&, const LawAt&);

}  // namespace freestand::measurement
