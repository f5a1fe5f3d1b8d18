// One function for each kind of file that users bring. Each takes any bytes, as the content of such a file;
// Error is its answer to what is no such file, and anything else that leaves it is a fault.
#pragma once

#include <filesystem>
#include <freestand/error.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace freestand::spoilt_files {

struct Target {
  std::string name;
  void (*take)(std::string_view bytes);
};

const std::vector<Target>& targets();  // all of them
std::vector<Target> study_targets();
std::vector<Target> file_targets();
std::vector<Target> edited_targets();           // of result files, by edits of a good one
const Target& target(const std::string& name);  // throws std::invalid_argument that lists them

// A file with these bytes, in a folder of this process that the target finds empty but for it; its name as given.
std::filesystem::path written(std::string_view bytes, const std::string& name);

// A reader may refuse a file in words of ours, and in no other way.
template <class Read>
void refuses_or_reads(Read&& read) {
  try {
    read();
  } catch (const Error&) {
  }
}

inline void expect(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

}  // namespace freestand::spoilt_files
