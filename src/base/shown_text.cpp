#include "base/shown_text.hpp"

#include <cstdint>
#include <cstdio>

namespace freestand {
namespace {

// The character at the start of `text`, which is not empty.
struct Character {
  std::size_t bytes = 1;
  bool shows = false;  // well-formed UTF-8 [RFC 3629] and no control character
};

Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) return {1, lead >= 0x20 && lead != 0x7f};
  const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < bytes) return {};
  std::uint32_t code = lead & (0xffU >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0U) != 0x80) return {};
    code = code << 6U | (byte(i) & 0x3fU);
  }
  const bool overlong = code < (bytes == 4 ? 0x10000U : bytes == 3 ? 0x800U : 0x80U);
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  if (overlong || surrogate || code > 0x10ffff) return {};
  const bool control = code < 0xa0 || code == 0x2028 || code == 0x2029;
  const bool turns_direction =
      code == 0x200e || code == 0x200f || (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
  return {bytes, !control && !turns_direction};
}

}  // namespace

std::string printable(std::string_view text, Lines lines) {
  std::string out;
  while (!text.empty()) {
    const Character next = first_character(text);
    if (next.shows || ((text[0] == '\n' || text[0] == '\t') && lines == Lines::keep)) {
      out += text.substr(0, next.bytes);
    } else {
      char escaped[5];
      for (std::size_t i = 0; i < next.bytes; ++i) {
        std::snprintf(escaped, sizeof escaped, "\\x%02x", static_cast<unsigned>(static_cast<unsigned char>(text[i])));
        out += escaped;
      }
    }
    text.remove_prefix(next.bytes);
  }
  return out;
}

std::string shown(std::string_view text, std::size_t longest) {
  std::size_t end = 0, characters = 0;
  for (; end < text.size() && characters < longest; ++characters) end += first_character(text.substr(end)).bytes;
  return printable(text.substr(0, end)) + (end < text.size() ? "..." : "");
}

}  // namespace freestand
