// COSMOS format v1.20 (.V1c, .V2c): for each channel text lines, then blocks that say what they hold,
//   " 100 Real-header values follow on  20 lines, Format= (5F15.6)",
//   " 12091 acceleration pts, approx  120 secs, units=cm/s^2 (4),Format=(10F8.5)".
// The step is entry 62 of the real header, in ms, or entry 34, in s. Velocities and displacements are left unread.
#include <algorithm>

#include "motion/record_channels.hpp"
#include "motion/record_format.hpp"

namespace freestand::motion::format_cosmos_v2 {
namespace {

constexpr std::string_view data_mark = "acceleration pts", real_mark = "real-header values", channel_mark = "sta chan";
constexpr std::size_t ms_entry = 61, s_entry = 33;
constexpr double unknown = -999;

bool recognises(const RecordText& text) {
  return lower_case(text.line(0)).find("(format v") != std::string::npos && text.find(real_mark) < text.size();
}

std::string_view behind(std::string_view line, std::string_view key) {
  const std::size_t place = lower_case(line).find(key);
  return place == std::string::npos ? std::string_view() : line.substr(place + key.size());
}

double step_of(const RecordText& text, std::size_t from, std::size_t data_line) {
  const std::size_t header_line = text.find(real_mark, from, data_line);
  if (header_line >= data_line) text.fail(data_line, "no real header before the data (the file is cut): get it again");
  const std::string_view header = text.line(header_line);
  const std::size_t count = text.count(header_line, split(header, " ").front());
  std::size_t line = header_line + 1;
  const std::vector<double> values = text.block(line, count, column_width(behind(header, "format")));
  if (values.size() > ms_entry && values[ms_entry] != unknown && values[ms_entry] > 0) return values[ms_entry] / 1000;
  if (values.size() > s_entry && values[s_entry] != unknown) return values[s_entry];
  text.fail(header_line, "no time step in the real header (entries 34 and 62 are unknown): get the file again");
}

// "Sta Chan   1: 90 deg (Rcrdr Chan  1) Location:" -> "90 deg"
std::string name_of(const RecordText& text, std::size_t from, std::size_t data_line) {
  const std::size_t line = text.find(channel_mark, from, data_line);
  if (line >= data_line) return "";
  const std::string_view words = text.line(line);
  const std::size_t colon = std::min(words.find(':'), words.size() - 1);
  const std::string_view name = words.substr(colon + 1);
  return std::string(trim(name.substr(0, name.find('('))));
}

RawRecord read(const RecordText& text) {
  RawRecord record;
  std::size_t from = 0;
  for (std::size_t line = text.find(data_mark); line < text.size(); line = text.find(data_mark, from)) {
    const std::size_t header_line = line++;
    const std::string_view header = text.line(header_line);
    const auto unit = split(behind(header, "units="), " ,(");
    if (unit.empty()) text.fail(header_line, "no unit (\"units=\" is missing): get the file again");
    if (lower_case(unit.front()) == "counts")
      text.fail(header_line, "raw counts (a volume 0 file): use the corrected record, volume 1 or 2");
    agree(text, header_line, record, step_of(text, from, header_line), std::string(unit.front()));
    RawChannel channel = named_channel(name_of(text, from, header_line));
    const std::size_t count = text.count(header_line, split(header, " ").front());
    channel.values = oriented(channel, text.block(line, count, column_width(behind(header, "format="))));
    text.no_numbers_at(line, count);
    record.channels.push_back(std::move(channel));
    from = line;
  }
  if (record.channels.empty()) text.fail("no acceleration in the file (it holds none): use the acceleration record");
  return record;
}

const RegisteredFormat here{{.name = "cosmos_v2",
                             .summary = "COSMOS v1.20 (.V1c, .V2c): one or several channels",
                             .recognises = recognises,
                             .read = read}};

}  // namespace
}  // namespace freestand::motion::format_cosmos_v2
