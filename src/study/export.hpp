// The results of a sweep in a format that others load, and the certificate of what they will make of it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "exports/select.hpp"

namespace freestand::study {

struct ExportRequest {
  std::filesystem::path folder, output;
  std::string format;
  exports::Request what;
  std::optional<double> mu;  // by which the report's intensity is turned into PTA
  bool overwrite = false;
};

struct ExportSummary {
  std::vector<std::filesystem::path> files;  // the certificate last
  exports::Model model;
  double difference = 0;  // largest, in probability, between what the target reads and what freestand holds
  std::string rounding;   // what the target rounds; "none"
};

// Reads FOLDER/fragility.h5. `output` with an ending is a file, else a folder; certificate.json stands beside the files and
// keeps what it says of others there. By one process. Throws Error: what the target cannot express, a file that would be
// replaced (Exit::usage); results that cannot be used, a file that the target would read otherwise (Exit::data).
ExportSummary export_fragility(const ExportRequest&);

// Every entry of a database, each into a file of its name in the folder `output`, or a folder of its own where the format
// wants one. An entry that cannot be exported stops no other.
struct DatabaseExport {
  std::vector<std::pair<std::string, ExportSummary>> entries;  // by id
  std::vector<std::string> refused;                            // "fridge-vinyl: why"
};
bool is_database(const std::filesystem::path& folder);
DatabaseExport export_database(const ExportRequest&);

}  // namespace freestand::study
