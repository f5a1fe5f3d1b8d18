// Which sampled parameter the demands of a finished sweep owe their scatter to: sensitivity.json and sensitivity.csv beside its samples.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "decision/shares.hpp"
#include "decision/total_shares.hpp"
#include "parallel/communicator.hpp"

namespace freestand::study {

inline constexpr const char* sensitivity_format = "freestand-sensitivity/1";

struct SensitivityOptions {
  std::filesystem::path folder;  // of the sweep
  std::filesystem::path output;  // for the two files; empty: the sweep's
  std::int64_t pairs = 0;        // samples that are computed again for each parameter, for total shares; 0: none
  std::optional<double> confidence = {};  // none: as the study has it
  bool quiet = false;
  std::string command;
};

struct Sensitivity {
  std::vector<decision::Parameter> parameters;
  std::vector<decision::Answer> answers;
  std::vector<decision::ShareRow> rows;                   // [answer]; without shares where `why_empty` says so
  std::vector<std::vector<decision::TotalShare>> totals;  // [answer][parameter], empty where not asked for
  std::vector<std::string> why_empty;                     // [answer]
  std::vector<std::string> why_no_total;                  // [answer], where pairs were asked for
  double confidence = 0.95;
  std::int64_t pairs = 0;
  std::string note = {};  // where not all samples of the sweep are kept
};

// The shares, on the root (empty on the others): first-order ones of the samples that are there; total ones of the first `pairs`
// of them, each computed again with one parameter drawn again. The same to the bit on any number of ranks. Collective. Throws
// Error: samples.h5 cannot be used (Exit::data), nothing is sampled or more pairs than samples (Exit::usage), stopped on
// request (Exit::resumable).
Sensitivity sensitivity(const parallel::Communicator&, const SensitivityOptions&);

// The two files, by the root. Throws Error where a file of someone else would be replaced.
void write_sensitivity(const Sensitivity&, const SensitivityOptions&);

nlohmann::ordered_json sensitivity_json(const Sensitivity&);
std::string sensitivity_csv(const Sensitivity&);

// "ln peak_slip_m", "peak_slip_m > 0.1 m", "overturned"
std::string title(const decision::Answer&);

}  // namespace freestand::study
