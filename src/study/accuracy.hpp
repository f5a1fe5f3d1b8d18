// How far a sweep's numbers can be trusted: some samples again, at a tighter tolerance.
//
// Up to `checked_samples` samples, one picked from each of as many equal stretches of the sweep by (seed, stretch), are
// integrated as the sweep does and, never in packs, at a hundredth of the tolerance, with the same draws. Where both
// stood, the differences of their demands are the error estimate; where they end differently, the sample is chaotic (near
// overturning), and the share of such samples tells how much of a probability rests on chance.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "parallel/communicator.hpp"
#include "study/evaluator.hpp"

namespace freestand::study {

inline constexpr std::int64_t checked_samples = 200;
// A step adds some 500 rounded terms, each by up to 1.1e-16 of a state of size 1: up to 5e-14, below which a tolerance
// says nothing. A study's tolerance must leave room for a tighter one.
inline constexpr double tightest_tolerance = 1e-13, least_tolerance = 1e-12;

struct DemandError {
  std::string name, unit;
  std::size_t samples = 0;                  // compared; 0: nothing is known of it
  double median = 0, p95 = 0, largest = 0;  // of the absolute difference
  double median_demand = 0;                 // of the samples compared that moved, for scale
};

struct Accuracy {
  double tolerance = 0, tighter_tolerance = 0;
  std::int64_t checked = 0;
  std::int64_t flips = 0;       // outcomes that differ
  double flip_share_upper = 0;  // upper end of the exact 95 % interval of their share
  std::vector<DemandError> demands = {};
};

// The same numbers, to the bit, on any number of ranks. Collective; the answer is on the root, empty on the others.
Accuracy check_accuracy(const parallel::Communicator&, const Study&, const Evaluator&, std::int64_t samples);

// {tolerance, tighter_tolerance, samples_checked, outcome_flips, flip_share, flip_share_upper, edps: {NAME: {unit,
// median_error, p95_error, largest_error, median_demand}}}: of demands that any sample tells
nlohmann::ordered_json accuracy_json(const Accuracy&);

// Sentences for what a user must know: demands known to worse than 1 %, more than 1 % of chaotic samples.
std::vector<std::string> accuracy_warnings(const nlohmann::ordered_json& accuracy);

// Of one sample: {tolerance, tighter_tolerance, outcome_flips, errors: {NAME: absolute difference}}.
nlohmann::ordered_json accuracy_json(double tolerance, const Response& response, const Response& tighter);

// The tolerance to check against.
double tighter(double tolerance);

}  // namespace freestand::study
