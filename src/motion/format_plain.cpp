// Plain columns of numbers, without header: one column (accelerations; the user gives step and unit) or two (times and
// accelerations; the user gives the unit). Lines that start with # or % are comments.
#include <fmt/format.h>

#include "motion/record_format.hpp"

namespace freestand::motion::format_plain {
namespace {

bool is_comment(std::string_view line) {
  const std::string_view text = trim(line);
  return text.empty() || text[0] == '#' || text[0] == '%';
}

std::size_t first_line(const RecordText& text) {
  std::size_t line = 0;
  while (line < text.size() && is_comment(text.line(line))) ++line;
  return line;
}

bool recognises(const RecordText& text) {
  const std::string_view line = trim(text.line(first_line(text)));
  return !line.empty() && line.find_first_not_of("0123456789+-.eEdD,; \t") == std::string_view::npos &&
         line.find_first_of("0123456789") < line.size();
}

// A comma between two digits, in a line that is parted by something else.
bool has_decimal_commas(std::string_view line) {
  const auto digit = [&](std::size_t i) { return i < line.size() && line[i] >= '0' && line[i] <= '9'; };
  std::size_t commas = 0;
  for (std::size_t i = 1; i < line.size(); ++i) commas += line[i] == ',' && digit(i - 1) && digit(i + 1);
  return commas > 0 && trim(line).find_first_of("; \t") != std::string_view::npos;
}

RawRecord read(const RecordText& text) {
  RawRecord record{{}, "", {RawChannel{}}};
  std::vector<double> row, times;
  std::vector<std::size_t> lines;
  std::size_t columns = 0;
  for (std::size_t line = first_line(text); line < text.size(); ++line) {
    if (is_comment(text.line(line))) continue;
    row.clear();
    text.numbers(line, row);
    if (columns == 0) columns = row.size();
    if (columns > 2 && has_decimal_commas(text.line(line)))
      text.fail(line,
                "decimal commas (records are written with points): write points, or take `freestand import` for "
                "measurements");
    if (columns > 2)
      text.fail(line, fmt::format("{} columns without a header (plain records have one, or time and acceleration): "
                                  "name the columns as in a floor csv",
                                  columns));
    if (row.size() != columns)
      text.fail(line, fmt::format("{} columns (the first line has {}): correct the line", row.size(), columns));
    if (columns == 2) times.push_back(row.front());
    lines.push_back(line);
    record.channels[0].values.push_back(row.back());
  }
  text.whole_to_its_end(first_line(text));
  if (columns == 2) {
    record.dt_s = text.even_step(times, lines);
    record.start = text.start_of(times);
  }
  return record;
}

const RegisteredFormat here{{.name = "plain",
                             .summary = "one column of accelerations (give dt_s and unit), or time and acceleration "
                                        "(give the unit)",
                             .recognises = recognises,
                             .read = read}};

}  // namespace
}  // namespace freestand::motion::format_plain
