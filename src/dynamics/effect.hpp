// One physical term that the plain Coulomb block lacks, as its file in src/effects declares it. From the declaration
// come the study's keys and their validation, the sampling dimensions, `freestand effects`, the attributes of the
// results and the candidates of the diagnosis.
//
// Hooks act in this order: specimen, floor, friction, force, contact (walls and legs), states. All that an effect does
// not need it leaves out.
//
//   per unit mass of the block, X and Y acting through the centre of mass:
//     f_x = M (x_c'' + a) - X,   f_y = y_c'' + g' - Y,   k^2 theta'' = r_x f_y - r_y f_x + T
//     stuck while |f_x| <= mu_s F f_y;  slipping: f_x = -sigma mu_k F f_y
#pragma once

#include <freestand/specimen.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/tape.hpp"

namespace freestand::dynamics {

// Where and how the block is, for the laws. Units as in Input.
struct At {
  Value u, v, theta, omega, t, path, normal, side, sigma, speed, rest, rise, climb;
  double mu = 0;                 // kinetic friction coefficient without the effects [1]
  Block block = {};              // as the effects leave it
  Value acceleration;            // absolute, of the centre of mass [m/s2]; rates of states only
  std::vector<Value> own_state;  // the effect's own states
};

using Parameters = std::vector<double>;  // in the order of the declaration

struct Parameter {
  std::string name;  // with its unit as suffix
  std::string unit;  // "1" for pure numbers
  std::string summary;
  double lower, upper;  // bounds; lower_open: the lower one is itself not allowed
  bool lower_open = false;
  std::optional<double> neutral = {};   // the value at which the effect vanishes (infinity: as it grows)
  std::optional<double> fallback = {};  // taken where a study does not say; none: the study must say
  double low = 0, high = 0;             // range that is met in practice: where a fit starts
  bool fitted = true;                   // false: known, and `fallback` where an effect is tried on measurements
};

// Input to the equations: the floor under the block.
struct FloorInput {
  double push_mps2 = 0;       // added to the floor's horizontal acceleration
  double gravity_factor = 1;  // times g
  double vertical_scale = 0;  // times the vertical channel
};

// Upright walls beside the block, one on either side. They push at the edge of its side face that touches, and let it slide
// along them.
struct Wall {
  bool stands = false;
  double gap_m = 0;        // from the side face of the upright block where it stands first, >= 0
  double restitution = 0;  // e: share of the edge's speed that comes back
};
struct Walls {
  Wall right, left;

  const Wall& on(int side) const { return side > 0 ? right : left; }
  bool any() const { return right.stands || left.stands; }
  // Of two walls on one side the nearer one is met.
  void stand(int side, double gap_m, double restitution) {
    Wall& wall = side > 0 ? right : left;
    if (!wall.stands || gap_m < wall.gap_m) wall = {true, gap_m, restitution};
  }
};

// Legs that let the block sway sideways over its foot: force -(W^2 y + 2 z W y'), y the deflection.
struct Legs {
  double frequency_radps = 0;  // W; 0: no legs
  double damping = 0;          // z
};

struct OwnState {
  std::string name;
  std::function<Value(const At&, const Parameters&)> rate;
  bool relative_velocity = false;  // of something that keeps its own velocity when the block is struck
};

struct Effect {
  std::string name = {};
  std::string summary = {};  // one line
  std::string law = {};      // as an equation
  std::string source = {};
  std::string suspect = {};  // what in a measurement points to it
  std::vector<Parameter> parameters = {};
  std::vector<std::string> excludes = {};  // effects and models that it does not go with
  std::string twins = {};                  // effects that look the same on some data, and what parts them

  std::function<void(Specimen&, const Parameters&)> specimen = {};
  std::function<void(FloorInput&, const Parameters&)> floor = {};
  std::function<Value(const At&, const Parameters&)> friction = {};  // F [1]
  std::function<Value(const At&, const Parameters&)> force = {};     // X [m/s2]
  std::function<Value(const At&, const Parameters&)> lift = {};      // Y, up [m/s2]
  std::function<Value(const At&, const Parameters&)> moment = {};    // T, about the centre of mass [m2/s2]
  // It does nothing while the middle of the base is nearer than this to where it stood [m]; none: it always acts.
  std::function<double(const Parameters&)> clear_within_m = {};
  // Told as demands [m/s2]: the pull of one chain, and the total acceleration of what moves inside.
  std::function<Value(const At&, const Parameters&)> tension = {}, contents = {};
  std::function<double(const Parameters&)> strength = {};  // of the tension at which it breaks [m/s2]
  std::function<void(Walls&, const Parameters&)> wall = {};
  std::function<void(Legs&, const Parameters&)> legs = {};
  std::function<double(const Parameters&)> carried_mass = {};  // M, share of the mass that the block carries sideways
  std::vector<OwnState> states = {};
  std::function<double(const Parameters&)> settling_s = {};  // a block at rest for so long stays: no state can move it

  // Acts inside the equations of motion, so that every step evaluates it.
  bool dynamic() const {
    return friction || force || lift || moment || wall || legs || carried_mass || !states.empty();
  }
};

}  // namespace freestand::dynamics
