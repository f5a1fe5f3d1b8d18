// What is done to a record before it shakes anything, and what is known of its pulse: keys of an entry of `motions`, of the
// motion of a case and of a measured test.
#include <fmt/format.h>

#include <algorithm>

#include "study/read_parts.hpp"

namespace freestand::study {
namespace {

// Models on shake tables are down to some hundredths of what they stand for; lengths go with the square of times.
constexpr Range length_range = {.lower = 1e-4,
                                .upper = 1e4,
                                .lower_open = false,
                                .upper_open = false,
                                .why = "it must lie from 1e-4 to 1e4: a quarter-scale model has length_scale 0.25"};
constexpr Range time_range = {.lower = 1e-2,
                              .upper = 1e2,
                              .lower_open = false,
                              .upper_open = false,
                              .why = "it must lie from 0.01 to 100: a quarter-scale model has time_scale 0.5"};
constexpr Range pulse_period_range = {.lower = 0, .why = "a period must be above zero"};

std::optional<motion::BandPass> read_band(Section& section) {
  if (!section.has("band_pass_hz")) return {};
  const std::vector<double> corners = section.numbers("band_pass_hz");
  if (corners.size() == 2 && corners[0] > 0 && corners[0] < corners[1]) return motion::BandPass{corners[0], corners[1]};
  section.problem("band_pass_hz", fmt::format("{} is no band (two frequencies above zero, the lower first): write "
                                              "band_pass_hz: [0.1, 25]",
                                              section.name("band_pass_hz")));
  return {};
}

}  // namespace

const std::vector<std::string>& processing_keys() {
  static const std::vector<std::string> keys = {"baseline", "band_pass_hz", "time_scale", "length_scale"};
  return keys;
}

motion::Processing read_processing(Section& section) {
  motion::Processing wanted;
  const bool baseline = section.has("baseline");
  const auto chosen = section.choice("baseline", {"linear", "quadratic"}, 0);
  if (baseline) wanted.baseline = static_cast<motion::Baseline>(chosen);
  wanted.band = read_band(section);
  const auto time = section.optional_number("time_scale", time_range);
  const auto length = section.optional_number("length_scale", length_range);
  if (time || length) wanted.scale = motion::similitude(time, length);
  return wanted;
}

motion::KnownPulse read_known_pulse(Section& section) {
  motion::KnownPulse known;
  known.type = section.text("pulse_type", "");
  known.period_s = section.optional_number("pulse_period_s", pulse_period_range);
  const auto& types = motion::pulse_types();
  if (known.type.empty() || std::find(types.begin(), types.end(), known.type) != types.end()) return known;
  section.problem("pulse_type", fmt::format("{} is {} (the pulse of a record is one of {}): name one of these",
                                            section.name("pulse_type"), known.type, joined(types)));
  return {"", known.period_s};
}

}  // namespace freestand::study
