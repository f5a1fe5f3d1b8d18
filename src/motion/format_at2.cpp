// PEER .AT2: header lines of text, then accelerations, several a line. One of the first lines gives count and step,
//   "NPTS=   7995, DT=   .0050 SEC, ..."  or, in old files,  "  7995   .0050   NPTS, DT".
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "motion/component.hpp"
#include "motion/record.hpp"
#include "motion/record_format.hpp"

namespace freestand::motion::format_at2 {
namespace {

constexpr std::size_t header_lines = 12;  // at most

std::size_t count_line(const RecordText& text) { return text.find("npts", 0, header_lines); }

// What stands behind `key` and an optional "=" in a line; empty where the key is missing.
std::string_view value_of(std::string_view line, std::string_view key) {
  const std::size_t place = lower_case(line).find(key);
  if (place == std::string::npos) return {};
  const auto parts = split(line.substr(place + key.size()), "= \t,");
  return parts.empty() ? std::string_view() : parts.front();
}

struct Size {
  std::size_t count;
  double dt_s;
};

Size read_size(const RecordText& text, std::size_t line) {
  const std::string_view header = text.line(line);
  if (header.find('=') == std::string_view::npos) {
    const auto parts = split(header, " \t,");
    if (parts.size() < 3)
      text.fail(line, "no count and step before \"NPTS, DT\" (the header is cut): get the file again");
    return {text.count(line, parts[0]), text.number(line, parts[1])};
  }
  const std::string_view count = value_of(header, "npts"), dt = value_of(header, "dt");
  if (count.empty() || dt.empty())
    text.fail(line, "NPTS= or DT= without a value (the header is cut): get the file again");
  const auto behind = split(header.substr(static_cast<std::size_t>(dt.data() + dt.size() - header.data())), " \t,()");
  const std::string unit = behind.empty() ? "" : lower_case(behind.front());
  const bool milliseconds = unit == "ms" || unit.starts_with("msec") || unit.starts_with("milli");
  return {text.count(line, count), text.number(line, dt) * (milliseconds ? 1e-3 : 1)};
}

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// Of an acceleration, known or not: "cm/s-2", "milli-g". No date, and no pair of directions.
bool looks_like_unit(const std::string& word) {
  const bool of_length = is_one_of(word.substr(0, word.find('/')), {"mm", "cm", "m", "in", "ft", "inch", "feet"});
  return is_acceleration_unit(word) || (of_length && word.find('/') != std::string::npos) ||
         is_one_of(word, {"mg", "milli-g", "millig", "%g", "cms2", "cms-2", "cm-s2"});
}

struct Said {
  int rank = 0;  // 0: nothing
  std::string unit = {};
};

std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  for (const std::string_view part : split(line, " \t,()[]:=;")) {
    words.emplace_back(part);
    while (words.back().ends_with('.')) words.back().pop_back();
  }
  return words;
}

bool is_number(const std::string& word) {
  double value = 0;
  return std::from_chars(word.data(), word.data() + word.size(), value).ec == std::errc{};
}

// Where "PEAK ACCELERATION IN G: 0.35" begins, or "PGA = 469.9 CM/S2": in what unit a peak is told says nothing of the motion.
std::size_t told_peak(const std::vector<std::string>& words) {
  constexpr std::size_t near = 5;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (!is_one_of(word, {"pga", "pgv", "pgd", "max", "maximum"}) && !word.starts_with("peak")) continue;
    for (std::size_t k = i + 1; k < std::min(words.size(), i + near); ++k)
      if (is_number(words[k])) return i;
  }
  return words.size();
}

// The unit that a line tells. Most surely by "IN UNITS OF G. FILTER POINTS: ...", where what stands behind is the unit, whether it is known or
// not; then by "UNITS: M/S2", or in the line of the motion itself, "ACCELERATION TIME SERIES IN CM/S2", "ACCELERATION (M/S2)"; least by a unit
// that stands so elsewhere.
Said unit_in(const std::string& line) {
  std::vector<std::string> words = words_of(line);
  words.resize(told_peak(words));
  const auto has = [&](const std::string& word) { return line.find(word) != std::string::npos; };
  const bool of_motion = has("accel") || has("time series") || has("time history") ||
                         std::find(words.begin(), words.end(), "acc") != words.end();
  Said found;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string &word = words[i], before = i > 0 ? words[i - 1] : "";
    if (i > 1 && before == "of" && words[i - 2] == "units") return {3, word};
    const bool stated = is_one_of(before, {"units", "unit"}), behind = is_one_of(before, {"in", "of", "are"});
    const bool enclosed = word != "g" && (has("(" + word + ")") || has("[" + word + "]"));
    const bool parted = i + 1 < words.size() && words[i + 1].starts_with('/') && is_one_of(word, {"mm", "cm", "m"});
    const bool known = is_acceleration_unit(word), bare = of_motion && ((known && word != "g") || word == "%g");
    if (found.rank < 2 &&
        (bare || ((stated || (of_motion && (behind || enclosed))) && (looks_like_unit(word) || parted))))
      found = {2, parted ? word + words[i + 1] : word};
    else if (found.rank == 0 && (behind || enclosed) && known)
      found = {1, word};
  }
  return found;
}

std::string read_unit(const RecordText& text, std::size_t until) {
  Said found;
  for (std::size_t i = 0; i < until; ++i) {
    const std::string line = lower_case(text.line(i));
    if (line.find("velocity time") != std::string::npos || line.find("displacement time") != std::string::npos)
      text.fail(i, "not a record of acceleration (the header says so): use the .AT2 file");
    if (Said said = unit_in(line); said.rank > found.rank) found = std::move(said);
  }
  return found.unit;
}

// The last entry of the line of event, date, station and component: "..., Corralitos, UP".
std::optional<std::string> vertical_word(const RecordText& text) {
  for (std::size_t i = 0; i < count_line(text) && i < text.size(); ++i) {
    const auto entries = split(text.line(i), ",");
    if (entries.size() < 3) continue;
    const auto component = split(entries.back(), " \t(");
    if (!component.empty() && is_vertical_word(component.front())) return std::string(component.front());
  }
  return {};
}

bool recognises(const RecordText& text) { return count_line(text) < std::min(text.size(), header_lines); }

RawRecord read(const RecordText& text) {
  std::size_t line = count_line(text);
  const Size size = read_size(text, line);
  RawRecord record{size.dt_s, read_unit(text, line), {RawChannel{}}, "g"};
  ++line;
  record.channels[0].values = text.block(line, size.count);
  text.ends_at(line, size.count);
  return record;
}

const RegisteredFormat here{{.name = "at2",
                             .summary = "PEER .AT2: NPTS= and DT= in the header, accelerations in g",
                             .recognises = recognises,
                             .read = read,
                             .vertical_word = vertical_word}};

}  // namespace
}  // namespace freestand::motion::format_at2
