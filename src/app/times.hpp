// What a run or a fit says when it ends: its time, and its warnings.
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

// A line with the first warning, and how many more stand in the folder's summary.json; "" where there is none.
std::string warnings_text(const study::FitSummary& fit, const std::string& folder);

}  // namespace freestand::app
