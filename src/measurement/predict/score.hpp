// How far the model is from one test, and from many.
//
//   histories  e^2 = mean over channels and time of ((model - measured)/noise)^2;  e = 1: as good as the sensor can tell
//              score = ln(e^2): a test of large slips does not drown the others, and at the truth it weighs as the
//              likelihood does
//   peaks      score = mean of ln(model/measured)^2 over the peaks that are known, each not above 3^2, with
//              ln((x + sqrt(x^2 + (10 noise)^2))/2) for ln x where a noise is stated, so that peaks below ten times that weigh by
//              it (a tenth is what peaks scatter by at least); peaks below least_motion(), measured or computed, count as that. So a specimen that stood still (0) is a hit where the
//              model stands still too, and a miss like any other where it moves. A slip that remains to the other side is missed
//              by the limit, where any of the set has a sign (sizes alone say nothing of sides). Of a test that fell nobody says whether
//              its peaks hold the fall, which the model's do not: 0 where the model falls too, 3^2 where it stands, and 3^2
//              where the model falls and the test is known to have stood
//   outcomes   score = (p - y)^2, y = 1 overturned; p = share of the placements (ModelSpec::placement_scatter) in which
//              the model overturns: Brier's
#pragma once

#include "measurement/predict/bench.hpp"

namespace freestand::measurement {

enum class Kind { history, peaks, outcome };  // what a test can be judged by, the first that it has
Kind kind(const Test&);
Kind kind_of_set(const Bench&);  // of its first calibration test

struct TestError {
  double score = 0;
  double noise_units = 0;  // e; nan where no noise is known
  double relative =
      0;  // rms error over the measured peak, of the channel that moves() and where it is greatest; of peaks |model/measured - 1|, and 1 where only the
          // model moves; nan for outcomes
  double probability = 0;  // of overturning, outcomes only
};

// The least peak that is told from standing still, in the channel's unit (block acceleration: g): the sensor's noise;
// where that is not stated, a thousandth of the greatest such peak of the calibration tests, and at least 1e-6.
double least_motion(const Bench&, Channel);

bool fell(const Test&);
// Sizes alone say nothing of sides: signs count where any of the set's slips that remain has one.
bool sides_are_known(const Dataset&);
// May peaks of the test be held against the model's? Not where either fell: the fall may be in one and not in the other. Histories
// are held against histories, which both have it.
bool peaks_compare(const Test&, const Response& model);

// ln(model/measured) of each peak that a test knows, limited, over the root of their count: the sum of their squares is its
// score. Of a test that fell one value.
std::vector<double> ln_ratios(const Bench&, std::size_t test, const Prediction&);

// Tests whose peaks tell by how much a model is off. What was still in both, or fell in both, keeps a bound, and its ratio is 0 whatever the
// model's numbers.
struct TellingTests {
  double shares = 0, squares = 0;  // of the peaks of each test, whose weight is one together

  void add(std::span<const double> ln_ratios);
  double count() const { return squares > 0 ? shares * shares / squares : 0; }  // of as many that say equally much
};
TellingTests telling_tests(const Bench&, const std::vector<std::size_t>& tests, const ModelSpec&, const Values& x);

// Does a channel of the test's histories, or any of slip and rotation, exceed eight times its noise?
bool moves(const Bench&, std::size_t test, Channel);
bool moves(const Bench&, std::size_t test);

inline constexpr double failed_error = 1e4;  // noise units of a sample without a history, and no error is greater

TestError test_error(const Bench&, std::size_t test, const Prediction&);  // histories and peaks
TestError test_error(const Bench&, std::size_t test, const ModelSpec&, std::span<const double> x);

TestError outcome_error(const Test&, double probability);

// Of these tests, in their order, at each of the points x.
std::vector<std::vector<TestError>> test_errors(const Bench&, const std::vector<std::size_t>& tests, const ModelSpec&,
                                                const std::vector<Values>& points);
std::vector<TestError> test_errors(const Bench&, const std::vector<std::size_t>& tests, const ModelSpec&,
                                   std::span<const double> x);

// Mean score over these tests, of each of the points x: what fits minimise.
std::vector<double> mean_scores(const Bench&, const std::vector<std::size_t>& tests, const ModelSpec&,
                                const std::vector<Values>& points);
double mean_score(const Bench&, const std::vector<std::size_t>& tests, const ModelSpec&, std::span<const double> x);

// The same of histories by strides: r = model - measured is judged second by second, against where it stood as the second
// began,
//
//   mean over channels and seconds of ln(1 + mean over the second of ((r(t) - r(t0))/noise)^2)
//
// A slip that comes out wrong shifts all that follows; here it costs one second, and a model that is right in all the
// others is seen to be. Its valleys are wide, so that fits which the plain score holds up find the way.
std::vector<double> mean_stride_scores(const Bench&, const std::vector<std::size_t>& tests, const ModelSpec&,
                                       const std::vector<Values>& points);

// The same error with each sample's noise widened by the spread of the replays: 1 where sensor and floor noise explain
// all of it, and parts where the motion is chaotic say nothing.
double explained_error(const Bench&, std::size_t test, const Prediction&, const Spread&);

// e that the true model would show: sqrt(sensor^2 + mean(spread/noise^2)), sensor: the size of its noise that was found, over the stated one.
double expected_error(const Bench&, const Spread&);
// sqrt(mean(spread/noise^2)), over channels and time.
double size_of(const Bench&, const Spread&);

// Positions of the tests of one role.
std::vector<std::size_t> tests_of(const Dataset&, Role);

}  // namespace freestand::measurement
