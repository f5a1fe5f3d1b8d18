// The laws of PHYSICS section 5 as plain numbers, for the contact stepper; written from their text, independently of
// src/effects. A law that is left at its default vanishes.
//
// Friction: slipping with speed w in direction sigma, f_x = -sigma mu_k F f_y; stuck while |f_x| <= mu_s F f_y, F taken
// at w = 0 and for the slip that would begin. F is the product of the factors below.
// Added force per mass, through the centre of mass: X = -c u' - W_c^2 u + tether + contents, u = displacement of the
// middle of the base.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "base/units.hpp"

namespace freestand::test {

struct ContactLaws {
  double mu_s = 0, mu_k = 0;

  // Factors of friction.
  struct Rate {
    double change = 0, speed_mps = 1;  // 1 + change (1 - exp(-|w|/speed))
  };
  std::vector<Rate> rates;
  double wear_ratio = 1, wear_path_m = 1;  // r + (1 - r) exp(-S/l)
  double asymmetry = 0;                    // 1 + d sigma
  double pressure_exponent = 0;            // (f_y/g)^k; 1 in a blow
  // Of no catalogue: what a diagnosis must call unknown.
  double roughness = 0, roughness_length_m = 1;  // 1 + r sin(2 pi u/L)
  double heating = 0, heating_time_s = 1;        // 1 + d (1 - exp(-t/T))
  double ageing = 0, ageing_time_s = 1;          // mu_s (1 + d ln(1 + tau/T)), tau = time stuck

  // Forces per mass.
  double drag_per_s = 0;
  double quadratic_drag_per_m = 0;  // of no catalogue: -c v |v|
  double spring_per_s2 = 0;         // (2 pi f)^2
  struct Tether {
    double slack_m = 0, stiffness_per_s2 = 0, rate_per_s = 0;
  };
  std::vector<Tether> tethers;

  // Floor: push is added to its acceleration, gravity replaces g, the vertical channel is scaled.
  double push_mps2 = 0, gravity_mps2 = standard_gravity_mps2, vertical_scale = 0;

  // Legs: force on the block -(W^2 y + 2 z W y').
  double legs_radps = 0, legs_damping = 0;  // 0: no legs
  // Walls, upright and smooth, one on either side at most.
  struct Wall {
    double gap_m = 0, restitution = 0;  // from the side face of the block as it stands at first
  };
  std::array<std::optional<Wall>, 2> walls;  // to the left, to the right
  bool walled() const { return walls[0] || walls[1]; }

  // A chain that runs to a wall far behind, level or at an angle, and pulls at one point of the block.
  struct Chain {
    int side = 1;                              // pulls back when the point has moved there
    double right_m = 0, up_m = 0;              // the point, from the centre of mass
    double slack_m = 0, stiffness_per_s2 = 0;  // stiffness over mass
    double strength_mps2 = 0;                  // over mass; what pulls harder breaks it for good
    double elevation_rad = 0;                  // of its far end over the point
    double level() const { return std::cos(elevation_rad); }
    double steep() const { return std::sin(elevation_rad); }
    double pull(double displacement_m, double rise_m) const {  // of the point
      return stiffness_per_s2 * std::fmax(side * displacement_m * level() - rise_m * steep() - slack_m, 0);
    }
  };
  std::optional<Chain> chain;

  // Contents: q'' = -(x_c'' + a) - W^2 q - 2 z W q', force r (W^2 q + 2 z W q'), the block carries M = 1 - r sideways.
  double contents_ratio = 0, contents_radps = 0, contents_damping = 0;

  double carried() const { return 1 - contents_ratio; }
  bool frictional_jump() const { return mu_s > mu_k || ageing != 0; }
  bool steady_at_rest() const {
    return contents_ratio == 0 && legs_radps == 0 && heating == 0 && ageing == 0 && pressure_exponent > -1;
  }

  // What the factors depend on, but for slip speed and direction.
  struct Place {
    double u_m = 0, path_m = 0, normal_g = 1, time_s = 0;
  };
  // Ratio of tangential to normal force: of a slip, and at most without one (stuck for age_s, 0: it slips or flies; sigma: the slip that would
  // begin; speed: of the slip that a blow stops).
  double sliding(const Place& at, double speed, int sigma) const { return mu_k * factor(at, speed, sigma); }
  double holding(const Place& at, double age_s, int sigma, double speed = 0) const;

  // X without the contents, from displacement and velocity of the middle of the base.
  double force(double u, double v) const;

 private:
  double factor(const Place& at, double speed, int sigma) const;
};

inline double ContactLaws::factor(const Place& at, double speed, int sigma) const {
  double f = 1 + asymmetry * sigma;
  if (speed > 0)
    for (const Rate& rate : rates) f *= 1 + rate.change * (1 - std::exp(-speed / rate.speed_mps));
  if (wear_ratio != 1) f *= wear_ratio + (1 - wear_ratio) * std::exp(-at.path_m / wear_path_m);
  if (pressure_exponent != 0) f *= at.normal_g > 0 ? std::pow(at.normal_g, pressure_exponent) : 0.0;
  if (roughness != 0) f *= 1 + roughness * std::sin(2 * pi * at.u_m / roughness_length_m);
  if (heating != 0) f *= 1 + heating * (1 - std::exp(-at.time_s / heating_time_s));
  return f;
}

inline double ContactLaws::holding(const Place& at, double age_s, int sigma, double speed) const {
  const double older = ageing == 0 ? 1 : 1 + ageing * std::log1p(age_s / ageing_time_s);
  return mu_s * older * factor(at, speed, sigma);
}

inline double ContactLaws::force(double u, double v) const {
  double x = -drag_per_s * v - quadratic_drag_per_m * v * std::abs(v) - spring_per_s2 * u;
  for (const Tether& tether : tethers) {
    const double side = tether.slack_m < 0 ? -1 : 1, stretch = side * u - std::abs(tether.slack_m);
    if (stretch <= 0) continue;
    const double pull = tether.stiffness_per_s2 * stretch + tether.rate_per_s * side * v;
    if (pull > 0) x -= side * pull;
  }
  return x;
}

}  // namespace freestand::test
