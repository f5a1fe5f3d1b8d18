#include "report/table_pulses.hpp"

#include "base/units.hpp"

namespace freestand::report {

const TablePulses::Made& TablePulses::made(const std::string& type) {
  const auto found = made_.find(type);
  if (found != made_.end()) return found->second;
  const motion::Pulse pulse = motion::find_pulse(type);
  return made_.emplace(type, Made{pulse, motion::pulse_motion(pulse)}).first->second;
}

Shaking TablePulses::shaking(const std::string& type, double period_s, double velocity_in_per_s) {
  const Made& one = made(type);
  return {&one.motion, motion::acceleration_of_velocity_amplitude(one.pulse, velocity_in_per_s * inch_m, period_s),
          period_s};
}

Shaking TablePulses::shaking_g(const std::string& type, double period_s, double peak_acceleration_g) {
  return {&made(type).motion, peak_acceleration_g * standard_gravity_mps2, period_s};
}

}  // namespace freestand::report
