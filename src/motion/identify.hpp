// Which of the pulses A, B, C1, C2 is in a record.
#pragma once

#include <freestand/floor_motion.hpp>
#include <optional>
#include <string>
#include <vector>

namespace freestand::motion {

// What the user says of a record's pulse. What is said is not looked for.
struct KnownPulse {
  std::string type = {};                // "A", "B", "C1", "C2"; empty: not said
  std::optional<double> period_s = {};  // T_p

  bool any() const { return !type.empty() || period_s; }
  bool operator==(const KnownPulse&) const = default;
};

// The types that a record's pulse may have.
const std::vector<std::string>& pulse_types();

// The pulse whose velocity fits the floor's velocity best: least squares over the whole record, in type, period,
// amplitude and start. The starting points come from a grid (cross-correlation by FFTW), the refinement from GSL. Of a
// known period amplitude and start alone are fitted, the start to a 256th of it.
struct IdentifiedPulse {
  std::string type;                               // "A", "B", "C1", "C2"; empty: none (a floor that does not move)
  double period_s = 0;                            // T_p
  double velocity_mps = 0;                        // v_p of [KM05 ch. 5]; negative: the pulse mirrored
  double start_s = 0;                             // may lie before the record
  double explained = 0;                           // share of the integral of velocity^2 that the pulse explains, 0 to 1
  bool type_given = false, period_given = false;  // by the user
};
IdentifiedPulse identify_pulse(const FloorMotion& motion, const KnownPulse& known = {});

}  // namespace freestand::motion
