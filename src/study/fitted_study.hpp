// A study of a validation, written again with the numbers that were fitted. Internal to src/study.
#pragma once

#include <yaml-cpp/yaml.h>

#include <optional>
#include <string>

#include "study/posterior_tables.hpp"
#include "study/validation_parts.hpp"

namespace freestand::study {

// Dimensions that all tests have in common and the model does not give: with them a sweep can take the study as it is.
void write_block(YAML::Node root, const Prepared&);

// The scatter from test to test that outcomes are judged with, where the study does not name it.
void name_placement_scatter(YAML::Node root, const Prepared&);

// The width, or the slenderness, of the one specimen of all tests, about which placements scatter while it is known itself: a sweep draws it
// beside the scatter. None: it is calibrated, and drawn as that, or nothing scatters.
std::optional<KnownMiddle> known_middle(const Prepared&);

// Values and intervals into every {calibrate: ...} of the model, and the table of their joint draws where there is one.
void write_numbers(YAML::Node root, const measurement::ModelFit&, const std::string& table = "");

// The file, one line for each part of the model.
std::string study_text(YAML::Node root);

// The way to what the study names, and the measurements that were taken, for a file in `folder`.
void write_paths(YAML::Node root, const Prepared&, const std::filesystem::path& folder);

// The study as it was read, fitted, with what is open of it: joint draws, and by how much the slips of another test lie beside the
// model's. For a file in another folder.
std::string fitted_study(const Prepared&, const measurement::ModelFit&, const measurement::Posterior&,
                         const std::filesystem::path& folder);

}  // namespace freestand::study
