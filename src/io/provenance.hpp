// Where a result comes from.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "io/h5.hpp"

namespace freestand::io {

struct Provenance {
  std::string version;      // of freestand
  std::string git_commit;   // "unknown" outside a git working tree; "-dirty" behind it where files were changed
  std::string compiler;     // with the flags of the build type
  std::string libraries;    // JSON text: name -> version
  std::string host;         // of this process
  std::string created_utc;  // 2025-01-31T12:00:00Z
  std::string command;      // the command line
  int ranks = 1;
  // Of the study; filled in by who has it.
  std::string study;            // expanded YAML text
  std::string effects = "[]";   // JSON text: the effects of the study with law, source and parameters
  std::string accuracy = "{}";  // JSON text: error estimates of the demands (study/accuracy.hpp)
  std::string doubts = "[]";    // JSON: sentences about what looks like a slip in the study or its records
  std::string kernel;           // study/kernel_number.hpp; "" in older files
  std::string study_name;
  std::uint64_t seed = 0;
  std::int64_t samples = 0;  // that were drawn
  std::optional<std::int64_t>
      alike;  // the first of them, none of which was passed over (study/rounds.hpp); not there: all
};

// Of this program, now. The study's part is left empty.
Provenance provenance_here(const std::string& command, int ranks);

// One string from argc and argv, arguments with blanks in quotes.
std::string command_line(int argc, const char* const* argv);

// Sets the root attributes of a result file: format and everything above.
void write_provenance(h5::Group& root, const std::string& format, const Provenance&);
// Reads them back; throws Error (Exit::data) if `format` is another.
Provenance read_provenance(const h5::Group& root, const std::string& format);

}  // namespace freestand::io
