// USGS SMC: 11 lines of text, 48 integers in columns of 10, 50 reals in columns of 15, comment lines, then
// accelerations in cm/s2 in columns of 10. Integer 16 counts the comment lines, integer 17 the values; real 2 is the
// sampling rate.
#include <fmt/format.h>

#include <algorithm>

#include "motion/component.hpp"
#include "motion/record_format.hpp"

namespace freestand::motion::format_smc {
namespace {

constexpr std::size_t text_lines = 11, integers = 48, reals = 50, integer_width = 10, real_width = 15, value_width = 10;

bool recognises(const RecordText& text) {
  return lower_case(text.line(0)).find("accelerogram") != std::string::npos && text.line(1).substr(0, 1) == "*";
}

std::size_t whole(const RecordText& text, std::size_t line, double value) {
  if (!(value >= 0 && value < 1e12))
    text.fail(line, fmt::format("the header says {} where a count stands (unknown): get the file again", value));
  return static_cast<std::size_t>(value);
}

// One of the lines of text ends in "component=   up".
std::optional<std::string> vertical_word(const RecordText& text) {
  const std::size_t line = text.find("component=", 0, text_lines);
  if (line >= std::min(text.size(), text_lines)) return {};
  const std::string words = lower_case(text.line(line));
  const auto component = split(std::string_view(words).substr(words.find("component=") + 10), " ");
  return !component.empty() && is_vertical_word(component.front()) ? std::string(component.front()) : "";
}

RawRecord read(const RecordText& text) {
  std::size_t line = text_lines;
  const std::vector<double> integer = text.block(line, integers, integer_width);
  const std::vector<double> real = text.block(line, reals, real_width);
  const std::size_t comments = whole(text, text_lines + 1, integer[15]),
                    count = whole(text, text_lines + 2, integer[16]);
  if (!(real[1] > 0))
    text.fail(text_lines + 6, fmt::format("the sampling rate is {} (not positive): get the file again", real[1]));
  line += comments;
  RawRecord record{1 / real[1], "cm/s2", {RawChannel{}}};
  record.channels[0].values = text.block(line, count, value_width);
  text.ends_at(line, count);
  return record;
}

const RegisteredFormat here{{.name = "smc",
                             .summary = "USGS SMC accelerogram, one channel, cm/s2",
                             .recognises = recognises,
                             .read = read,
                             .vertical_word = vertical_word}};

}  // namespace
}  // namespace freestand::motion::format_smc
