// Type B: one full cosine of acceleration, a forward-and-back step of the floor. Starts and ends with a jump.
//   a = w v_p cos(w t),  v = v_p sin(w t),  u = (v_p / w)(1 - cos(w t)),  0 <= t <= T.
#include <cmath>

#include "base/units.hpp"
#include "motion/pulse_family.hpp"

namespace freestand::motion::pulse_b {
namespace {

Pulse make(int) {
  constexpr double w = 2 * pi;
  return {.name = "B",
          .summary = "one full cosine of acceleration: the floor goes forward and back",
          .source = "[KM05 ch. 5], Makris (1997)",
          .duration = 1,
          .velocity_amplitude = 1 / w,
          .peak_velocity = 1 / w,
          .peak_displacement = 2 / (w * w),
          .breaks = {0, 1},
          .at = [](double t) {
            return PulseState{std::cos(w * t), std::sin(w * t) / w, (1 - std::cos(w * t)) / (w * w)};
          }};
}

const RegisteredPulse here{{.name = "B", .aliases = {"cosine", "one_cosine"}, .make = make}};

}  // namespace
}  // namespace freestand::motion::pulse_b
