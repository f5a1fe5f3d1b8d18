// The study of a validation: measurements, and the model that is held against them.
//
//   measurements: dataset.yaml
//   model: {friction: {mu: {calibrate: [0.03, 1.2]}}, effects: []}
//   ladder: [...]                                             # written by `add`
//
// A number of the model may be {calibrate: [a, b]}: a fit chooses it between a and b. After a fit it stands as
// {calibrate: [a, b], value: v, interval: [l, u]}, and is v wherever the model is used as it is. Parameters of a
// catalogued effect that are left out and have no default are calibrated within the catalogue's range. Dimensions that
// the model does not give are the specimen's of each test.
//
// Where outcomes are all that was measured, model.placement_scatter is the standard deviation of ln(width) from test to
// test; calibrated where it is not given.
//
// A sweep takes the same file: keys of `model` then stand for the study's own (sweep_model).
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "measurement/data/dataset.hpp"
#include "measurement/predict/model.hpp"
#include "study/study.hpp"

namespace freestand::study {

struct Calibrated {
  std::string name;  // friction.mu, effects.floor_tilt.angle_rad, block.width_m ...
  double lower = 0, upper = 0;
  std::optional<double> value;
  std::vector<double> interval;  // lower, upper; empty: none
};

// One step of the ladder: the errors of the model with these effects, in noise units.
struct LadderStep {
  std::string step;  // "base", or the effect that was added
  double error_calibration = 0, error_holdout = 0;
  double noise_floor = 0,
         noise_floor_holdout = 0;  // what noise alone would make, in the calibration tests; held-out ones
  double explained_holdout =
      0;  // error_holdout with the floor's noise allowed for, and the friction of each test where it scatters
  double explained_calibration = 0;  // the same of the calibration tests
};

struct Validation {
  std::string name;
  std::filesystem::path file, measurements;
  std::filesystem::path folder;  // relative paths start here (paths.hpp)
  int measurements_line = 0;
  ModelPart model;  // numbers to be calibrated stand there with their value, or with the middle of their range
  bool width_given = false, height_given = false, mass_given = false;
  std::optional<double> placement_scatter;
  std::vector<Calibrated> calibrated;
  std::vector<LadderStep> ladder;
  std::string text;  // of the file

  bool fitted() const;  // every number to be calibrated has its value
};

// Throws Error (Exit::usage) with every problem of the file.
Validation read_validation(const std::filesystem::path& file);
Validation parse_validation(const std::string& text, const std::filesystem::path& file);

// The model as fits see it. The free numbers stand in the order of `calibrated`. The Validation must outlive it where
// effects are formulas. as_fitted: numbers with a value are fixed at it.
measurement::ModelSpec model_spec(const Validation&, bool as_fitted);

// Values of the free numbers to start from; empty: not all are known.
std::vector<double> known_values(const Validation&);

}  // namespace freestand::study
