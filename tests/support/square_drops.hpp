// Measured drops of a square on a floor, and what can be read from them without any law of impact: arcs of free
// flight, the blows between them, and the strikes of one corner while the other carries.
//
// File: x, z, th, vx, vz, vth at 250 Hz [m, rad, s]; the velocity columns are smoothed and are not used.
// Pose: (x, y) of the centre, theta clockwise (as in contact.hpp) from lying on a face; th is counter-clockwise and
// reads about -1.9 degrees on a face (validation/square_drops_test.cpp settles both).
#pragma once

#include <array>
#include <filesystem>
#include <vector>

namespace freestand::test {

inline constexpr double drop_step_s = 1.0 / 250;
inline constexpr double drop_half_side_m = 0.03;
inline constexpr double drop_gyration2_m2 = 0.06 * 0.06 / 6;  // homogeneous

using Triple = std::array<double, 3>;  // x, y, theta
using Drop = std::vector<Triple>;      // a pose per frame

// th of a square at rest on a face, median of the drops, in (-pi/4, pi/4) [rad]; and the scatter between drops.
struct Resting {
  double th_rad, scatter_rad;
};

struct Drops {
  std::vector<Drop> drops;
  Resting resting;
};

// Every traj_*.csv of the folder, in order of their numbers. Throws std::runtime_error: a file that is not as above.
Drops read_square_drops(const std::filesystem::path& folder);

// theta less the nearest quarter turn: in [-pi/4, pi/4].
double tilt(double theta);

// Ballistic motion through frames [first, last): x and theta uniform, y falling with g; by least squares.
struct Arc {
  int first, last;
  double at_frame;        // the instant of `place` and `rate`, in frames
  Triple place, rate;     // [m, rad], [m/s, rad/s]
  Triple scatter;         // of the frames about the arc, with its two parameters counted
  Triple rate_deviation;  // standard deviation of `rate` if frames err independently
};
Arc fit_arc(const Drop& drop, int first, int last, double at_frame);

// The longest runs of frames, each at least 6, that stay on one arc of free flight and rise clear of the floor.
std::vector<std::array<int, 2>> free_flights(const Drop& drop);

// A blow between two free flights that meet in one place: one corner, one instant.
struct Blow {
  int drop;
  Triple place;          // theta is the tilt
  Triple before, after;  // velocities at the instant of the blow
  Triple before_deviation, after_deviation;
};
std::vector<Blow> clean_blows(const Drops& drops);

// A corner strikes while the other carries: rates just before and after, slip speed of the carrying corner before, and
// speed of the centre along the floor after.
struct Strike {
  int drop;
  int pivot;  // +1 right, -1 left: the corner that carried
  double rate_before, rate_after, slip_before, speed_after;
  double misfit;           // of the frames [rad]
  double ratio_deviation;  // of rate_after/rate_before, from the scatter of the frames
};
std::vector<Strike> strikes(const Drops& drops);

// From the corner that is down at this tilt to the centre (sharp corners) [m].
struct Lever {
  double x, y;
};
Lever lever(double tilt);

}  // namespace freestand::test
