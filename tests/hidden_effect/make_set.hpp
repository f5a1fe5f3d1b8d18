// Measurement sets with a hidden effect: a specimen, its floor motions, what its sensors read; and, apart from them, the
// answer.
//
// A set is a pure function of its request. Every test is scaled until the specimen moves as specimens on shake tables
// do: slips from 15 mm to 0.6 m, rotations from a tenth to six tenths of alpha (at least 8 mm of slip where it does
// both). Sensor noise is Gaussian: of slip 0.28 to 0.6 mm, of rotation 0.2 to 0.6 mrad, of the floor's acceleration
// 0.005 to 0.01 m/s2. A vertical channel is there where the floor's vertical shaking acts, and in half of the other
// sets, where it does not.
//
// The noise of a floor makes some motions other ones (long rocking, stops on a rough floor): the truth itself, on the
// floor as measured, misses them. One calibration test in five may be such a one; of the others and of all held-out
// tests the truth stays within 1.15 noise units, so that there is something a model can be asked for. A set that is
// unpicked has floors as they come: a contact that just holds, or just does not, is where rivals come close.
//
// Floors have steps of 5 ms, or of the sensors where these read faster. Recorders that read slower filter the floor's acceleration first,
// as recorders do, and pass what is slower than 0.4 times their rate.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hidden_effect/draw_truth.hpp"
#include "hidden_effect/generator.hpp"

namespace freestand::test {

struct SetRequest {
  std::vector<std::string> effects;  // hidden ones; none: the plain model is the truth
  std::uint64_t seed = 1;
  int tests = 10;          // of which three in ten, one at least, are held out
  double duration_s = 20;  // mean length of a stochastic motion
  double least_error = 6;  // without any of the effects [noise units]: weaker draws are made again, eight at most
  bool weak = false;       // effects as weak as make 1 to 6 noise units, evenly by the logarithm
  double rate_hz = 200;    // of the sensors: a whole multiple or part of 200
  bool unpicked = false;   // floors of 1.2 to 3 mu g as they come, whatever they do
  std::string fault = {};  // of the laboratory (laboratory.hpp); none: it is as stated
};

struct MadeTest {
  std::string id;
  bool holdout = false;
  FloorSamples floor;                        // as it was
  TruthHistory truth;                        // without noise, at the sensors' readings
  FloorSamples measured_floor;               // with noise, as the sensors read it
  std::vector<double> slip_m, rotation_rad;  // with noise; rotation_rad empty where the block only slides
  double truth_error = 0;  // [noise units] of the truth itself on the floor as measured: no model can do better
};

struct MadeSet {
  std::string name;
  DrawnTruth drawn;
  double slip_noise_m = 0, rotation_noise_rad = 0, floor_noise_mps2 = 0;
  std::string fault = {};  // of the laboratory
  double stated_width = 1,
         stated_noise = 1;   // what the data set states, over what is true; noise: of slip and rotation
  double plain_error = 0;    // [noise units] of the plain model with the best mu, noise aside, over all tests
  double weakest_error = 0;  // see set_errors.hpp
  std::vector<MadeTest> tests;
};

// "none-3", "static_friction+floor_tilt-1", "none-3-drift", "static_friction-3-weak", "none-3-50hz".
std::string set_name(const SetRequest& request);

// Throws std::invalid_argument on an effect that does not exist.
MadeSet make_set(const SetRequest& request);

// dataset.yaml and a csv per test into a folder that is made. The answer is not among them.
void write_set(const MadeSet& set, const std::filesystem::path& folder);
nlohmann::ordered_json answer_of(const MadeSet& set);

}  // namespace freestand::test
