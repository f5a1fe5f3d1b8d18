// The catalogue file: many entries, each a study, from common parts and what is each entry's own.
//
//   format: freestand-catalogue/1
//   name: equipment of a laboratory
//   samples: 4000                            # any key of a study: what an entry does not say itself
//   motions: [...]                           # or floors: {ground: [...], third: [...]}, names of lists of motions
//   frictions: {vinyl: {mu: 0.25}, ...}      # names, for entries without friction of their own
//   intensities: [pga_g, {name: sa_g, period_s: 0.5}]   # else the one of `fragility`
//   exports: [openquake, csv]                # written beside the database, each into a folder of its name
//   classes: [laboratory refrigerator, ...]  # if it is there, no other class may be named
//   entries:
//     - {id: fridge, class: laboratory refrigerator, block: {...}, friction: vinyl, floor: [ground, third], source: assumed}
//   table: specimens.csv                     # specimen_table.hpp
//
// An entry that names no friction is taken with each of `frictions`, one that names no floor with each of `floors`, and one
// that names several with each of these; the name then goes behind its id: fridge_vinyl_ground.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "database/database.hpp"
#include "study/study.hpp"

namespace freestand::study {

inline constexpr const char* catalogue_format = "freestand-catalogue/1";

struct CatalogueEntry {
  database::Entry words;                   // and the numbers of its equipment; nothing of its samples yet
  Study study;                             // named by the entry's id; its intensity is the first one
  std::string place;                       // "specimens.csv:7", for messages
  std::vector<IntensityPart> others = {};  // the other intensities that its curves are wanted over
};

struct Catalogue {
  std::string name, revision;
  std::vector<std::string> exports;  // formats
  std::vector<std::string> classes;  // in the order of the file, or of their first entry
  std::vector<CatalogueEntry> entries;
};

// Reads and checks the file and its table. Throws Error (Exit::usage) with all problems, each with file and line.
Catalogue read_catalogue(const std::filesystem::path& file, const Known&);

// Numbers and words of an entry that follow from its study: sizes, friction, model, effects, motions.
void describe(const Study&, database::Entry&);

}  // namespace freestand::study
