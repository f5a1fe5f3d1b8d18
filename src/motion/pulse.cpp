#include "motion/pulse.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <freestand/error.hpp>

#include "motion/pulse_family.hpp"

namespace freestand::motion {
namespace {

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// "c7" of family "Cn" -> 7; 0 when it is not one of them.
int number_in(const std::string& name, const PulseFamily& family) {
  const std::string stem = lower(family.name.substr(0, family.name.size() - 1));
  if (name.rfind(stem, 0) != 0 || name.size() == stem.size() || name[stem.size()] == '0') return 0;
  int n = 0;
  const char* end = name.data() + name.size();
  const auto [rest, error] = std::from_chars(name.data() + stem.size(), end, n);
  return error == std::errc() && rest == end && n >= 1 && n <= 1000 ? n : 0;
}

bool goes_by(const std::string& name, const PulseFamily& family) {
  const auto same = [&](const std::string& other) { return lower(other) == name; };
  return same(family.name) || std::any_of(family.aliases.begin(), family.aliases.end(), same);
}

}  // namespace

Pulse find_pulse(const std::string& name) {
  const std::string wanted = lower(name);
  for (const PulseFamily& family : registry<PulseFamily>()) {
    if (!family.numbered && goes_by(wanted, family)) return family.make(0);
    if (const int n = family.numbered ? number_in(wanted, family) : 0) return family.make(n);
  }
  std::string known;
  for (const std::string& one : pulse_names()) known += (known.empty() ? "" : ", ") + one;
  throw Error("no pulse \"" + name + "\" (the pulses are " + known +
              "; n in Cn counts cycles, as in C1): name one of these");
}

std::vector<std::string> pulse_names() {
  std::vector<std::string> names;
  for (const PulseFamily& family : registry<PulseFamily>()) {
    names.push_back(family.name);
    names.insert(names.end(), family.aliases.begin(), family.aliases.end());
  }
  return names;
}

double acceleration_of_peak_velocity(const Pulse& pulse, double velocity_mps, double period_s) {
  return velocity_mps / (pulse.peak_velocity * period_s);
}

double acceleration_of_velocity_amplitude(const Pulse& pulse, double velocity_mps, double period_s) {
  return velocity_mps / (pulse.velocity_amplitude * period_s);
}

}  // namespace freestand::motion
