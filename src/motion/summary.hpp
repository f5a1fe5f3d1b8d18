// What is costly about a motion, computed once and read by every sample that uses it.
#pragma once

#include <freestand/floor_motion.hpp>
#include <vector>

#include "motion/identify.hpp"
#include "motion/peaks.hpp"
#include "motion/pulse.hpp"

namespace freestand::motion {

// What the samples will ask for. Peaks are always there.
struct SummaryRequest {
  bool pulse = false;  // identify the pulse of a record (needed by pulse_frequency_radps)
  bool housner = false;
  std::vector<double> sa_period_s = {};  // spectral accelerations, 5 % damping
};

// All of the motion as it stands: scale 1, stretch 1.
struct MotionSummary {
  MotionPeaks peaks;
  bool is_pulse = false;
  IdentifiedPulse pulse;            // of a unit pulse: itself, with period 1 s; of a record: the fit, where asked for
  double housner_m = -1;            // negative: not asked for
  std::vector<double> sa_period_s;  // increasing
  std::vector<double> sa_mps2;      // one per period
};

MotionSummary summarize(const FloorMotion& record, const SummaryRequest& request = {});
MotionSummary summarize(const Pulse& pulse);

// w_p = 2 pi / T_p [rad/s] of Delta = U w_p^2 / PTA [KM05 5.7]: of the pulse itself, or of the pulse identified in the
// record. nan when the record's pulse was not asked for or there is none.
double pulse_frequency_radps(const MotionSummary& summary, const Shaking& shaking);

}  // namespace freestand::motion
