// {calibrate: [a, b]} in the model of a study file.
#pragma once

#include <yaml-cpp/yaml.h>

#include <vector>

#include "study/problems.hpp"
#include "study/read_validation.hpp"

namespace freestand::study {

// Replaces every {calibrate: ...} below `model` by a number, its value or the middle of its range, and returns what
// stood there, in the order of the file.
std::vector<Calibrated> take_calibrated(YAML::Node model, Problems&);

// {calibrate: [lower, upper]}
YAML::Node calibrate_node(double lower, double upper);

// Entries of `effects` that are a name alone become mappings; parameters of catalogued effects that are absent and have
// no default become {calibrate: [low, high]} of the catalogue.
void add_missing_parameters(YAML::Node model);

// A study file whose `model` is a mapping, as a sweep reads it: the keys of the model on the level of the file, numbers
// that were calibrated at their values, or as joint draws where it names a table of these; what belongs to measurements
// left out, but for placements, by which the width scatters; numbers that were not fitted yet are problems. Any other file is left as it is.
void sweep_model(YAML::Node root, Problems&, FittedAs);

// A number that was fitted, with its interval; lower >= upper: none.
struct FittedNumber {
  std::string name;
  double value = 0, lower = 1, upper = 0;
  std::string drawn_from = {};  // a table of joint draws; empty: none
};

// Writes value and interval into every {calibrate: ...} below `node` that has its number. name: dotted name of the node,
// "" for the model itself.
void write_fitted(YAML::Node node, const std::string& name, const std::vector<FittedNumber>& numbers);

}  // namespace freestand::study
