// A file of a user as text and as YAML; what is commonly wrong with it is told in words.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "base/folder.hpp"
#include "base/shown_text.hpp"
#include "study/read_parts.hpp"

namespace freestand::study {
namespace {

int line_at(const std::string& text, std::size_t place) {
  return 1 + static_cast<int>(std::count(
                 text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(place, text.size())), '\n'));
}

// Place of the first byte that no text has; the text's size where there is none. The parser reads UTF-16 and UTF-32 by
// their first bytes.
std::size_t no_text_at(const std::string& text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF") || text.starts_with(std::string("\0\0\xFE\xFF", 4)))
    return text.size();
  const auto wrong = [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < 0x20 && c != '\t' && c != '\n' && c != '\r' && c != '\f' && c != '\x1a') || byte == 0x7f;
  };
  return static_cast<std::size_t>(std::find_if(text.begin(), text.end(), wrong) - text.begin());
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// The first line up to `last` that is indented with a tab; 0: none.
int tab_line(const std::vector<std::string>& lines, int last) {
  for (int i = 0; i < std::min(last, static_cast<int>(lines.size())); ++i) {
    const std::string& line = lines[static_cast<std::size_t>(i)];
    const std::size_t word = line.find_first_not_of(" \t");
    if (word != std::string::npos && line.substr(0, word).find('\t') != std::string::npos) return i + 1;
  }
  return 0;
}

// "block: width_m: 0.6, height_m: 1.8": two keys with their colons, and no bracket or quote that could hold them.
bool has_keys_without_braces(const std::string& line) {
  const std::string code = line.substr(0, line.find(" #"));
  const std::size_t first = code.find(": ");
  const std::size_t second = first == std::string::npos ? first : code.find(": ", first + 2);
  return second != std::string::npos && code.find_first_of("{[\"'") > second;
}

void tell_no_yaml(const std::string& text, const YAML::Exception& error, Problems& problems) {
  const int line = error.mark.is_null() ? 0 : error.mark.line + 1;
  const std::vector<std::string> lines = lines_of(text);
  if (const int tab = tab_line(lines, line))
    return problems.add(tab, "a tab indents this line (YAML knows blanks only): replace it by blanks");
  if (line > 0 && line <= static_cast<int>(lines.size()) &&
      has_keys_without_braces(lines[static_cast<std::size_t>(line) - 1]))
    return problems.add(line,
                        "an item without braces (there are several keys on this line): write {key: value, key: "
                        "value}, or each key on a line of its own");
  problems.add(line, fmt::format("this is not YAML ({}): check indentation, colons and brackets here and on the line "
                                 "before",
                                 shown(error.msg, 200)));
}

}  // namespace

std::string read_text(const std::filesystem::path& file) {
  std::ostringstream text;
  text << open_to_read(file, Exit::usage).rdbuf();
  return text.str();
}

std::optional<YAML::Node> parse_yaml(const std::string& text, Problems& problems) {
  if (const std::size_t place = no_text_at(text); place < text.size()) {
    problems.add(
        line_at(text, place),
        fmt::format("no text but a binary file (its byte {} is {:#04x}): give the file that was written as text",
                    place + 1, static_cast<unsigned>(static_cast<unsigned char>(text[place]))));
    return {};
  }
  try {
    YAML::Node node = YAML::Load(text);
    if (!node.IsNull()) return node;
    problems.add(0, "the file is empty (there is no key in it): see configs/ for examples");
  } catch (const YAML::Exception& error) {
    tell_no_yaml(text, error, problems);
  }
  return {};
}

}  // namespace freestand::study
