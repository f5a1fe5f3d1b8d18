// Measurements of specimens on a shaken floor: what was put in, what came out, test by test.
#pragma once

#include <algorithm>
#include <filesystem>
#include <freestand/floor_motion.hpp>
#include <freestand/specimen.hpp>
#include <optional>
#include <string>
#include <vector>

namespace freestand::measurement {

enum class Role { calibration, holdout };  // holdout: never used by a fit

// Of a specimen, as far as they were measured.
struct Dimensions {
  std::optional<double> width_m, height_m, mass_kg;
  std::optional<double> centre_height_m = {}, gyration_radius_m = {};  // not given: those of a uniform rectangle

  bool operator==(const Dimensions&) const = default;
};

// Standard deviations of the sensors; 0: not given.
struct Noise {
  double slip_m = 0, rotation_rad = 0, block_acceleration_mps2 = 0, floor_acceleration_mps2 = 0;
};

// How far off a stated dimension or the gain of the floor's accelerometer may be: standard deviations, over what is stated;
// and by how much the clock of the responses may differ from the floor's [s]. As assumed where the laboratory states none:
// a tape on half a metre, a centre of mass as it is found by balancing the specimen on an edge, an accelerometer as its
// maker calibrates it, recorders that one signal starts, each at its next sample of some 0.03 s at most.
struct Tolerance {
  double width = 0.01, centre_height = 0.02, floor_gain = 0.01, clock_s = 0.01;
};

// What is known of a test as single numbers.
struct Peaks {
  std::optional<double> peak_slip_m, residual_slip_m, peak_rotation_rad, peak_acceleration_g;
  std::optional<bool> overturned;

  bool operator==(const Peaks&) const = default;
};

inline constexpr int most_steps_a_reading = 1000;

struct Test {
  std::string id;
  Role role = Role::calibration;
  std::string source;   // file, or words for a pulse, as messages name it
  Dimensions specimen;  // the data set's, with the test's own over it
  Start start;          // how the specimen was when the floor began to move
  FloorMotion motion;   // as measured; or a pulse of unit peak acceleration and unit period
  // Straight ones of the motion, from one reading of the floor to the next (floor_readings.hpp).
  int pieces_a_reading = 1;

  double scale = 1;    // on the motion
  double stretch = 1;  // of time: the period of a pulse
  std::string pulse;   // its name; empty: a measured motion
  double dt_s = 0;     // of the histories
  // The response was read once in so many of them, at the first and every so many behind, and stands on straight lines between.
  int steps_a_reading = 1;

  // Histories from time 0 on, in steps of dt_s, equally long; empty: not measured. slip_m: horizontal displacement of
  // the midpoint of the base relative to the floor [m]; rotation positive clockwise [rad]; block_acceleration: absolute,
  // horizontal, of the centre of mass [m/s2].
  std::vector<double> slip_m, rotation_rad, block_acceleration_mps2;
  Peaks peaks;
  std::vector<std::string> unused_columns;  // of its file, whose names say nothing to freestand

  bool has_history() const { return points() > 0; }
  std::size_t points() const { return std::max({slip_m.size(), rotation_rad.size(), block_acceleration_mps2.size()}); }
  bool has_vertical() const { return !motion.vertical_mps2.empty(); }
  Shaking shaking() const { return {.motion = &motion, .scale = scale, .stretch = stretch}; }  // points into the test
};

struct Dataset {
  std::string name;
  std::filesystem::path file;  // dataset.yaml
  double sampling_dt_s = 0;    // 0: no histories
  Dimensions specimen;
  Noise noise;
  Tolerance tolerance;
  std::vector<Test> tests;
};

}  // namespace freestand::measurement
