#include "motion/record_channels.hpp"

#include <fmt/format.h>

#include "base/shown_text.hpp"
#include "motion/component.hpp"

namespace freestand::motion {
namespace {

bool starts_with(const std::string& text, std::initializer_list<const char*> beginnings) {
  for (const char* beginning : beginnings)
    if (text.rfind(beginning, 0) == 0) return true;
  return false;
}

}  // namespace

RawChannel named_channel(const std::string& name) {
  return {name,
          is_downward_word(name) || is_vertical_word(name) || starts_with(lower_case(name), {"up", "vert", "v "}),
          {}};
}

std::vector<double> oriented(const RawChannel& channel, std::vector<double> values) {
  if (is_downward_word(channel.name))
    for (double& value : values) value = -value;
  return values;
}

void agree(const RecordText& text, std::size_t line, RawRecord& record, double dt_s, const std::string& unit) {
  if (record.channels.empty()) {
    record.dt_s = dt_s;
    record.unit = unit;
  }
  if (*record.dt_s != dt_s || record.unit != unit)
    text.fail(line,
              fmt::format("a channel with another step or unit ({} s, {}) than the first ({} s, {}): split the file",
                          dt_s, shown(unit), *record.dt_s, shown(record.unit)));
}

}  // namespace freestand::motion
