// A block on two legs that give way up and down, by tiny steps: the pushes of the legs are taken in the middle of each step, and the foot that
// carries is held by an impulse as far as friction allows. It knows no event and no series, and shares no code with src/dynamics.
#pragma once

#include <functional>
#include <vector>

namespace freestand::test {

struct BlockOnLegs {
  double left_m = 0, right_m = 0, height_m = 0, gyration2_m2 = 0;
  double mu_s = 0, mu_k = 0;
  double frequency_hz = 0, damping = 0;  // up and down, of the block on both legs
  double g = 9.80665;
};

struct FloorPush {
  double along = 0, up = 0;  // accelerations of the floor [m/s2]
};

struct OnLegsAt {
  double slip_m = 0, rotation_rad = 0;
  double left_push = 0, right_push = 0;  // of the legs, over the mass [m/s2]
};

// From rest at t = 0, a point every `steps` steps of the length given; it ends where the block lies on its side.
std::vector<OnLegsAt> step_on_legs(const BlockOnLegs& block, const std::function<FloorPush(double t)>& floor,
                                   double step_s, int steps, int points);

}  // namespace freestand::test
