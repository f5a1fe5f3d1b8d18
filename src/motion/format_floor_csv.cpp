// freestand's own csv: a header line of column names, among them time_s, floor_acceleration_mps2 and perhaps
// floor_vertical_acceleration_mps2. Other columns (as in histories and measured tests) are left unread, but none that is another
// acceleration of the floor.
#include <fmt/format.h>

#include <algorithm>

#include "base/shown_text.hpp"
#include "motion/record_format.hpp"

namespace freestand::motion::format_floor_csv {
namespace {

constexpr std::string_view time_name = "time_s", horizontal_name = "floor_acceleration_mps2",
                           vertical_name = "floor_vertical_acceleration_mps2";

std::size_t header_line(const RecordText& text) {
  std::size_t line = 0;
  while (line < text.size() && (trim(text.line(line)).empty() || text.line(line)[0] == '#')) ++line;
  return line;
}

bool recognises(const RecordText& text) {
  const auto names = cells(text.line(header_line(text)));
  return std::find(names.begin(), names.end(), time_name) != names.end();
}

RawRecord read(const RecordText& text) {
  const std::size_t header = header_line(text);
  const auto names = cells(text.line(header));
  const auto place = [&](std::string_view name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  const std::size_t time = place(time_name), horizontal = place(horizontal_name), vertical = place(vertical_name);
  if (horizontal == names.size())
    text.fail(header, fmt::format("no column {} (the columns are {}): add it, in m/s2", horizontal_name,
                                  shown(trim(text.line(header)), 200)));
  for (const auto& name : names) {
    const bool known = name == horizontal_name || name == vertical_name;
    if (std::count(names.begin(), names.end(), name) > 1 && (known || name == time_name))
      text.fail(header, fmt::format("column {} stands twice: leave one", name));
    if (!known && name.rfind("floor_", 0) == 0 && name.find("acceleration") != std::string_view::npos)
      text.fail(header,
                fmt::format("column {} would be left unread (those that are read are {} and {}): rename it, write the "
                            "second horizontal direction into a file of its own (cross_file), or remove the column",
                            shown(name, 60), horizontal_name, vertical_name));
  }
  std::vector<double> times;
  std::vector<std::size_t> lines;
  RawRecord record{{}, "m/s2", {RawChannel{"horizontal", false, {}}}};
  if (vertical < names.size()) record.channels.push_back({"vertical", true, {}});
  for (std::size_t line = header + 1; line < text.size(); ++line) {
    if (trim(text.line(line)).empty()) continue;
    const auto row = cells(text.line(line));
    if (row.size() != names.size())
      text.fail(line, fmt::format("{} columns (the header has {}): correct the line", row.size(), names.size()));
    times.push_back(text.number(line, row[time]));
    lines.push_back(line);
    record.channels[0].values.push_back(text.number(line, row[horizontal]));
    if (vertical < names.size()) record.channels[1].values.push_back(text.number(line, row[vertical]));
  }
  text.whole_to_its_end(header + 1);
  record.dt_s = text.even_step(times, lines);
  record.start = text.start_of(times);
  return record;
}

const RegisteredFormat here{{.name = "floor_csv",
                             .summary = "csv with columns time_s, floor_acceleration_mps2 "
                                        "[, floor_vertical_acceleration_mps2], constant step",
                             .recognises = recognises,
                             .read = read,
                             .vertical_word = [](const RecordText&) { return std::optional<std::string>(""); }}};

}  // namespace
}  // namespace freestand::motion::format_floor_csv
