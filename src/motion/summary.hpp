// What is costly about a motion, computed once and read by every sample that uses it. With its row every intensity of a
// sample follows from it, without the motion.
#pragma once

#include <freestand/floor_motion.hpp>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "motion/identify.hpp"
#include "motion/peaks.hpp"
#include "motion/pulse.hpp"
#include "motion/spectrum.hpp"

namespace freestand::motion {

// All of the motion as it stands: scale 1, stretch 1.
struct MotionSummary {
  MotionPeaks peaks;
  double arias_mps = std::numeric_limits<double>::quiet_NaN();  // Arias intensity
  double cav_mps = std::numeric_limits<double>::quiet_NaN();    // cumulative absolute velocity
  bool is_pulse = false;
  IdentifiedPulse pulse;  // of a unit pulse: itself, with period 1 s; of a record: given or the fit, where asked for
  double housner_m = std::numeric_limits<double>::quiet_NaN();  // of a record, with the spectrum
  ResponseSpectrum spectrum;  // of a record: where asked for; of a unit pulse: fine enough to integrate it
  std::shared_ptr<const FloorMotion> unit_pulse;           // null for records, and where a pulse's table will do
  std::vector<std::pair<std::string, double>> given = {};  // what a table of records says of it, at scale 1; by column

  std::shared_ptr<const MotionSummary> ground =
      {};  // of a floor of a building: the ground's; null: it is the ground's itself

  double given_value(const std::string& column) const;  // nan where nothing gives it
};

// Of a record: its peaks, what its acceleration adds up to, and what else is asked for.
struct SummaryRequest {
  bool pulse = false;           // identify its pulse (needed by pulse_frequency_radps)
  KnownPulse known_pulse = {};  // what the user says of it
  std::vector<double> sa_period_s =
      {};  // spectrum at these periods, increasing, and Housner's intensity; empty: neither
};
MotionSummary summarize(const FloorMotion& record, const SummaryRequest& request = {});
MotionSummary summarize(const Pulse& pulse);

// Of the ground under the building; of a motion that is of no floor, itself.
inline const MotionSummary& ground_of(const MotionSummary& motion) { return motion.ground ? *motion.ground : motion; }

// Of motion(t / stretch), 5 % damping; stretch is 1 for records. The spectral acceleration of a pulse is that of its
// closed form (null: of its table), of a record that of its spectrum. Throw Error where that was not asked for, or the period lies outside.
double spectral_acceleration_mps2(const MotionSummary& summary, double period_s, double stretch);
double housner_intensity_m(const MotionSummary& summary, double stretch);

// w_p = 2 pi / T_p [rad/s] of Delta = U w_p^2 / PTA [KM05 5.7]: of the pulse itself, or of the record's, given or identified.
// nan when the record's pulse was not asked for or there is none.
double pulse_frequency_radps(const MotionSummary& summary, double stretch);

}  // namespace freestand::motion
