// The pulses of chapter 5: types A, B and C, and the phase by which a C pulse ends without displacement [KM05 5.5].
#include <cmath>

#include "base/units.hpp"
#include "motion/pulse.hpp"
#include "report/item.hpp"

namespace freestand::report {
namespace {

// Acceleration over its peak, velocity and displacement over v_p and v_p T, against time in periods.
Sheet pulse_histories() {
  Sheet sheet{"pulses", {"time_over_period", "acceleration", "velocity", "displacement"}, {}};
  constexpr int steps = 150;
  for (const char* type : {"A", "B", "C1", "C2"}) {
    const motion::Pulse pulse = motion::find_pulse(type);
    for (int i = 0; i <= steps; ++i) {
      const double t = pulse.duration * i / steps;
      const motion::PulseState at = pulse.at(t);
      sheet.rows.push_back({std::string(type), t, at.acceleration, at.velocity / pulse.velocity_amplitude,
                            at.displacement / pulse.velocity_amplitude});
    }
  }
  return sheet;
}

Item pulses_item(const Sources&) {
  Item item;
  const double printed[] = {0.0697, 0.0410};
  for (int n = 1; n <= 2; ++n) {
    const std::string type = std::string("C").append(std::to_string(n));
    item.numbers.push_back(compared({.id = "pulses." + type,
                                     .what = "phase φ of pulse " + type + " over π",
                                     .ours = motion::c_pulse_phase_rad(n) / pi,
                                     .print = printed[n - 1],
                                     .print_unit = 0.0001},
                                    Verdict::print_disagrees_with_itself, "not the root of equation 5.5"));
  }
  item.sheets = {pulse_histories()};
  return item;
}

const RegisteredItem pulses_here{{.name = "pulses",
                                  .order = 501,
                                  .chapter = 5,
                                  .place = "Figures 5.1 to 5.8, [KM05 5.1-5.5]",
                                  .what = "the pulses A, B and C",
                                  .compute = pulses_item}};

}  // namespace
}  // namespace freestand::report
