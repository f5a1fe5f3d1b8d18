// What a fragility analysis is asked to do. Fixed before the first sample is counted.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace freestand::fragility {

// A demand parameter (EDP) and the capacities its surface is wanted at.
struct EdpOptions {
  std::string name;  // as in the column edp_<name>
  std::string unit = "1";
  std::string symbol = {};     // for axis labels
  bool binary = false;         // 0 or 1, such as "overturned": its mean is itself the probability
  double still_threshold = 0;  // the sample stood still, as far as this EDP is concerned, at or below this value
  std::vector<double> capacities = {};  // increasing, > 0; a binary EDP has the one capacity 0.5, whatever stands here
  bool censored = true;  // overturned samples are above every capacity; else they count by their own value
};

// A second axis of the surfaces: a column of the samples and its bin edges.
struct AxisOptions {
  std::string name;  // name of the column, such as friction_mu_k
  std::string unit = "1";
  std::vector<double> edge;  // increasing, at least two
};

// What Options::resamples may be: two make a spread, and each has a counter of its own in Resampling.
inline constexpr int least_resamples = 2, most_resamples = 60000;
inline constexpr int most_scrambles = 128;       // tallies are counted for each
inline constexpr int least_minimum_samples = 2;  // a fit needs two

struct Options {
  std::string im_name;  // as in the column im_<name>
  std::string im_unit = "1";
  std::optional<double> im_period_s = {}, im_damping = {};  // of the oscillator of a spectral intensity
  std::vector<double> im_edge;  // increasing, at least two: bin i holds im_edge[i] <= IM < im_edge[i + 1]; the last
                                // edge belongs to the last bin
  bool open_ends =
      false;  // the first bin reaches down, and the last one up, without end: edges laid over a few samples
  std::vector<EdpOptions> edps;
  std::vector<AxisOptions> axes;

  // For each motion of the study (index = column `motion`): of a record the number of its group (records of one
  // earthquake, two components of one station; else each by itself), whose samples are not independent; -1 a family of
  // pulses, where every sample is a motion of its own. Empty: every sample is a motion of its own.
  std::vector<int> motion_group;

  int scrambles = 1;  // sample i is of design i mod scrambles (sampling/design.hpp)

  // ln EDP of a bin is told against a straight line over ln IM, fitted to the first samples: slope of each [edp][bin], and
  // the IM at which it is 0 [bin]. Empty: no slopes. pilot.hpp fills them.
  std::vector<std::vector<double>> pilot_slope;
  std::vector<double> pilot_im;

  int minimum_samples =
      30;  // a bin (or cell of a surface) with fewer is left empty; as many must have moved and stood for a fit
  int resamples = 500;            // of the motions, for the bands
  double confidence = 0.95;       // of all intervals and bands
  double false_discovery = 0.05;  // Benjamini-Hochberg level of the goodness-of-fit tests over the bins
  double adequate = 0.05;         // a fit is used where it is off by no more (BinFit::off_by), whatever its test says
  // What is wanted of the surface's points (least_wanted of half_width.hpp). The band of a fit knows of no misfit, so that a fit stands for a
  // bin only where its misfit takes no more than half of that.
  double half_width = 0.5;
  bool empirical_fallback = true;  // a bin whose fit may be off by more takes its surface row from the counts
  std::uint64_t seed = 1;          // of resampling and of the bootstrap of the test statistics
};

}  // namespace freestand::fragility
