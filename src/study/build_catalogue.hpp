// From a catalogue to a database: every entry is swept and fitted as a study of its own, and what came out is one file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "parallel/communicator.hpp"
#include "study/catalogue.hpp"

namespace freestand::study {

// For verbs that take one sweep: throws Error (Exit::usage) that names an entry's folder where the folder is a database.
void refuse_database(const std::filesystem::path& folder);

// Of an entry: where its fit over another intensity than its first lies, by the text of that intensity.
std::filesystem::path intensity_folder(const std::filesystem::path& entry_folder, const std::string& im);

struct CatalogueOptions {
  bool redo = false;   // entries whose study has changed are computed anew
  bool quiet = false;  // no progress
  std::string command;
};

struct CatalogueSummary {
  std::int64_t computed = 0, refitted = 0, kept = 0;  // entries of the catalogue
  std::int64_t others = 0;  // of the database that the catalogue does not name: kept as they are
  double wall_s = 0;
};

// Where the results of one entry lie, as `run` writes them.
std::filesystem::path entry_folder(const std::filesystem::path& folder, const std::string& id);

// Works in `folder`, which may hold the database already: entries whose study and kernel are those of the database are kept;
// those whose fragility block alone has changed are fitted again, out of their samples; changed ones are refused, all at
// once, each with the first key that differs, unless redo is given; new ones are computed. Then writes the database and its
// tables. The same numbers on any number of ranks and after any restart. Collective. Throws Error: another job works there, or
// it holds something else (Exit::usage), stopped on request (Exit::resumable; finished entries are kept).
CatalogueSummary build_catalogue(const parallel::Communicator&, const Catalogue&, const std::filesystem::path& folder,
                                 const CatalogueOptions&);

}  // namespace freestand::study
