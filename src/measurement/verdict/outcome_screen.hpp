// A look at effects before they are fitted to outcomes: on the tests that the model without them is least sure of, and on
// places twice as far apart as its scatter wants. A rocking block does not see friction; and an effect that goes sample by
// sample and gains nothing on tests on which it was chosen is not worth an hour to show that it gains nothing on others.
#pragma once

#include "measurement/fit/outcome_fit.hpp"

namespace freestand::measurement {

struct Screened {
  OutcomeTable table;
  double changed = 0;            // share of the outcomes that the effect changes at the ends of its range
  double gain = 0, gain_se = 0;  // of the mean score of these tests, against the model without; paired
  bool visible() const;          // changes more outcomes than rounding does
  // Worth a fit: it is quick, or gains more than its standard error, times the root of the effect's count of numbers.
  bool promising() const;
};

// `without`: fitted, with errors of all calibration tests. In the order of the effects.
std::vector<Screened> screen_outcomes(const Bench&, const ModelFit& without,
                                      const std::vector<const dynamics::Effect*>&, const OutcomeEffort&, const Jobs&);

}  // namespace freestand::measurement
