// The equations of spring_legs.hpp, as series of time.
#pragma once

#include <array>

#include "dynamics/contact.hpp"
#include "dynamics/floor_cursor.hpp"
#include "dynamics/rig.hpp"

namespace freestand::dynamics {

inline constexpr int sway_order = 9;
static_assert(sway_order > max_floor_degree);
using SwaySeries = Series<double, sway_order>;

inline constexpr std::array<std::size_t, 2> both_legs{0, 1};  // right, left

struct Leg {
  double offset;                // c_i [m]
  double stands_on;             // N_i0 [m/s2]
  bool on = true;               // it pushes
  bool over_floor = false;      // its foot is in the air; else it is long enough, but rises too fast to push
  bool begins_at_zero = false;  // what ends this starts at zero at this instant
};

struct SpringBase {
  double stiffness, dashpot;  // k, c
  std::array<Leg, 2> legs;    // right, left
};

// Of the centre of mass, from where it stood, and of the rotation.
struct SwayState {
  double x = 0, y = 0, theta = 0, vx = 0, vy = 0, omega = 0;
};

// The block about an instant.
struct Sway {
  SwaySeries x, y, theta, vx, vy, omega;
  std::array<SwaySeries, 2> rise, push;  // e_i, and N_i whether it pushes or not
  SwaySeries total;                      // of what pushes
  Arc<double, sway_order> arc;           // on the corner `held`
};

// held: the foot that carries, or in flight the lower edge: 0 right, 1 left. sigma: of its slip, 0 where it stands.
void sway(const Rig& rig, const SpringBase& base, const SwayState& at, const Floor<double, sway_order>& floor,
          std::size_t held, bool stands, int sigma, Sway& s);

}  // namespace freestand::dynamics
