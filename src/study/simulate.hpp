// One sample in full: case file -> history.csv, summary.json.
#pragma once

#include <freestand/response.hpp>
#include <freestand/simulate.hpp>

#include "study/study.hpp"

namespace freestand::study {

struct Simulation {
  Specimen specimen;
  Response response;
  Response tighter;  // the same at a hundredth of the tolerance
  History history;
  std::vector<double> floor_displacement_m = {};  // one for each point of the history
  std::vector<std::string> doubts;
  bool still_moving = false;  // when its time was over
};

// Integrates the one sample of a case; with the reference integrator if asked.
Simulation simulate(const Case&, bool reference = false);

}  // namespace freestand::study
