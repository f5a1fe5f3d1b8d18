// The model, as it stands, against every test: how far off, where, and in plain sentences.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "measurement/fit/odd_one.hpp"
#include "measurement/fit/outcome_misfit.hpp"
#include "measurement/laboratory/quality.hpp"
#include "measurement/predict/score.hpp"

namespace freestand::measurement {

// What the block was doing, read off the measured histories.
enum class Phase { stuck, onset, slipping, reversal, rocking, after_impact, at_rest };
inline constexpr int phase_count = 7;
const char* name(Phase);
std::vector<Phase> phases(const Bench&, const Test&);

struct ChannelError {
  Channel channel = Channel::slip;
  double noise_units = 0, relative = 0, bias = 0;  // bias: mean of model minus measured, in the channel's unit
  double autocorrelation = 0;                      // of the residual, one step apart; 0 for white noise
};

// Noise units that the noise of the floor makes alone (`expected`), beyond which a test tells little.
inline constexpr double drowned = 5;

struct TestComparison {
  std::size_t test = 0;
  TestError error = {};
  Values by_draw =
      {};  // outcomes: probabilities by each draw of the numbers, of which that of the error is the mean; or none
  // Histories only, else nan: explained_error(), expected_error(), and what the floor may have done to the history between its readings, root
  // mean square [noise units]: at most so much, of a floor that is not smooth there.
  double explained = 0, expected = 0, unread = 0;
  // Where friction scatters from test to test: a factor on that of this test, with which `explained` is least.
  std::optional<double> own_friction = {};
  std::vector<ChannelError> channels = {};
  Prediction model = {};
  Spread spread = {};
};

// Error where the measured motion had a certain speed, path ...: of all tests of one role together.
struct ErrorTable {
  std::string variable, unit;
  std::vector<std::string> label = {};               // of the bins of `phase`, else empty
  std::vector<double> edge = {}, centre = {};        // edge empty for `phase`
  std::vector<double> count = {}, noise_units = {};  // root mean square
  std::vector<double> growth = {};  // root mean square of the residual's change within 0.1 s, in noise units
  std::vector<double> slip_growth_m = {}, rotation_growth_rad = {};  // the same of one channel; 0: not measured
  std::vector<double> bias = {};                                     // mean residual, in noise units
};

struct Comparison {
  std::vector<TestComparison> tests;  // of all tests, in the order of the data set
  std::vector<std::size_t> worst;     // positions in `tests`, at most five histories
  std::vector<ErrorTable> calibration, holdout;
  std::optional<OutcomeMisfit> misfit;  // of calibration tests that say outcomes only, by the model as fitted to them
  std::vector<std::string> findings;
};

// x: the free numbers. spread, unread: Bench::spread and Bench::unread_spread (histories only; unread may be empty).
TestComparison compare_test(const Bench&, std::size_t test, const ModelSpec&, std::span<const double> x, Spread spread,
                            const Spread& unread = {});
// A friction of its own in that test, within what one of 370 tests lies beyond (Student's t, of the standard deviation of ln friction from test
// to test), and a factor of two.
void give_own_friction(const Bench&, const ModelSpec&, const Values& x, double friction_scatter, double freedom,
                       TestComparison&);
Comparison compare(const Bench&, const ModelSpec&, std::span<const double> x, std::vector<TestComparison> tests,
                   const Quality&, const std::optional<OutcomeMisfit>& misfit = {});

// Mean ln(model/measured) of the peak slips of the tests of one role, and its standard deviation; nan below two. within_ln: half of the
// mean's interval of 95 % (Student's t); infinite below three. The largest of many readings is larger than the slip by some of their noise: the model's peak is the one that its history would show to the
// sensor. noise_ln: root mean square of the standard deviations that the noise of sensor and floor makes of one. still: tests without a ratio,
// since the model stands still.
struct PeakRatio {
  std::size_t count = 0, still = 0;
  double bias_ln = 0, scatter_ln = 0, noise_ln = 0;
  double within_ln = std::numeric_limits<double>::infinity();
  // One test whose ratio is another's beyond what scatter and the sensor's noise make of the furthest.
  std::optional<OddOne> odd = {};
  std::string odd_test = {};

  // Beyond what the tests leave open, what noise makes of them, and the 3 % for which nobody changes a model.
  bool biased() const;
};
PeakRatio peak_ratio(const Bench&, const std::vector<TestComparison>&, std::optional<Role> = {});

}  // namespace freestand::measurement
