// How a pulse's file makes its pulse known: one family a file, pulse_*.cpp.
#pragma once

#include <string>
#include <vector>

#include "base/registry.hpp"
#include "motion/pulse.hpp"

namespace freestand::motion {

struct PulseFamily {
  std::string name;                       // "A"; "Cn" for the numbered family
  std::vector<std::string> aliases = {};  // other names of the same pulse
  Pulse (*make)(int n) = nullptr;         // n: the number in "C7"; 0 for families without number
  bool numbered = false;                  // name ends in n, n >= 1
};

using RegisteredPulse = Registered<PulseFamily>;

}  // namespace freestand::motion
