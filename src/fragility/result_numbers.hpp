// Parts of a result as plain numbers and back, to the bit, as processes send them to one another. Names and units stay
// behind: they are those of the options.
#pragma once

#include <vector>

#include "fragility/result.hpp"

namespace freestand::fragility {

std::vector<double> numbers_of(EdpResult);
std::vector<double> numbers_of(FragilityFunction);

void from_numbers(const std::vector<double>&, EdpResult&);
void from_numbers(const std::vector<double>&, FragilityFunction&);

}  // namespace freestand::fragility
