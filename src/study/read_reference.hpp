// Somebody else's fragility of an entry of a catalogue: a lognormal over an intensity, of a demand [above a capacity].
#pragma once

#include "database/database.hpp"
#include "study/read_parts.hpp"

namespace freestand::study {

// Fills the words of the entry that begin with reference_. What is missing or not known becomes a problem of that line.
void read_reference(const YAML::Node&, int line, const Known&, database::Entry& words, Problems&);

}  // namespace freestand::study
