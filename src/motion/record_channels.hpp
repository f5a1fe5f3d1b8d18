// What the formats with several channels share.
#pragma once

#include "motion/record_format.hpp"

namespace freestand::motion {

// A channel of that name, without values. "Up", "Vert", "Down" ... are vertical.
RawChannel named_channel(const std::string& name);

// The values as they stand, or turned over where the channel is positive downwards.
std::vector<double> oriented(const RawChannel& channel, std::vector<double> values);

// Takes step and unit of the first channel; throws where a later one differs.
void agree(const RecordText& text, std::size_t line, RawRecord& record, double dt_s, const std::string& unit);

}  // namespace freestand::motion
