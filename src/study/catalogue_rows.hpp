// From what was found for one entry to the rows of a database.
#pragma once

#include <vector>

#include "database/database.hpp"
#include "fragility/result.hpp"

namespace freestand::study {

// Every demand at every capacity, over an intensity by its text, "sa_g:0.5". entry: position in the database.
std::vector<database::Curve> curves_of(const fragility::Result&, std::size_t entry, const std::string& im);

// The words of these demands and intensities, each once: out of the registries, and of damage states (and capacities that are
// distributions) out of the entries' studies, with the condition as summary.
std::vector<database::Word> demand_words(const database::Database&);
std::vector<database::Word> intensity_words(const std::vector<database::Curve>&);

}  // namespace freestand::study
