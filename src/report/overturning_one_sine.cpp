// Overturning of a block p = 1.25 rad/s, alpha = 0.16 under one-sine pulses.
#include "report/overturning.hpp"

namespace freestand::report {
namespace {

Item overturning_one_sine(const Sources& sources) {
  return spectrum_item(sources, "overturning_one_sine", "A", "one-sine pulses", "yes: figure 6.5");
}

const RegisteredItem overturning_one_sine_here{
    {.name = "overturning_one_sine",
     .order = 620,
     .chapter = 6,
     .place = "Figures 6.4 to 6.6 (6.5)",
     .what = "overturning of a block p = 1.25 rad/s, α = 0.16 under one-sine pulses",
     .compute = overturning_one_sine}};

}  // namespace
}  // namespace freestand::report
