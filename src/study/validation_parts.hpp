// What compare, diagnose and add have in common. Internal to src/study.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "measurement/fit/posterior.hpp"
#include "study/validation.hpp"

namespace freestand::study {

// A validation with its measurements, read and checked on every rank.
struct Prepared {
  Validation validation;
  measurement::Dataset data;
  measurement::ModelSpec model;  // numbers to be calibrated free, those with a value too
  std::string measurements;      // file
  std::unique_ptr<measurement::Bench> bench;
};
std::unique_ptr<Prepared> prepare(const parallel::Communicator&, const ValidationRun&, int replays);
std::unique_ptr<Prepared> prepare(const parallel::Communicator&, Validation, const ValidationRun&, int replays);

// All that answers to it follow from, but the program: the study's text, and what was measured, bit by bit.
std::string content(const Prepared&);

// Tests without the vertical channel that an effect of the model acts on, in a sentence; empty: there are none.
std::string level_tests(const Prepared&);

// The model fitted to the calibration tests: where every number has its value and refit is false, at those values.
measurement::ModelFit fitted(const Prepared&, bool refit, const Jobs&);

// Errors of one role: root mean square and so on, as comparison.json says.
struct RoleError {
  std::size_t tests = 0;
  double error = 0;  // in the unit of the set
  double relative = 0, expected = 0, explained = 0, noise_units = 0;
};
RoleError role_error(const measurement::Bench&, const std::vector<measurement::TestComparison>&, measurement::Role);

// All tests compared, spread over the ranks. Probabilities of overturning are the mean over the draws where there are any: the best
// numbers alone would be too sure of themselves.
std::vector<measurement::TestComparison> compare_tests(const measurement::Bench&, const measurement::ModelFit&,
                                                       const measurement::Posterior&, const Jobs&);

const char* error_unit(const measurement::Bench&);
nlohmann::ordered_json ladder_json(const std::vector<LadderStep>&);

// created_utc, version, git_commit, command, compiler, host, ranks: at the end of a document.
void add_provenance(nlohmann::ordered_json& document, const parallel::Communicator&, const ValidationRun&);

// null where it is not finite.
nlohmann::ordered_json number_or_null(double value);
nlohmann::ordered_json numbers_or_null(const std::vector<double>& values);

// The interval of the i-th number: as wide as the tests leave it open, or none; and then why.
std::optional<measurement::Interval> interval_of(const measurement::ModelFit&, std::size_t i);
const char* no_interval(const measurement::ModelFit&, std::size_t i);
// [lower, upper] or null into "interval", and the reason into "no_interval" where it is null.
void add_interval(nlohmann::ordered_json& parameter, const measurement::ModelFit&, std::size_t i);

const char* calibration_method(const measurement::Bench&);  // a sentence

}  // namespace freestand::study
