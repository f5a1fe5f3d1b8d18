// Text that comes from a file, or is the name of one, as a message may show it: a terminal obeys control characters, and
// a binary file is full of them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace freestand {

// The text with each control character and each byte that is no UTF-8 as \xHH; line breaks and tabs stay where `lines` says so.
// What is printable already comes back as it is.
enum class Lines { escape, keep };
std::string printable(std::string_view text, Lines lines = Lines::escape);

// The same, cut behind `longest` characters with "..." in place of the rest: for words quoted out of a file.
inline constexpr std::size_t longest_shown = 60, longest_path = 255;
std::string shown(std::string_view text, std::size_t longest = longest_shown);

}  // namespace freestand
