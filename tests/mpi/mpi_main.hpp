// The ranks of a test program that runs under mpirun.
#pragma once

#include "parallel/communicator.hpp"

namespace freestand::test {

const parallel::Communicator& world();

}  // namespace freestand::test
