// What certificate.json says of one exported file: what the target will make of it, against what freestand holds.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "exports/exporter.hpp"

namespace freestand::exports {

inline constexpr const char* certificate_format = "freestand-certificate/1";
inline constexpr int checked_intensities = 50;
inline constexpr double wanted_difference = 1e-6;

struct Certified {
  nlohmann::ordered_json json;
  double difference = 0;               // largest, in probability, over all limit states and intensities
  double allowed = wanted_difference;  // the wanted one, and what the target rounds
};

// Reads the written file back, evaluates the target's own formula at 50 intensities from near 0 to the highest swept.
// Throws Error (Exit::data) where a rule of the target is broken.
Certified certify(const Model&, const Format&, const std::filesystem::path& file);
// The same of a file that holds many, each by its own id; "functions" has what is said of each.
Certified certify(const Collection&, const Format&, const std::filesystem::path& file);

}  // namespace freestand::exports
