// Measurements whose numbers themselves look wrong: units, dead and clipped channels, the stated noise.
#pragma once

#include <string>
#include <vector>

#include "measurement/predict/bench.hpp"

namespace freestand::measurement {

struct Doubts {
  std::vector<std::string> sentences;
  std::size_t spoilt_tests = 0;  // for calibration, whose floor or response is not what its column says
};

// "t1, t2, t3": the first eight, and how many more there are.
std::string listed(const std::vector<std::string>& ids);

// Behind a sentence: which of these tests are held out, so that what it says of them decides nothing. Empty: none is.
std::string held_out_note(const Dataset&, const std::vector<std::string>& ids);

// Of every test: sizes above 50 m; steps above 0.1 s, between which a floor of 5 Hz turns; slips above 5 m and rotations above 1.8 rad
// (other units); a slip that remains and is larger than the peak, by more than three standard deviations of the difference of two readings, which
// spoils nothing; a floor above 10 g, or one under which the block moves though it stays below 0.02 g, or three times as fast as the floor's
// velocities differ (other units, or a dead channel; from 1.5 times on it is said, and spoils nothing); a floor that is cut off; slips, rotations
// and floors with an offset (plausible_offsets.hpp), which spoils the test from eight times the noise, or 2 % of the floor's peak, on; channels
// that freeze, are another test's, are mirrored or in another unit (plausible_channels.hpp). Of all calibration tests together: a sensor that
// scatters from sample to sample three times as much as the data set states, or a hundredth of it.
Doubts doubts(const Bench&);

// At least five samples in a row at one and the same extreme value, above ten times the noise.
bool clipped(const std::vector<double>& samples, double noise);

// Clipped, and not merely rounded: the step to the plateau is more than three of the smallest steps of the channel.
bool cut_off(const std::vector<double>& samples, double noise);

double greatest(const std::vector<double>& samples);  // of the absolute values; 0 of none

}  // namespace freestand::measurement
