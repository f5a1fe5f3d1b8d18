// What a file of a record format (format_*.cpp) gives: its name, how to know it, how to read it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/registry.hpp"
#include "motion/record_text.hpp"

namespace freestand::motion {

struct RawChannel {
  std::string name;  // "" where the format has one channel
  bool vertical = false;
  std::vector<double> values;  // in `unit`
};

// What stands in the file. Step and unit are left empty where it does not say: the user must.
struct RawRecord {
  std::optional<double> dt_s;
  std::string unit;
  std::vector<RawChannel> channels;
  std::string usual_unit = {};  // of such files, where this one does not say and nor does the user
  std::string start = {};       // time of the first sample, in the file's words; "" where it does not say
};

struct RecordFormat {
  std::string name;                                 // "at2"
  std::string summary;                              // one line
  bool (*recognises)(const RecordText&) = nullptr;  // no two formats recognise the same text
  RawRecord (*read)(const RecordText&) = nullptr;
  // Of formats with one component, from the beginning of the file: the word for where a vertical one points, or empty of a horizontal one.
  // Nothing: the header does not say.
  std::optional<std::string> (*vertical_word)(const RecordText&) = nullptr;
};

using RegisteredFormat = Registered<RecordFormat>;

}  // namespace freestand::motion
