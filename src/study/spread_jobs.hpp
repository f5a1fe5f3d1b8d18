// Fits, spread over the ranks.
#pragma once

#include <functional>
#include <memory>

#include "base/jobs.hpp"
#include "parallel/communicator.hpp"
#include "study/kept_answers.hpp"

namespace freestand::study {

// Each job runs on whichever rank is free; every rank gets all answers. The jobs themselves are the same on any number
// of ranks, so that the answer is. What is done is shown on stderr unless `quiet`. Collective. When a stop was requested,
// `leave` is called, which throws; without one, Error (Exit::resumable). kept: where answers are looked up first, and kept.
Jobs spread_jobs(const parallel::Communicator&, bool quiet, std::function<void()> leave = {},
                 std::shared_ptr<KeptAnswers> kept = {});

}  // namespace freestand::study
