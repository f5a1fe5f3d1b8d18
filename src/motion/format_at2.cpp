// PEER .AT2: header lines of text, then accelerations, several a line. One of the first lines gives count and step,
//   "NPTS=   7995, DT=   .0050 SEC, ..."  or, in old files,  "  7995   .0050   NPTS, DT".
#include <fmt/format.h>

#include <algorithm>
#include <freestand/error.hpp>
#include <string>
#include <string_view>
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
  const std::string unit =
      lower_case(std::string(header.substr(static_cast<std::size_t>(dt.data() + dt.size() - header.data()))));
  const auto behind = split(unit, " \t,");
  const bool milliseconds = !behind.empty() && (behind.front() == "msec" || behind.front() == "ms");
  return {text.count(line, count), text.number(line, dt) * (milliseconds ? 1e-3 : 1)};
}

bool is_unit(const std::string& word) {
  try {
    return acceleration_unit_mps2(word) > 0;
  } catch (const Error&) {
    return false;
  }
}

// Known or not: "cm/s**2", "%g", "milli-g".
bool looks_like_unit(const std::string& word) {
  return is_unit(word) || word.find_first_of("/%*^") != std::string::npos || word.ends_with("-g") || word == "mg" ||
         word == "cm" || word == "mm" || word == "m" || word == "cms2" || word == "ms2";
}

std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  for (const std::string_view part : split(line, " \t,()[]:=;")) {
    words.emplace_back(part);
    while (words.back().ends_with('.')) words.back().pop_back();
  }
  return words;
}

// "IN UNITS OF G. FILTER POINTS: ...": what stands behind is the unit, whether it is known or not.
std::string named_unit(const std::string& line) {
  const auto words = words_of(line);
  for (std::size_t i = 2; i < words.size(); ++i)
    if (words[i - 1] == "of" && words[i - 2] == "units") return words[i];
  return "";
}

// "UNITS: M/S2", "TIME SERIES IN CM/S2", "ACCELERATION (M/S2)". One with a slash is one wherever it stands.
std::string unit_in(const std::string& line) {
  const auto words = words_of(line);
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string &word = words[i], before = i > 0 ? words[i - 1] : "";
    const bool stated = before == "units" || before == "unit";
    if (stated && (looks_like_unit(word) || line.find(before + ":") != std::string::npos)) return word;
    const bool behind = before == "in" || before == "of" || before == "are";
    const bool enclosed =
        line.find("(" + word + ")") != std::string::npos || line.find("[" + word + "]") != std::string::npos;
    const bool of_acceleration =
        line.find("accel") != std::string::npos || line.find("time series") != std::string::npos;
    if ((behind || (enclosed && word != "g")) && (of_acceleration ? looks_like_unit(word) : is_unit(word))) return word;
    if (word.find('/') != std::string::npos && is_unit(word)) return word;
  }
  return "";
}

std::string read_unit(const RecordText& text, std::size_t until) {
  std::string found;
  for (std::size_t i = 0; i < until; ++i) {
    const std::string line = lower_case(text.line(i));
    if (line.find("velocity time series") != std::string::npos ||
        line.find("displacement time series") != std::string::npos)
      text.fail(i, "not a record of acceleration (the header says so): use the .AT2 file");
    if (const std::string unit = named_unit(line); !unit.empty()) return unit;
    // A station may be called (GAL): the line of the motion itself comes later.
    if (const std::string unit = unit_in(line); !unit.empty()) found = unit;
  }
  return found;
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
