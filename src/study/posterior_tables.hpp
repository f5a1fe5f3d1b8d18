// Tables of joint draws: csv with a header, a row for each draw, a column for each number that was calibrated, by its name.
// A study names one of them as {posterior: fitted_draws.csv, column: friction.mu}.
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "measurement/fit/posterior.hpp"
#include "study/problems.hpp"

namespace freestand::study {

inline constexpr const char* posterior_table = "fitted_draws.csv";

// A study, and the table that lies beside it where it was fitted.
inline std::vector<std::filesystem::path> files_of_study(const std::filesystem::path& study) {
  return {study, study.parent_path() / posterior_table};
}

// Puts `values` into every such mapping below `root` that has none. Tables lie in `folder`, where the study does. What is doubtful of them, a sentence
// for each table.
std::vector<std::string> read_posterior_tables(YAML::Node root, const std::filesystem::path& folder, Problems&);

// A dimension of the block that is no number of the fit, and about which its placements scatter.
struct KnownMiddle {
  std::string key;  // width_m or slenderness_rad
  double value = 0;
  std::string column() const { return "block." + key; }
};

// The text of a table. Empty where there are no draws. middle: has a column of its own, as another placement has it.
std::string posterior_text(const measurement::ModelSpec&, const measurement::Posterior&,
                           bool measurements_look_wrong = false, const std::optional<KnownMiddle>& middle = {});

}  // namespace freestand::study
