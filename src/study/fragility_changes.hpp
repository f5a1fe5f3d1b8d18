// Another intensity, other bins, demands and capacities for a study whose samples are there, as the command line says them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/study.hpp"

namespace freestand::study {

struct FragilityChanges {
  std::string im = {};                       // "pgv_mps", "sa_g:0.5"
  std::string bins = {};                     // "12", "0.1,0.2,0.5", "{count: 12, spacing: log}"
  std::vector<std::string> edp = {};         // names
  std::vector<std::string> capacities = {};  // "peak_slip_m=0.05,0.1", "{peak_slip_m: [0.05, 0.1]}"

  std::vector<std::string> target = {};  // "friction.mu_k={lognormal: {median: 0.3, dispersion: 0.2}}"

  std::optional<double> confidence = {};  // of every band

  bool any() const { return !keys().empty(); }

  // Keys of the study that they change.
  std::vector<std::string> keys() const;
};

// The study with these changes, checked as any study file. Bins by edges or by width are in the unit of their intensity:
// with another one and no bins they give way to the usual bins. Throws Error (Exit::usage).
Study with_changes(const Study&, const FragilityChanges&);

// "sa_g at 0.5 s", and as the command line takes it: "sa_g:0.5".
std::string described(const IntensityPart&);
std::string short_name(const IntensityPart&);

}  // namespace freestand::study
