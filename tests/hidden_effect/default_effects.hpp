// What a confusion table is made of.
#pragma once

#include <string>
#include <vector>

namespace freestand::test {

// "none", each effect of the catalogue, pairs ("a+b"), each effect outside of it.
std::vector<std::string> default_effects();

// "a+b" -> {a, b}; "none" -> {}.
std::vector<std::string> split_effects(const std::string& effects);

}  // namespace freestand::test
