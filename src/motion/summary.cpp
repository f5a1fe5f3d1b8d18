#include "motion/summary.hpp"

#include <algorithm>
#include <limits>

#include "base/units.hpp"
#include "motion/spectrum.hpp"

namespace freestand::motion {
namespace {

void add_spectra(MotionSummary& summary, const FloorMotion& motion, const SummaryRequest& request) {
  if (request.housner) summary.housner_m = housner_intensity_m(motion);
  summary.sa_period_s = request.sa_period_s;
  std::sort(summary.sa_period_s.begin(), summary.sa_period_s.end());
  const auto last = std::unique(summary.sa_period_s.begin(), summary.sa_period_s.end());
  summary.sa_period_s.erase(last, summary.sa_period_s.end());
  for (const double period : summary.sa_period_s) summary.sa_mps2.push_back(spectral_acceleration_mps2(motion, period));
}

}  // namespace

MotionSummary summarize(const FloorMotion& record, const SummaryRequest& request) {
  MotionSummary summary;
  summary.peaks = peaks(record);
  if (request.pulse) summary.pulse = identify_pulse(record);
  add_spectra(summary, record, request);
  return summary;
}

// Spectra of a unit pulse serve no sample: every sample stretches the pulse by its own period.
MotionSummary summarize(const Pulse& pulse) {
  MotionSummary summary;
  summary.peaks = {1, pulse.peak_velocity, pulse.peak_displacement};
  summary.is_pulse = true;
  summary.pulse = {pulse.name, 1, pulse.velocity_amplitude, 0, 1};
  return summary;
}

double pulse_frequency_radps(const MotionSummary& summary, const Shaking& shaking) {
  if (!(summary.pulse.period_s > 0)) return std::numeric_limits<double>::quiet_NaN();
  return 2 * pi / (summary.pulse.period_s * shaking.stretch);
}

}  // namespace freestand::motion
