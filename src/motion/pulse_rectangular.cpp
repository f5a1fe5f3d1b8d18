// Rectangular pulse: a = a_p for one period, so that Newmark's sliding block obeys U w^2 / a_p = 2 pi^2 (a_p/(mu g) -
// 1) [KM05 5.10]. The floor keeps the velocity a_p T afterwards.
#include "motion/pulse_family.hpp"

namespace freestand::motion::pulse_rectangular {
namespace {

Pulse make(int) {
  return {.name = "rectangular",
          .summary = "constant acceleration for one period: the floor keeps the velocity it reached",
          .source = "Newmark (1965), [KM05 5.10]",
          .duration = 1,
          .velocity_amplitude = 1,
          .peak_velocity = 1,
          .peak_displacement = 0.5,
          .segments_per_period = 1,
          .table_degree = 1,
          .breaks = {0, 1},
          .at = [](double t) {
            return PulseState{1, t, t * t / 2};
          }};
}

const RegisteredPulse here{{.name = "rectangular", .make = make}};

}  // namespace
}  // namespace freestand::motion::pulse_rectangular
