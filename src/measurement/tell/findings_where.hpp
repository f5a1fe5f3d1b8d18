// Where a model goes wrong, in one sentence, and errors in the units of their channels.
#pragma once

#include "measurement/tell/compare.hpp"

namespace freestand::measurement {

std::string told(Channel, double value);  // "18.3 mm", "4.20 mrad", "0.310 m/s2"
const char* word(Channel);                // "slip" ...

// The phase in which the residual changes most, and the range of a variable that stands out even more; empty where none
// does.
std::string where_wrong(const Bench&, const std::vector<ErrorTable>&);

}  // namespace freestand::measurement
