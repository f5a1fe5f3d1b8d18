// What respond(), respond_reference() and respond_batch() hand a sample to: along a line, or in the plane.
#pragma once

#include <freestand/simulate.hpp>

namespace freestand::dynamics {

// The floor moves along one line, in the directions of motion->horizontal_mps2; a second channel is not looked at.
Response respond_on_line(const Specimen&, const Shaking&, const Settings&, History*);
Response respond_reference_on_line(const Specimen&, const Shaking&, const Settings&, History*);

// Has the floor two horizontal channels that are not proportional throughout?
bool moves_in_plane(const FloorMotion& motion);

}  // namespace freestand::dynamics
