// A part of a study that stands in a file of its own.
#pragma once

#include <filesystem>
#include <freestand/error.hpp>
#include <optional>
#include <sstream>
#include <string>

#include "study/section.hpp"

namespace freestand::study {

// What read(file) gives; the problems of that file stand at the key that names it.
template <class Read>
auto read_named_file(Section& section, const std::string& key, const std::filesystem::path& file, Read&& read)
    -> std::optional<decltype(read(file))> {
  try {
    return read(file);
  } catch (const Error& error) {
    std::istringstream lines(error.what());
    for (std::string line; std::getline(lines, line);) section.problem(key, section.name(key) + ": " + line);
    return {};
  }
}

}  // namespace freestand::study
