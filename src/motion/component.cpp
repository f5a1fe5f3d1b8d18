#include "motion/component.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <freestand/error.hpp>
#include <optional>

#include "motion/record_format.hpp"

namespace freestand::motion {
namespace {

constexpr std::string_view words[] = {"up",  "ud",       "u-d", "v",   "ver",  "vert",
                                      "vrt", "vertical", "dn",  "dwn", "down", "z"};

bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }

// Channel codes of seismic networks: band, instrument, Z for vertical; HNZ, HLZ, EHZ ...
bool is_channel_code(std::string_view word) {
  return word.size() == 3 && std::string_view("EBHSLMCDFG").find(word[0]) != std::string_view::npos &&
         std::string_view("NLGHM").find(word[1]) != std::string_view::npos && word[2] == 'Z';
}

// RinaldiUP, 65006UD, CPEDWN: the component stands at the end of the station. DWN ends no other word.
std::string_view ending(std::string_view word) {
  for (const std::string_view end : {"DWN", "UP", "UD"}) {
    if (word.size() <= end.size() || !word.ends_with(end)) continue;
    if (end == "DWN" || !is_upper(word[word.size() - end.size() - 1])) return end;
  }
  return {};
}

// The word at the end of a name: TAB-UP, TAB-V.AT2, RinaldiUP.AT2; empty where it is none for a vertical component.
std::string_view last_word(std::string_view stem) {
  const auto pieces = split(stem, "-_. ");
  if (pieces.empty()) return {};
  return pieces.size() > 1 && is_vertical_word(pieces.back()) ? pieces.back() : ending(pieces.back());
}

std::string name_sign(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  for (const std::string_view part : split(name, "-_. "))
    if (is_channel_code(part)) return fmt::format("its name has {}", part);
  // CHB002.UD, and UD1, UD2 of KiK-net.
  const std::string extension = lower_case(path.extension().string());
  for (const char* vertical : {".ud", ".ud1", ".ud2", ".up"})
    if (extension == vertical) return fmt::format("its name ends in {}", path.extension().string());
  const std::string stem = path.stem().string();
  const std::string_view found = last_word(stem);
  return found.empty() ? "" : fmt::format("its name ends in {}", found);
}

// Nothing where the header does not say. Throws where the file cannot be read.
std::optional<std::string> word_of_header(const std::filesystem::path& path) {
  const RecordText head(path, head_bytes);
  for (const RecordFormat& format : registry<RecordFormat>())
    if (format.recognises(head) && format.vertical_word)
      if (auto word = format.vertical_word(head)) return word;
  return {};
}

}  // namespace

bool is_vertical_word(std::string_view word) {
  return std::find(std::begin(words), std::end(words), lower_case(word)) != std::end(words) || is_channel_code(word);
}

bool is_downward_word(std::string_view word) {
  const std::string lower = lower_case(word);
  if (is_channel_code(word)) return false;  // DNZ
  return lower.starts_with("dn") || lower.starts_with("dwn") || lower.starts_with("down");
}

std::string vertical_sign(const std::filesystem::path& path) {
  try {
    if (const auto word = word_of_header(path)) return word->empty() ? "" : "its header says so";
  } catch (const Error&) {
    return "";
  }
  return name_sign(path);
}

bool points_down(const std::filesystem::path& path) {
  const auto word = word_of_header(path);
  const std::string stem = path.stem().string();
  return is_downward_word(word && !word->empty() ? std::string_view(*word) : last_word(stem));
}

}  // namespace freestand::motion
