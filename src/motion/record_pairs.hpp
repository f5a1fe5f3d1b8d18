// Pairs of horizontal components out of a table of records, to be turned into one direction.
#pragma once

#include "motion/record_table.hpp"

namespace freestand::motion {

// The two horizontal components of each station (the same suite, event and station) become one row, that of the first. Numbers
// that the table gives of the shaking are of one component, and unknown (nan) of the pair; so is a pulse that the two rows do
// not share. Throws Error (Exit::usage) that names every row without a partner at a right angle, or with more than one, and
// every pair that is read in different ways.
void pair_components(RecordTable& table);

// By which angle a pair is turned from its first component [deg], so that it points to this azimuth.
double angle_to_azimuth_deg(const RecordRow& pair, double azimuth_deg);

}  // namespace freestand::motion
