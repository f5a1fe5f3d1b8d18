// K-NET and KiK-net ASCII: header lines from "Origin Time" to "Memo.", then counts, 8 a line. The counts stand on the
// instrument's zero, which the header does not give: the mean is taken off, as the header's own "Max. Acc." has it.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "base/shown_text.hpp"
#include "motion/component.hpp"
#include "motion/record_format.hpp"

namespace freestand::motion::format_knet {
namespace {

constexpr std::size_t header_lines = 17, value_column = 18;

struct Entry {
  std::size_t line;
  std::string_view value;
};

Entry entry(const RecordText& text, std::string_view key) {
  const std::size_t line = text.find(key, 0, header_lines);
  if (line >= std::min(text.size(), header_lines))
    text.fail(fmt::format("no \"{}\" in the header (it is cut): get the file again", key));
  const std::string_view words = text.line(line);
  return {line, trim(words.substr(std::min(value_column, words.size())))};
}

// "7845(gal)/8223790": gal per count.
double scale_factor(const RecordText& text) {
  const Entry factor = entry(text, "Scale Factor");
  const std::size_t unit = factor.value.find("(gal)/");
  if (unit == std::string_view::npos)
    text.fail(factor.line, fmt::format("cannot read the scale factor \"{}\" (not \"a(gal)/b\"): get the file again",
                                       shown(factor.value)));
  return text.number(factor.line, factor.value.substr(0, unit)) /
         text.number(factor.line, factor.value.substr(unit + 6));
}

bool recognises(const RecordText& text) {
  return text.line(0).substr(0, 11) == "Origin Time" && text.find("Scale Factor", 0, header_lines) < text.size();
}

// K-NET writes N-S, E-W and U-D; KiK-net 1 to 3 in the borehole and 4 to 6 above it, in the same order.
std::optional<std::string> vertical_word(const RecordText& text) {
  const std::string_view direction = entry(text, "Dir.").value;
  return is_vertical_word(direction) || direction == "3" || direction == "6" ? "U-D" : "";
}

RawRecord read(const RecordText& text) {
  const Entry rate = entry(text, "Sampling Freq"), duration = entry(text, "Duration Time");
  const double frequency = text.number(rate.line, rate.value.substr(0, rate.value.find_first_not_of("0123456789.")));
  const double factor = scale_factor(text), seconds = text.number(duration.line, duration.value);
  const auto count = static_cast<std::size_t>(std::clamp(seconds * frequency + 0.5, 0.0, 1e12));
  std::size_t line = entry(text, "Memo.").line + 1;
  std::vector<double> values = text.block(line, count);
  text.ends_at(line, count);
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  for (double& value : values) value = (value - mean) * factor;
  RawRecord record{1 / frequency, "gal", {RawChannel{"", false, std::move(values)}}};
  if (text.find("Record Time", 0, header_lines) < std::min(text.size(), header_lines))
    record.start = entry(text, "Record Time").value;
  return record;
}

const RegisteredFormat here{{.name = "knet",
                             .summary = "K-NET and KiK-net ASCII, one channel; the mean is taken off",
                             .recognises = recognises,
                             .read = read,
                             .vertical_word = vertical_word}};

}  // namespace
}  // namespace freestand::motion::format_knet
