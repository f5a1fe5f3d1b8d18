// The results of a sweep in a format that others load, and the certificate of what they will make of it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "exports/select.hpp"
#include "study/problems.hpp"

namespace freestand::study {

struct ExportRequest {
  std::filesystem::path folder, output;
  std::string format;
  exports::Request what;
  std::optional<double> mu;        // by which the report's intensity is turned into PTA
  std::optional<double> period_s;  // of record.sa_g, which tells none
  bool overwrite = false;
  std::string im;     // of a database of several: "sa_g:0.5"; none: the first
  bool each = false;  // of a database: a file of its own for each entry
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

// Every entry of a database over one intensity: all in one file under their ids, where the format has that; else, or by `each`, each into a
// file of its name in the folder `output`, or a folder of its own where the format wants one. An entry that cannot be exported stops no
// other.
struct DatabaseExport {
  std::vector<std::pair<std::string, ExportSummary>> entries;  // by id
  std::vector<Refusal> refused;                                // "fridge-vinyl: why" of fridge-vinyl
  std::vector<std::filesystem::path> files;                    // that hold all of them, the certificate last
  std::filesystem::path output;
  std::string format, im;
  std::vector<std::string> other_ims;  // that the database has too
};
bool is_database(const std::filesystem::path& folder);
DatabaseExport export_database(const ExportRequest&);

// A database over each of its intensities in these formats, into DB/exports/FORMAT, or DB/exports/FORMAT/INTENSITY where there are several.
// What freestand wrote there before is replaced.
std::vector<DatabaseExport> export_beside(const std::filesystem::path& database,
                                          const std::vector<std::string>& formats);

}  // namespace freestand::study
