// Collects every problem of a file, to report them all at once.
#pragma once

#include <freestand/error.hpp>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/key_names.hpp"

namespace freestand::study {

class Problems {
 public:
  // file: the name that stands before each line number.
  explicit Problems(std::string file) : file_(std::move(file)) {}

  // text: "problem (why): what to do". line: 1, 2 ...; 0 for what belongs to no line.
  void add(int line, std::string text);

  // All of another's, whatever its file; at this line, where one is given, those that stand on a line before `end`.
  void add(const Problems& more, int line = 0, int end = std::numeric_limits<int>::max());

  bool empty() const { return entries_.empty(); }
  std::size_t count() const { return entries_.size(); }

  // "file:line: problem (why): what to do", one a line, in the order of the file.
  std::string text() const;

  // Throws one Error with all of them, if there are any.
  void throw_if_any(Exit exit = Exit::usage) const;

 private:
  struct Entry {
    int line;
    std::string text;
  };
  std::string file_;
  std::vector<Entry> entries_;
  std::set<std::pair<int, std::string>> told_;
};

// One line a text, in the order of their first: "text", or "text; and the same of b, c and 12 more" where it is that of several but
// for the subject's name in it.
struct Refusal {
  std::string subject, text;
  std::string place = {};  // stands before the text, "INDEX.csv:5"
};
std::vector<std::string> told_once(const std::vector<Refusal>&);

// "did you mean delta?" or, when nothing is near, "known: delta, overturned".
std::string hint(std::string_view word, const std::vector<std::string>& candidates);

std::string joined(const std::vector<std::string>& words);

// The same of the first few: "a, b, c and 12 more".
std::string some(const std::vector<std::string>& words, std::size_t few = 5);

}  // namespace freestand::study
