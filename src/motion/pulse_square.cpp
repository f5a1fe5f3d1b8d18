// Square wave: a = a_p for half a period, then -a_p for the other half. The floor ends at rest, displaced.
#include "motion/pulse_family.hpp"

namespace freestand::motion::pulse_square {
namespace {

Pulse make(int) {
  return {.name = "square",
          .summary = "constant acceleration for half a period, its opposite for the other half",
          .source = "Newmark (1965)",
          .duration = 1,
          .velocity_amplitude = 0.5,
          .peak_velocity = 0.5,
          .peak_displacement = 0.25,
          .segments_per_period = 1,
          .table_degree = 1,
          .breaks = {0, 0.5, 1},
          .at = [](double t) {
            const double left = 1 - t;
            return t < 0.5 ? PulseState{1, t, t * t / 2} : PulseState{-1, left, 0.25 - left * left / 2};
          }};
}

const RegisteredPulse here{{.name = "square", .make = make}};

}  // namespace
}  // namespace freestand::motion::pulse_square
