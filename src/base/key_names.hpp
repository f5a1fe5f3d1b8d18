// Names of keys and columns: the unit at their end, and which of them somebody may have meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace freestand {

// Least number of insertions, deletions, replacements and exchanges of neighbours between two words.
int edit_distance(std::string_view a, std::string_view b);

// The candidate nearest to `word`, whatever its case: the same word with a unit, or the least edit distance. Empty when
// none is near (more than a third of the word would have to change).
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

// Unit of a dotted name from its suffix: block.width_m -> "m", friction.mu -> "1".
std::string unit_of(std::string_view name);

// Is that unit one of SI, or is there none?
bool in_si(std::string_view name);

// Name without its unit suffix: width_m -> width, mu -> mu.
std::string_view without_unit(std::string_view name);

}  // namespace freestand
