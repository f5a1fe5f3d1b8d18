// The pulses that the report fitted to its motions, as its tables give them: type, period and velocity.
#pragma once

#include <freestand/floor_motion.hpp>
#include <map>
#include <string>

#include "motion/pulse.hpp"

namespace freestand::report {

// Pulses by type, each made once. What it hands out stays valid as long as it lives.
class TablePulses {
 public:
  // a_p = 2 pi v_p/T (B and C), pi v_p/T (A), with the sign of the velocity.
  Shaking shaking(const std::string& type, double period_s, double velocity_in_per_s);
  // Of a given peak acceleration.
  Shaking shaking_g(const std::string& type, double period_s, double peak_acceleration_g);

 private:
  struct Made {
    motion::Pulse pulse;
    FloorMotion motion;
  };
  const Made& made(const std::string& type);
  std::map<std::string, Made> made_;
};

}  // namespace freestand::report
