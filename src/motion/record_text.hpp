// A record as lines of text, and the numbers in it. Errors name file and line.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace freestand::motion {

// The beginning of a record, enough to know its format by: headers are shorter.
inline constexpr std::size_t head_bytes = 16384;

class RecordText {
 public:
  // Reads the file, or its beginning; lines end in LF, CR LF or CR. Throws Error when it cannot be read or is empty.
  explicit RecordText(const std::filesystem::path& path, std::size_t most_bytes = static_cast<std::size_t>(-1));

  std::size_t size() const { return lines_.size(); }
  std::string_view line(std::size_t i) const { return i < lines_.size() ? lines_[i] : std::string_view(); }

  // "path:17: problem (why): what to do", as Error(Exit::data). `line` counts from 0; the message from 1.
  [[noreturn]] void fail(std::size_t line, const std::string& text) const;
  // The same about the whole file.
  [[noreturn]] void fail(const std::string& text) const;

  // First line from `from` on, before `until`, that contains the text whatever the case; size() if there is none.
  std::size_t find(std::string_view wanted, std::size_t from = 0,
                   std::size_t until = static_cast<std::size_t>(-1)) const;

  // The number that `token` is, all of it. Leading '+', missing zeros and Fortran's D exponents are read.
  double number(std::size_t line, std::string_view token) const;
  // A count that `token` is: a whole number that is not negative.
  std::size_t count(std::size_t line, std::string_view token) const;

  // All numbers of a line, parted by blanks or commas, or by nothing where a sign follows ("-.1E-02-.2E-03").
  void numbers(std::size_t line, std::vector<double>& out) const;
  // All numbers of a line in columns of fixed width, blank columns at its end left out.
  void columns(std::size_t line, std::size_t width, std::vector<double>& out) const;

  // The numbers from `line` on until they are `expected`, which must be so at the end of a line; `line` goes behind
  // them. width 0: not in columns.
  std::vector<double> block(std::size_t& line, std::size_t expected, std::size_t width = 0) const;
  // Throws where the last line has no end and its number fewer places behind the point than the last ones of all lines from `line`
  // on: a file that was cut off in the middle of a number.
  void whole_to_its_end(std::size_t line) const;
  // Throws when there is more than blank lines from `line` on.
  void ends_at(std::size_t line, std::size_t expected) const;

  // Throws where the next line that is not blank holds numbers alone: of formats in which something else follows.
  void no_numbers_at(std::size_t line, std::size_t expected) const;

  // Constant step of the times in column order; `lines` says on which line each stands. Throws where a time is further
  // than 5 % of a step off the even grid.
  double even_step(const std::vector<double>& times, const std::vector<std::size_t>& lines) const;
  // In RawRecord's words. A clock that begins with the record, at 0 or after one step, does not say when that was.
  static std::string start_of(const std::vector<double>& times);

  const std::filesystem::path& path() const { return path_; }

 private:
  [[noreturn]] void surplus(std::size_t line, std::size_t expected) const;
  [[noreturn]] void uneven(const std::vector<double>& times, const std::vector<std::size_t>& lines) const;

  std::filesystem::path path_;
  std::string content_;
  std::vector<std::string_view> lines_;
};

// Width of the columns that a Fortran format such as "(8f10.6)" or "8(1PE10.4)" describes; 0 where there is none.
std::size_t column_width(std::string_view fortran);

// Text without blanks at both ends; parts of a text between separators; equality whatever the case.
std::string_view trim(std::string_view text);
std::vector<std::string_view> split(std::string_view text, std::string_view separators);
// Cells of a line of csv, parted by commas, without blanks around them; empty ones are kept.
std::vector<std::string_view> cells(std::string_view line);
std::string lower_case(std::string_view text);

}  // namespace freestand::motion
