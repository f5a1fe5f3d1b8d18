// A look at effects before they are fitted to outcomes: on the tests that the model without them is least sure of, and on
// places twice as far apart as its scatter wants. A rocking block does not see friction; what a wider block does, a
// narrower base cannot be told from; and an effect that gains nothing on tests on which it was chosen gains nothing on
// others.
#pragma once

#include "measurement/outcome_fit.hpp"

namespace freestand::measurement {

struct Screened {
  OutcomeTable table;
  double changed = 0;            // share of the outcomes that the effect changes at the ends of its range
  bool imitated = false;         // there the other numbers do the same
  double gain = 0, gain_se = 0;  // of the mean score of these tests, against the model without; paired
  bool visible() const;          // changes more outcomes than rounding does
  bool promising() const;        // gains more than its standard error, times the root of the effect's count of numbers
};

// `without`: fitted, with errors of all calibration tests. In the order of the effects.
std::vector<Screened> screen_outcomes(const Bench&, const ModelFit& without,
                                      const std::vector<const dynamics::Effect*>&, const OutcomeEffort&, const Jobs&);

}  // namespace freestand::measurement
