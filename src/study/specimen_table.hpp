// A table of specimens: csv, one row an entry of a catalogue, the numbers of one row taken together.
//
// Columns: id, class, description, source, floor, friction (names); width_m, height_m, slenderness_rad, size_m, mass_kg of the
// block; mu, mu_k, mu_s, static_ratio of the friction; reference_source ... reference_dispersion; and any other number of a
// study by its dotted name, such as chain.slack_m or effects.rate_weakening.drop. An empty cell says nothing; a cell may hold a
// distribution, {lognormal: {median: 0.2, dispersion: 0.3}}, in quotes where it holds commas. Lines that begin with # are
// comments.
#pragma once

#include <filesystem>
#include <vector>

#include "study/section.hpp"

namespace freestand::study {

struct SpecimenRow {
  int line = 0;
  YAML::Node entry;  // as an item of `entries`; all of it stands on the row's line, whatever its marks say
};

// What is wrong with the table goes to `problems`, by lines. Throws Error where the file cannot be read.
std::vector<SpecimenRow> read_specimen_table(const std::filesystem::path& file, Problems& problems);

}  // namespace freestand::study
