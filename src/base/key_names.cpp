#include "base/key_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace freestand {
namespace {

struct Suffix {
  std::string_view suffix;
  const char* unit;
  bool si = true;
};
constexpr bool other = false;  // of another system

// Longer suffixes before the shorter ones that they end with. Units that freestand does not use stand here so that a
// key such as width_mm is recognised as a width.
constexpr std::array<Suffix, 24> suffixes = {{
    {"_per_s", "1/s"},
    {"_radps", "rad/s"},
    {"_mps2", "m/s2"},
    {"_cmps2", "cm/s2", other},
    {"_mps", "m/s"},
    {"_cmps", "cm/s", other},
    {"_inps", "in/s", other},
    {"_rad", "rad"},
    {"_deg", "deg", other},
    {"_mm", "mm", other},
    {"_cm", "cm", other},
    {"_in", "in", other},
    {"_ft", "ft", other},
    {"_kg", "kg"},
    {"_lb", "lb", other},
    {"_hz", "Hz"},
    {"_ms", "ms", other},
    {"_min", "min", other},
    {"_gal", "gal", other},
    {"_m", "m"},
    {"_s", "s"},
    {"_g", "g", other},
    {"_n", "N"},
    {"_hzps", "Hz/s"},
}};

const Suffix* suffix_of(std::string_view name) {
  if (name == "mu_s" || name.ends_with(".mu_s")) return nullptr;  // s for static
  for (const auto& s : suffixes)
    if (name.size() > s.suffix.size() && name.ends_with(s.suffix)) return &s;
  return nullptr;
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (exchanged) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = last;
    last = row;
  }
  return last[b.size()];
}

std::string nearest(std::string_view given, const std::vector<std::string>& candidates) {
  std::string word(given);
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  int least = std::max(1, static_cast<int>(word.size()) / 3) + 1;
  std::string found;
  for (const auto& candidate : candidates) {
    if (without_unit(candidate) == word) return candidate;
    const int distance = edit_distance(word, candidate);
    if (distance < least) {
      least = distance;
      found = candidate;
    }
  }
  return found;
}

std::string unit_of(std::string_view name) {
  const Suffix* suffix = suffix_of(name);
  return suffix ? suffix->unit : "1";
}

bool in_si(std::string_view name) {
  const Suffix* suffix = suffix_of(name);
  return !suffix || suffix->si;
}

std::string_view without_unit(std::string_view name) {
  const Suffix* suffix = suffix_of(name);
  return suffix ? name.substr(0, name.size() - suffix->suffix.size()) : name;
}

}  // namespace freestand
