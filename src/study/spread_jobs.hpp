// The fits of compare, diagnose and add, spread over the ranks.
#pragma once

#include "measurement/model_fit.hpp"
#include "parallel/communicator.hpp"

namespace freestand::study {

// Each job runs on whichever rank is free; every rank gets all answers. The jobs themselves are the same on any number
// of ranks, so that the answer is. What is done is shown on stderr unless `quiet`. Collective; throws Error
// (Exit::resumable) when a stop was requested.
measurement::Jobs spread_jobs(const parallel::Communicator&, bool quiet);

}  // namespace freestand::study
