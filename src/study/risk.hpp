// Annual rates out of a fitted sweep and a hazard curve: risk.json, risk.csv.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "decision/hazard.hpp"
#include "decision/risk.hpp"

namespace freestand::study {

inline constexpr const char* risk_format = "freestand-risk/1";

struct RiskOptions {
  std::filesystem::path folder;  // of the sweep
  std::filesystem::path hazard, output;
  std::vector<double> years = {50};
  bool overwrite = false;
  std::string command;
};

struct RiskAnswer {
  decision::HazardCurve hazard;
  decision::Risk risk;
  std::string study_name;
  double period_s = 0;  // of sa_g; 0: the intensity has none
  std::string target;   // a sentence: the mix that the curves are of, where it is not the one that was swept
};

// Reads fragility.h5 of the sweep and the hazard curve. Throws Error: either cannot be used (Exit::data), the curve is over another
// intensity, or over none that the sweep reaches (Exit::usage).
RiskAnswer risk(const RiskOptions&);

// The two files, into a new folder.
void write_risk(const RiskAnswer&, const RiskOptions&);

nlohmann::ordered_json risk_json(const RiskAnswer&, const RiskOptions&);
std::string risk_csv(const RiskAnswer&, const RiskOptions&);

}  // namespace freestand::study
