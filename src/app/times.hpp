// What a run says of its time when it ends.
#pragma once

#include <string>

#include "study/fit.hpp"
#include "study/sweep.hpp"

namespace freestand::app {

// "0.4 s", "45 s", "2 min 3 s"
std::string short_duration(double seconds);

// "100000 samples in 9 s on 2 ranks: sweep 5.1 s (19600 samples/s), accuracy check 0.9 s, writing 0.5 s, fit 1.9 s"
// fit_s: of the fit, that came after the sweep; 0: there was none.
std::string times_text(const study::SweepSummary& sweep, double fit_s, int ranks);

}  // namespace freestand::app
