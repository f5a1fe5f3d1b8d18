// What holds a block only where it comes far enough: a tether beyond its slack. One that never comes there moves as the block
// without it, and is computed as that.
#pragma once

#include <freestand/specimen.hpp>
#include <optional>

namespace freestand::dynamics {

// Without its restraints; none: it has none.
std::optional<Specimen> unrestrained(const Specimen&);

// Its restraints would have done nothing to a block that moved like this without them. peak_slip_m: with its fall, if it overturned.
bool stays_clear(const Specimen&, double peak_slip_m);

}  // namespace freestand::dynamics
