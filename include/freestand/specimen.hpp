// What stands on the floor: a rigid block, its friction, its impact law, and the model it is computed with.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

namespace freestand {

namespace dynamics {
struct Effect;
}

// Rigid body on a flat base. The centre of mass is at height h over the base, between the two corners.
//
//            _________
//           |         |          theta > 0: clockwise, about the right corner
//           |    x    |  ^       s = sgn(theta): which corner carries
//           |    |    |  | h     R = sqrt(b^2 + h^2), alpha = atan(b/h), p = sqrt(3 g / (4 R)) for the uniform block
//           |____|____|  v
//           <-bl-><-br->
//
struct Block {
  double left_m = 0;        // b_l: centre of mass to left corner, > 0
  double right_m = 0;       // b_r: centre of mass to right corner, > 0
  double height_m = 0;      // h: centre of mass above the base, > 0
  double gyration2_m2 = 0;  // k^2 = I/m about the centre of mass, > 0
  double mass_kg = 1;
  double top_m = 0;  // H: the upper edges over the base, where walls and chains reach; 0: 2 h, as of the uniform block

  // Uniform rectangle of width W and height H: b = W/2, h = H/2, I = m R^2/3.
  static Block rectangular(double width_m, double height_m, double mass_kg);
  // The same outline with the centre of mass in the middle of the width at another height, and with the given radius of
  // gyration about it, k; what is not given is that of the uniform rectangle.
  static Block of_outline(double width_m, double height_m, double mass_kg, std::optional<double> centre_height_m,
                          std::optional<double> gyration_radius_m);

  double full_height_m() const { return top_m > 0 ? top_m : 2 * height_m; }
  double base_m() const { return left_m + right_m; }
  double half_base_m() const { return 0.5 * (left_m + right_m); }
  // Slenderness of the weaker side, alpha = atan(min(b_l, b_r)/h) [rad].
  double alpha_rad() const;
  // Size R to the nearer corner [m] and frequency parameter p = sqrt(g R/(k^2 + R^2)) [rad/s]; sqrt(3g/(4R)) if
  // uniform.
  double size_m() const;
  double p_radps() const;
};

struct Friction {
  double mu_s = 0;  // static coefficient, >= mu_k
  double mu_k = 0;  // kinetic coefficient, >= 0
  // On a floor that moves in both horizontal directions: coefficients across the axis along which they are these, over these, > 0; and
  // how far that axis is turned from the first direction towards the second one (dynamics/plane_ellipse.hpp). Along one line only 1.
  double ratio_across = 1;
  double axis_rad = 0;
};

enum class ImpactLaw { housner, coulomb };

struct Impact {
  ImpactLaw law = ImpactLaw::housner;
  double factor = 1.0;  // times Housner's rate, in [0, 1]; `coulomb` takes no factor
};

// What the block may do: only slide (never tips), only rock (never slips), or both; or only slide, on an elastoplastic
// contact.
enum class Model { slide, rock, slide_rock, bouc_wen };

// Elastoplastic contact of model bouc_wen  [KM05 6.27-6.30]:
//   u_y z' + gamma |u'| z |z|^(n-1) + beta u' |z|^n - u' = 0,   u'' + mu_k g' z = -a;   mu_s plays no part.
// |beta| <= gamma: other contacts would make energy. beta + gamma = 1 makes mu_k the strength; else |z| goes up to
// (beta + gamma)^(-1/n).
struct BoucWen {
  double yield_displacement_m = 0.00254;  // u_y, > 0; the report's values lie between 1e-5 in and 0.1 in
  double exponent = 2;                    // n, >= 1: how sharply the contact yields
  double gamma = 0.5, beta = 0.5;         // with gamma = beta it unloads along a straight line
};

// An effect that acts on the specimen: its declaration (kept elsewhere for the life of the program or of the study) and
// the values of its parameters, in the order of the declaration.
struct EffectUse {
  const dynamics::Effect* effect = nullptr;
  std::vector<double> parameters;
};

// How the block is when the floor begins to move: on one corner where it is rotated or turns, which takes a model that rocks.
// Goes neither with model bouc_wen nor with effect flexible_legs.
struct Start {
  double rotation_rad = 0;  // within pi/2
  double rotation_rate_radps = 0;
  double slip_m = 0;  // of the corner that carries, from where it stood; of the base where the block is upright
  double slip_velocity_mps = 0;  // of the corner that carries, along the floor; of the base where the block is upright

  bool upright_at_rest() const {
    return rotation_rad == 0 && rotation_rate_radps == 0 && slip_m == 0 && slip_velocity_mps == 0;
  }
};

// Another block beside this one, on the same floor: where both only slide, each is a wall to the other, which gives way.
struct Neighbour {
  double gap_m = 0;  // between their faces, >= 0
  int side = 1;      // +1: to the right of the block
  double mass_kg = 1;
  Friction friction = {};
  double restitution = 0;  // of their blows, in [0, 1]
};

// Legs under the two corners that give way up and down alone: springs with dashpots, which push and do not pull.
struct SpringLegs {
  double frequency_hz = 0;  // of the block that goes up and down on both, > 0
  double damping = 0;       // share of critical damping of that, >= 0
};

struct Specimen {
  Block block;
  Friction friction;
  Impact impact;
  Model model = Model::slide_rock;
  std::vector<EffectUse> effects = {};
  BoucWen bouc_wen = {};  // of model bouc_wen
  Start start = {};
  std::optional<Neighbour> neighbour = {};  // of model slide
  std::optional<SpringLegs> legs = {};      // of model slide_rock
};

}  // namespace freestand
