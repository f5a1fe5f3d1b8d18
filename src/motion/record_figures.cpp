#include "motion/record_figures.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/units.hpp"
#include "motion/channel.hpp"
#include "motion/cumulative.hpp"
#include "motion/spectrum.hpp"

namespace freestand::motion {
namespace {

// In quotes where a comma or a quote stands in it [RFC 4180].
std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string in_g(double mps2) { return fmt::format("{:.6g}", mps2 / standard_gravity_mps2); }

}  // namespace

const std::vector<double>& figure_periods_s() {
  static const std::vector<double> periods = {0.1, 0.2, 0.3, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0};
  return periods;
}

RecordFigures record_figures(const FloorMotion& motion) {
  RecordFigures f;
  f.samples = motion.knot_s.size();
  f.duration_s = motion.duration_s();
  f.step_s = motion.duration_s() / static_cast<double>(motion.segments());
  f.has_vertical = !motion.vertical_mps2.empty();
  f.peaks = peaks(motion);
  f.arias_mps = arias_intensity_mps(motion);
  f.cav_mps = cumulative_absolute_velocity_mps(motion);
  f.significant_5_75_s = significant_duration_s(motion, 0.05, 0.75);
  f.significant_5_95_s = significant_duration_s(motion, 0.05, 0.95);
  f.bracketed_s = bracketed_duration_s(motion, bracket_g * standard_gravity_mps2);
  for (const double period : figure_periods_s()) f.sa_mps2.push_back(spectral_acceleration_mps2(motion, period));
  f.pulse = identify_pulse(motion);
  return f;
}

std::string figures_text(const RecordFigures& f, bool vertical) {
  std::string text = fmt::format("  {} samples, step {:g} s, {:g} s, {}\n", f.samples, f.step_s, f.duration_s,
                                 f.has_vertical ? "horizontal and vertical"
                                 : vertical     ? "vertical"
                                                : "horizontal");
  text += fmt::format("  PGA {:.4f} g   PGV {:.4f} m/s   PGD {:.4f} m\n", f.peaks.pga_mps2 / standard_gravity_mps2,
                      f.peaks.pgv_mps, f.peaks.pgd_m);
  text += fmt::format("  Arias intensity {:.4g} m/s   CAV {:.4g} m/s\n", f.arias_mps, f.cav_mps);
  text += fmt::format("  duration: significant 5-75 % {:.2f} s, 5-95 % {:.2f} s; bracketed at {:g} g {:.2f} s\n",
                      f.significant_5_75_s, f.significant_5_95_s, bracket_g, f.bracketed_s);
  if (!f.pulse.type.empty())
    text += fmt::format(
        "  pulse {}: period {:.3f} s, velocity {:.3f} m/s, from {:.2f} s, explains {:.0f} % of the velocity\n",
        f.pulse.type, f.pulse.period_s, f.pulse.velocity_mps, f.pulse.start_s, 100 * f.pulse.explained);
  text += fmt::format("  Sa, {:.0f} % damped:", 100 * usual_damping);
  for (std::size_t i = 0; i < f.sa_mps2.size(); ++i)
    text += fmt::format("  {:g} s {:.3f} g", figure_periods_s()[i], f.sa_mps2[i] / standard_gravity_mps2);
  return text + "\n";
}

std::string figures_csv(const std::vector<ToldRecord>& records, const std::filesystem::path& folder) {
  std::string text =
      "file,dt_s,unit,channel,samples,duration_s,pga_g,pgv_mps,pgd_m,arias_mps,cav_mps,significant_5_75_s,"
      "significant_5_95_s,bracketed_0.05g_s";
  for (const double period : figure_periods_s()) text += fmt::format(",sa_{:g}s_g", period);
  text +=
      ",identified_pulse,identified_pulse_period_s,identified_pulse_velocity_mps,identified_pulse_start_s,"
      "identified_pulse_explained\n";
  for (const auto& [file, unit, channel, f] : records) {
    const std::filesystem::path here =
        std::filesystem::absolute(file).lexically_proximate(std::filesystem::absolute(folder));
    text +=
        fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}", csv_text(here.generic_string()), f.step_s,
                    csv_text(unit), csv_text(channel), f.samples, f.duration_s, in_g(f.peaks.pga_mps2), f.peaks.pgv_mps,
                    f.peaks.pgd_m, f.arias_mps, f.cav_mps, f.significant_5_75_s, f.significant_5_95_s, f.bracketed_s);
    for (const double sa : f.sa_mps2) text += fmt::format(",{}", in_g(sa));
    const IdentifiedPulse& p = f.pulse;
    text += p.type.empty()
                ? ",,,,,\n"
                : fmt::format(",{},{},{},{},{}\n", p.type, p.period_s, p.velocity_mps, p.start_s, p.explained);
  }
  return text;
}

std::string floor_csv(const FloorMotion& record) {
  const bool vertical = !record.vertical_mps2.empty();
  std::string text = vertical ? "time_s,floor_acceleration_mps2,floor_vertical_acceleration_mps2\n"
                              : "time_s,floor_acceleration_mps2\n";
  for (std::size_t i = 0; i < record.knot_s.size(); ++i) {
    const std::size_t of = std::min(i, record.segments() - 1);  // the last sample is the end of the last segment
    const double tau = record.knot_s[i] - record.knot_s[of];
    text += fmt::format("{},{}", record.knot_s[i], segment(record, record.horizontal_mps2, of)(tau));
    text += vertical ? fmt::format(",{}\n", segment(record, record.vertical_mps2, of)(tau)) : "\n";
  }
  return text;
}

}  // namespace freestand::motion
