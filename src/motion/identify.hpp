// Which of the pulses A, B, C1, C2 is in a record.
#pragma once

#include <freestand/floor_motion.hpp>
#include <string>

namespace freestand::motion {

// The pulse whose velocity fits the floor's velocity best: least squares over the whole record, in type, period,
// amplitude and start. The starting points come from a grid (cross-correlation by FFTW), the refinement from GSL.
struct IdentifiedPulse {
  std::string type;         // "A", "B", "C1", "C2"; empty: none (a floor that does not move)
  double period_s = 0;      // T_p
  double velocity_mps = 0;  // v_p of [KM05 ch. 5]; negative: the pulse mirrored
  double start_s = 0;       // may lie before the record
  double explained = 0;     // share of the integral of velocity^2 that the pulse explains, 0 to 1
};
IdentifiedPulse identify_pulse(const FloorMotion& motion);

}  // namespace freestand::motion
