// CSMIP volume 2: for each channel text lines ("Chan  1:  H1"), header numbers, then
//   "  7500 points of accel data equally spaced at  .010 sec, in cm/sec2. (8f10.6)"
// and the values in columns; velocity and displacement follow, in blocks of their own, and are left unread.
#include <algorithm>

#include "motion/record_channels.hpp"
#include "motion/record_format.hpp"

namespace freestand::motion::format_csmip_v2 {
namespace {

constexpr std::string_view block_mark = "points of accel data", step_mark = "spaced at", unit_mark = " in ";

bool recognises(const RecordText& text) {
  return text.find(block_mark, 0, 120) < std::min<std::size_t>(text.size(), 120);
}

std::string unit_of(std::string_view header) {
  const std::size_t place = lower_case(header).find(unit_mark);
  if (place == std::string::npos) return "cm/s2";
  const auto parts = split(header.substr(place + unit_mark.size()), " ()");
  if (parts.empty()) return "cm/s2";
  const std::string_view unit = parts.front();
  return std::string(unit.substr(0, unit.find_last_not_of(".,") + 1));
}

// Name behind the channel's last "Chan n:" line before its block.
std::string name_of(const RecordText& text, std::size_t from, std::size_t block) {
  for (std::size_t line = block; line-- > from;) {
    const std::string_view words = trim(text.line(line));
    const std::size_t colon = words.find(':');
    if (lower_case(words.substr(0, 4)) == "chan" && colon != std::string_view::npos)
      return std::string(trim(words.substr(colon + 1)));
  }
  return "";
}

RawRecord read(const RecordText& text) {
  RawRecord record;
  std::size_t from = 0;
  for (std::size_t line = text.find(block_mark); line < text.size(); line = text.find(block_mark, from)) {
    const std::string_view header = text.line(line);
    const std::size_t header_line = line++;
    const std::size_t spaced = lower_case(header).find(step_mark);
    if (spaced == std::string::npos)
      text.fail(header_line, "no time step (\"equally spaced at\" is missing): get the file again");
    const auto step = split(header.substr(spaced + step_mark.size()), " ");
    if (step.empty()) text.fail(header_line, "no time step (the header line is cut): get the file again");
    const std::size_t count = text.count(header_line, split(header, " ").front());
    const std::string_view format = header.substr(std::min(header.rfind('('), header.size()));
    agree(text, header_line, record, text.number(header_line, step.front()), unit_of(header));
    RawChannel channel = named_channel(name_of(text, from, header_line));
    channel.values = oriented(channel, text.block(line, count, column_width(format)));
    text.no_numbers_at(line, count);
    record.channels.push_back(std::move(channel));
    from = line;
  }
  return record;
}

const RegisteredFormat here{{.name = "csmip_v2",
                             .summary = "CSMIP volume 2 (.V2): one or several channels, cm/s2",
                             .recognises = recognises,
                             .read = read}};

}  // namespace
}  // namespace freestand::motion::format_csmip_v2
