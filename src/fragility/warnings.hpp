// What the reader of a result must know, in plain sentences.
#pragma once

#include <string>
#include <vector>

#include "fragility/result.hpp"
#include "fragility/tally.hpp"

namespace freestand::fragility {

std::vector<std::string> warnings(const Tally& tally, const Result& result);

}  // namespace freestand::fragility
