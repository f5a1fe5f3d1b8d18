// Where the model stands, slides or rocks, and the specimen does not; or the other way round.
#pragma once

#include "measurement/tell/compare.hpp"

namespace freestand::measurement {

// One sentence for each way in which they differ, with the number that decides it: a block that must move slides where
// mu < width/height, and rocks where mu is greater. A specimen moves where a channel, or the peak of one, exceeds eight
// times least_motion(), and stands where it stays within six times it, which is as much as the scatter of a history
// reaches; a model stands within once, and moves beyond 16 times. One that overturned has rocked. Where the
// rotation is known, b (1 - cos(rotation)) is no slip, which the midpoint of a rocking base goes to and fro. Models that
// break off are left out, and tests in which the floor's noise alone makes five noise units.
std::vector<std::string> motion_findings(const Bench&, const ModelSpec&, std::span<const double> x,
                                         const std::vector<TestComparison>&);

}  // namespace freestand::measurement
