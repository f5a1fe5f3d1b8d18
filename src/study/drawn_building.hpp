// A building whose period or damping is known by a distribution: each record of the ground shakes one of its own.
//
// The draws are a pure function of the seed, the building's name and the record's, so that another record, or another number that is
// drawn, changes none. All floors over one record are of one building, and the record with its building is one motion for the
// statistics: what is not known of the building widens the intervals as the records' scatter does.
#pragma once

#include <cstdint>
#include <string>

#include "study/study.hpp"

namespace freestand::study {

motion::Building drawn(const BuildingPart&, std::uint64_t seed, const std::string& record);

}  // namespace freestand::study
