#include "motion/summary.hpp"

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <map>
#include <mutex>
#include <string>

#include "base/units.hpp"
#include "motion/cumulative.hpp"

namespace freestand::motion {
namespace {

// From a hundredth of the pulse's period to a hundred times it.
std::vector<double> periods_of_a_unit_pulse() {
  constexpr int each_way = 600;
  std::vector<double> periods;
  for (int i = -each_way; i <= each_way; ++i) periods.push_back(std::pow(10.0, 2.0 * i / each_way));
  return periods;
}

// By the closed form, or by the table where that reaches.
double unit_pulse_acceleration_mps2(const MotionSummary& summary, double period_s, bool closed_form) {
  const std::vector<double>& known = summary.spectrum.period_s();
  if (!closed_form && period_s >= known.front() && period_s <= known.back()) return summary.spectrum.at(period_s);
  if (summary.unit_pulse) return spectral_acceleration_mps2(*summary.unit_pulse, period_s);
  return summary.spectrum.at(std::clamp(period_s, known.front(), known.back()));
}

void add_sums(const FloorMotion& motion, MotionSummary& summary) {
  summary.arias_mps = arias_intensity_mps(motion);
  summary.cav_mps = cumulative_absolute_velocity_mps(motion);
}

MotionSummary summary_of(const Pulse& pulse) {
  MotionSummary summary;
  summary.peaks = {1, pulse.peak_velocity, pulse.peak_displacement};
  summary.is_pulse = true;
  summary.pulse = {pulse.name, 1, pulse.velocity_amplitude, 0, 1};
  summary.unit_pulse = std::make_shared<const FloorMotion>(pulse_motion(pulse));
  add_sums(*summary.unit_pulse, summary);
  summary.spectrum = response_spectrum(*summary.unit_pulse, periods_of_a_unit_pulse());
  return summary;
}

}  // namespace

MotionSummary summarize(const FloorMotion& record, const SummaryRequest& request) {
  MotionSummary summary;
  summary.peaks = peaks(record);
  add_sums(record, summary);
  if (request.pulse) summary.pulse = identify_pulse(record, request.known_pulse);
  if (request.sa_period_s.empty()) return summary;
  summary.spectrum = response_spectrum(record, request.sa_period_s);
  summary.housner_m = housner_intensity_m(record);
  return summary;
}

// The spectrum takes a twentieth of a second, and a run asks for that of each pulse several times.
MotionSummary summarize(const Pulse& pulse) {
  static std::mutex one_at_a_time;
  static std::map<std::string, MotionSummary> known;
  const std::lock_guard lock(one_at_a_time);
  const auto found = known.find(pulse.name);
  return found != known.end() ? found->second : known.emplace(pulse.name, summary_of(pulse)).first->second;
}

// Sa of motion(t / s) at T is that of motion(t) at T / s.
double spectral_acceleration_mps2(const MotionSummary& summary, double period_s, double stretch) {
  if (!summary.is_pulse) return summary.spectrum.at(period_s);
  return unit_pulse_acceleration_mps2(summary, period_s / stretch, summary.unit_pulse != nullptr);
}

double housner_intensity_m(const MotionSummary& summary, double stretch) {
  if (!summary.is_pulse) {
    if (std::isnan(summary.housner_m))
      throw Error("the motion has no Housner intensity (its spectrum was not asked for): ask for it", Exit::data);
    return summary.housner_m;
  }
  return housner_intensity_m(
      [&](double period) { return unit_pulse_acceleration_mps2(summary, period / stretch, false); });
}

double pulse_frequency_radps(const MotionSummary& summary, double stretch) {
  if (!(summary.pulse.period_s > 0)) return std::numeric_limits<double>::quiet_NaN();
  return 2 * pi / (summary.pulse.period_s * stretch);
}

double MotionSummary::given_value(const std::string& column) const {
  for (const auto& [name, value] : given)
    if (name == column) return value;
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace freestand::motion
