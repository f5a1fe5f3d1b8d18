// ESM ASCII (DYNA 1.2): lines "KEY: value", then one value a line.
#include <fmt/format.h>

#include "base/shown_text.hpp"
#include "motion/record_format.hpp"

namespace freestand::motion::format_esm {
namespace {

constexpr std::string_view first_sample = "DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS";

// Line and value of a key of the header.
struct Entry {
  std::size_t line;
  std::string_view value;
};

Entry entry(const RecordText& text, std::string_view key) {
  for (std::size_t line = 0; line < text.size(); ++line) {
    const std::string_view words = text.line(line);
    if (words.find(':') == std::string_view::npos) break;
    if (words.substr(0, key.size()) == key && words.substr(key.size(), 1) == ":")
      return {line, trim(words.substr(key.size() + 1))};
  }
  text.fail(fmt::format("no {} in the header (it is cut): get the file again", key));
}

bool recognises(const RecordText& text) {
  return text.line(0).substr(0, 11) == "EVENT_NAME:" && text.find("SAMPLING_INTERVAL_S:", 0, 100) < text.size();
}

// The stream is a channel code: HNE, HNN, HNZ.
std::optional<std::string> vertical_word(const RecordText& text) {
  return entry(text, "STREAM").value.ends_with('Z') ? "Z" : "";
}

RawRecord read(const RecordText& text) {
  const Entry type = entry(text, "DATA_TYPE"), step = entry(text, "SAMPLING_INTERVAL_S");
  const Entry size = entry(text, "NDATA"), unit = entry(text, "UNITS");
  if (lower_case(type.value).find("acceleration") == std::string::npos)
    text.fail(type.line,
              fmt::format("not a record of acceleration (the header says {}): use the .ACC. file", shown(type.value)));
  std::size_t line = 0;
  while (line < text.size() && text.line(line).find(':') != std::string_view::npos) ++line;
  const std::size_t count = text.count(size.line, size.value);
  RawRecord record{text.number(step.line, step.value), std::string(unit.value), {RawChannel{}}};
  record.channels[0].values = text.block(line, count);
  text.ends_at(line, count);
  if (text.find(first_sample) < text.size()) record.start = std::string(entry(text, first_sample).value);
  return record;
}

const RegisteredFormat here{{.name = "esm",
                             .summary = "ESM ASCII (Engineering Strong Motion database), one channel",
                             .recognises = recognises,
                             .read = read,
                             .vertical_word = vertical_word}};

}  // namespace
}  // namespace freestand::motion::format_esm
