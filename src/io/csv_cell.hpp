// One cell of a csv: what is not known is empty, numbers read back to the same bits, text is quoted where it must be.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace freestand::io {

inline std::string cell(double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }

inline std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted += '"';
}

}  // namespace freestand::io
