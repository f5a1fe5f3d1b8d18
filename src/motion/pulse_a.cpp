// Type A: one full sine of acceleration, a forward step of the floor.
//   a = (w v_p / 2) sin(w t),  v = (v_p / 2)(1 - cos(w t)),  u = (v_p / 2)(t - sin(w t) / w),  0 <= t <= T.
#include <cmath>

#include "base/units.hpp"
#include "motion/pulse_family.hpp"

namespace freestand::motion::pulse_a {
namespace {

Pulse make(int) {
  constexpr double w = 2 * pi;
  return {.name = "A",
          .summary = "one full sine of acceleration: the floor ends displaced",
          .source = "[KM05 ch. 5], Makris (1997)",
          .duration = 1,
          .velocity_amplitude = 2 / w,
          .peak_velocity = 2 / w,
          .peak_displacement = 1 / w,
          .breaks = {0, 1},
          .at = [](double t) {
            return PulseState{std::sin(w * t), (1 - std::cos(w * t)) / w, (t - std::sin(w * t) / w) / w};
          }};
}

const RegisteredPulse here{{.name = "A", .aliases = {"sine", "one_sine"}, .make = make}};

}  // namespace
}  // namespace freestand::motion::pulse_a
