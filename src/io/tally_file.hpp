// tally.h5: what was counted over all samples of a sweep that does not keep them all.
//
// root attributes: provenance.hpp, format "freestand-tally/2". /tally/words [word] int64, with the attribute fingerprint, of all
// that decides what is counted.
#pragma once

#include <filesystem>
#include <string>

#include "io/provenance.hpp"
#include "parallel/communicator.hpp"

namespace freestand::io {

inline constexpr const char* tally_format = "freestand-tally/2";

struct TallyContent {
  Provenance provenance;  // whose samples are those that are counted
  std::string fingerprint;
  parallel::Words words;
};

// By one process. Throws Error: a full disk is Exit::cure.
void write_tally(const std::filesystem::path& path, const TallyContent&);

// Throws Error (Exit::data) if it is no such file.
TallyContent read_tally(const std::filesystem::path& path);

}  // namespace freestand::io
