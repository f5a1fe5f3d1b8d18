#include "motion/record_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <freestand/error.hpp>
#include <fstream>

#include "base/shown_text.hpp"

namespace freestand::motion {
namespace {

constexpr std::string_view blanks = " \t\v\f\x1a";  // old files end in the last of these
constexpr std::string_view separators = " \t\v\f\x1a,;";

std::string read_file(const std::filesystem::path& path, std::size_t most_bytes) {
  const auto refuse = [&](const std::string& why) {
    throw Error(fmt::format("cannot read the record {} ({}): check the path", path.string(), why), Exit::data);
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) refuse("it is a folder");
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(std::strerror(errno));
  std::string content;
  std::array<char, 65536> part;
  while (file && content.size() < most_bytes) {
    file.read(part.data(), static_cast<std::streamsize>(std::min(part.size(), most_bytes - content.size())));
    content.append(part.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad()) refuse("it broke off");
  return content;
}

std::vector<std::string_view> split_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    const bool pair = end + 1 < text.size() && text[end] == '\r' && text[end + 1] == '\n';
    begin = end + (pair ? 2 : 1);
  }
  return lines;
}

// The longest number at the start of `text`, taken off it. Fortran's D for E; nothing taken if there is none.
struct Number {
  double value = 0;
  std::size_t length = 0;
  std::errc error = std::errc::invalid_argument;
};
Number leading_number(std::string_view text) {
  char buffer[64];
  const std::size_t plus = !text.empty() && text[0] == '+' ? 1 : 0;
  if (plus && text.size() > 1 && (text[1] == '-' || text[1] == '+')) return {};
  const std::size_t size = std::min(text.size() - plus, sizeof buffer);
  std::transform(text.begin() + static_cast<std::ptrdiff_t>(plus),
                 text.begin() + static_cast<std::ptrdiff_t>(plus + size), buffer,
                 [](char c) { return c == 'D' || c == 'd' ? 'E' : c; });
  Number number;
  const auto [end, error] = std::from_chars(buffer, buffer + size, number.value);
  number.error = error;
  number.length = static_cast<std::size_t>(end - buffer) + plus;
  return number;
}

}  // namespace

RecordText::RecordText(const std::filesystem::path& path, std::size_t most_bytes)
    : path_(path), content_(read_file(path, most_bytes)) {
  std::string_view text = content_;
  if (text.substr(0, 2) == "\xFF\xFE" || text.substr(0, 2) == "\xFE\xFF")
    fail("the file is in UTF-16 (a table program's \"Unicode text\"): write it out again as plain text or UTF-8");
  if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos)
    fail(fmt::format("no text but a binary file (byte {} is zero): write it out as text", zero + 1));
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  lines_ = split_lines(text);
  while (!lines_.empty() && trim(lines_.back()).empty()) lines_.pop_back();
  if (lines_.empty()) fail("no record in the file (it is empty): get the file again");
}

void RecordText::fail(std::size_t line, const std::string& text) const {
  throw Error(fmt::format("{}:{}: {}", path_.string(), line + 1, text), Exit::data);
}

void RecordText::fail(const std::string& text) const {
  throw Error(fmt::format("{}: {}", path_.string(), text), Exit::data);
}

std::size_t RecordText::find(std::string_view wanted, std::size_t from, std::size_t until) const {
  const std::string key = lower_case(wanted);
  for (std::size_t i = from; i < std::min(until, size()); ++i)
    if (lower_case(lines_[i]).find(key) != std::string::npos) return i;
  return size();
}

double RecordText::number(std::size_t line, std::string_view token) const {
  const Number number = leading_number(token);
  const auto refuse = [&](const char* why) {
    fail(line, fmt::format("cannot read the number \"{}\" ({}): correct the file or get it again", shown(token), why));
  };
  if (number.error == std::errc::result_out_of_range) refuse("beyond the range of numbers");
  if (number.error != std::errc() || number.length != token.size()) refuse("it is not a number");
  if (!std::isfinite(number.value)) refuse("it is not finite");
  return number.value;
}

std::size_t RecordText::count(std::size_t line, std::string_view token) const {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  if (error != std::errc() || end != token.data() + token.size())
    fail(line,
         fmt::format("cannot read the count \"{}\" (it is not a whole number): correct the header", shown(token)));
  return value;
}

void RecordText::numbers(std::size_t line, std::vector<double>& out) const {
  for (std::string_view token : split(lines_[line], separators)) {
    while (!token.empty()) {
      const Number first = leading_number(token);
      const bool runs_on = first.error == std::errc() && first.length < token.size() &&
                           (token[first.length] == '-' || token[first.length] == '+');
      const std::size_t taken = runs_on ? first.length : token.size();
      out.push_back(number(line, token.substr(0, taken)));
      token.remove_prefix(taken);
    }
  }
}

void RecordText::columns(std::size_t line, std::size_t width, std::vector<double>& out) const {
  const std::string_view text = lines_[line].substr(0, lines_[line].find_last_not_of(blanks) + 1);
  for (std::size_t begin = 0; begin < text.size(); begin += width) {
    const std::string_view field = trim(text.substr(begin, width));
    if (field.empty())
      fail(line, fmt::format("a blank where column {} stands (a number is missing): get the file again", begin + 1));
    out.push_back(number(line, field));
  }
}

std::vector<double> RecordText::block(std::size_t& line, std::size_t expected, std::size_t width) const {
  std::vector<double> values;
  values.reserve(std::min<std::size_t>(expected, 64 * size()));
  const std::size_t first = line;
  for (; line < size() && values.size() < expected; ++line)
    width == 0 ? numbers(line, values) : columns(line, width, values);
  if (values.size() < expected)
    fail(size() - 1, fmt::format("the record ends after {} values (the header says {}): get the whole file",
                                 values.size(), expected));
  if (values.size() > expected) surplus(line - 1, expected);
  if (line == size()) whole_to_its_end(first);
  return values;
}

void RecordText::whole_to_its_end(std::size_t line) const {
  constexpr std::string_view of_numbers = "0123456789.+-eEdD";
  if (of_numbers.find(content_.back()) == std::string_view::npos) return;
  const auto places = [](std::string_view text) {
    const std::string_view last = split(text, separators).back();
    return last.size() - std::min(last.find('.'), last.size());
  };
  std::size_t least = static_cast<std::size_t>(-1);
  for (; line + 1 < size(); ++line)
    if (const std::string_view text = trim(lines_[line]);
        !text.empty() && of_numbers.find(text.back()) != std::string_view::npos)
      least = std::min(least, places(text));
  if (least != static_cast<std::size_t>(-1) && places(lines_.back()) < least)
    fail(size() - 1,
         "the line has no end, and its number fewer digits than any other (the file was cut off there): get the whole "
         "file; if it is whole, end its last line");
}

void RecordText::ends_at(std::size_t line, std::size_t expected) const {
  for (; line < size(); ++line)
    if (!trim(lines_[line]).empty()) surplus(line, expected);
}

void RecordText::no_numbers_at(std::size_t line, std::size_t expected) const {
  while (line < size() && trim(lines_[line]).empty()) ++line;
  if (line < size() && lines_[line].find_first_not_of("0123456789.+-eEdD \t") == std::string_view::npos)
    surplus(line, expected);
}

void RecordText::surplus(std::size_t line, std::size_t expected) const {
  fail(line, fmt::format("more values here (the header says {} in all): correct the header or the file", expected));
}

double RecordText::even_step(const std::vector<double>& times, const std::vector<std::size_t>& lines) const {
  if (times.size() < 2) fail("fewer than two samples (no time step can be found): get the whole file");
  const double steps = static_cast<double>(times.size() - 1);
  double dt = (times.back() - times.front()) / steps;
  if (!(dt > 0)) fail(lines.back(), "the times do not increase (the last is not after the first): correct the times");
  const double rounded = std::round(dt * 1e9) / 1e9;  // 0.005 rather than 0.00500000000000012
  if (std::abs(rounded - dt) < std::min(1e-9 * (1 + std::abs(times.back())) / steps, 1e-3 * dt)) dt = rounded;
  for (std::size_t i = 1; i < times.size(); ++i)
    if (std::abs(times[i] - times.front() - static_cast<double>(i) * dt) > 0.05 * dt) uneven(times, lines);
  return dt;
}

std::string RecordText::start_of(const std::vector<double>& times) {
  return std::abs(times.front()) < 1.5 * (times[1] - times[0]) ? "" : fmt::format("{:.9g} s", times.front());
}

// Names the step that differs most from the usual one.
void RecordText::uneven(const std::vector<double>& times, const std::vector<std::size_t>& lines) const {
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  std::vector<double> sorted = steps;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
  const double usual = sorted[sorted.size() / 2];
  const auto worse = [&](double a, double b) { return std::abs(a - usual) < std::abs(b - usual); };
  const auto worst = static_cast<std::size_t>(std::max_element(steps.begin(), steps.end(), worse) - steps.begin());
  fail(lines[worst + 1],
       fmt::format("the time step is not constant ({:.6g} s here, elsewhere {:.6g} s): resample the record",
                   steps[worst], usual));
}

std::size_t column_width(std::string_view fortran) {
  for (std::size_t i = 0; i + 1 < fortran.size(); ++i) {
    if (std::string_view("fegiFEGI").find(fortran[i]) == std::string_view::npos) continue;
    std::size_t width = 0;
    const char* digits = fortran.data() + i + 1;
    if (std::from_chars(digits, fortran.data() + fortran.size(), width).ec == std::errc()) return width;
  }
  return 0;
}

std::string_view trim(std::string_view text) {
  const std::size_t begin = std::min(text.find_first_not_of(blanks), text.size());
  text.remove_prefix(begin);
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

std::vector<std::string_view> split(std::string_view text, std::string_view marks) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = text.find_first_not_of(marks); begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of(marks, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(marks, end);
  }
  return parts;
}

std::vector<std::string_view> cells(std::string_view line) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    parts.push_back(trim(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return parts;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

}  // namespace freestand::motion
