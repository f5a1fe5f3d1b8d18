// The floor motions of a study, read by one rank for all: a file server sees one reader, whatever the number of ranks.
#pragma once

#include <string>

#include "parallel/communicator.hpp"
#include "study/realise.hpp"

namespace freestand::study {

// Of the same machine and program alone. What follows from the coefficients is made anew where it is read, to the bit.
std::string bytes_of(const MotionSet&);
MotionSet motions_of(const std::string& bytes);

// load_motions() of the root, on every rank. Throws what it throws, on every rank. Collective.
MotionSet load_motions_together(const parallel::Communicator&, const Study&);

}  // namespace freestand::study
