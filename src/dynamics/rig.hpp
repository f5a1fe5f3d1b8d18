// The specimen as the kernel reads it, and the state that it integrates.
#pragma once

#include <array>
#include <freestand/response.hpp>
#include <freestand/simulate.hpp>
#include <freestand/specimen.hpp>
#include <optional>

#include "base/units.hpp"
#include "dynamics/contact.hpp"
#include "dynamics/impulse.hpp"
#include "dynamics/kinks.hpp"
#include "dynamics/laws.hpp"
#include "dynamics/point.hpp"

namespace freestand::dynamics {

// On legs a row of hops is gone through to this rotation [rad]: while it lasts the foot slips, which it does not where the row is cut
// off and the foot is stuck. What is left then lasts some 1e-7 s, in which friction changes the base's speed by less than 1e-7 m/s.
inline constexpr double hop_over_legs = 1e-15;

struct Rig {
  double right, left, h, k2;  // [m], [m2]
  double top;                 // height of the upper edges over the base [m]
  double mu_s, mu_k;
  bool can_slip, can_rock;
  Impact impact;
  double g;     // gravity across the floor [m/s2]
  double push;  // gravity along the floor [m/s2]
  std::optional<Laws>
      laws;  // of effects within the equations of motion; on a tilted floor and under pulses too, where they may be none
  // Thresholds, all scaled by the block.
  double force_zero;           // accelerations smaller than this are round-off [m/s2]
  double turn_zero;            // angular accelerations smaller than this are round-off [rad/s2]
  double rest_rotation;        // a hop of less than this rotation ends the rocking [rad]
  double rest_height;          // a rebound from a wall slower than a fall from this height stays at the wall [m]
  double told_rotation;        // an impact after a rotation of less than this is not counted [rad]
  std::optional<Point> point;  // whose acceleration is followed
  double instant_s;            // what is closer together happens at once: events are located no better [s]
  double told_speed;           // nor a blow of a wall that comes slower than this [m/s]
  double brief_s;  // beside a wall two blows that are closer together than a throw at that speed are one [s]

  // as_under_laws: by the equations with laws (law_step.hpp), though there may be none.
  Rig(const Specimen& specimen, const Settings& settings, const FloorInput& floor = {}, bool as_under_laws = false)
      : right(specimen.block.right_m),
        left(specimen.block.left_m),
        h(specimen.block.height_m),
        k2(specimen.block.gyration2_m2),
        top(specimen.block.full_height_m()),
        mu_s(specimen.friction.mu_s),
        mu_k(specimen.friction.mu_k),
        can_slip(specimen.model != Model::rock),
        can_rock(specimen.model != Model::slide),
        impact(specimen.impact),
        g(standard_gravity_mps2 * floor.gravity_factor),
        push(floor.push_mps2),
        // An event is located to about 1e-14 s, within which floors and laws change accelerations by less than 1e3 g/s.
        force_zero(1e-11 * g),
        turn_zero(force_zero / specimen.block.size_m()),
        rest_rotation(settings.tolerance),
        rest_height(settings.tolerance * specimen.block.size_m()),
        // Rows of hops and of rebounds have no last one. What is counted ends at a thousandth of what overturns the block; no
        // motion depends on it.
        told_rotation(1e-3 * specimen.block.alpha_rad()),
        instant_s(1e-14 / specimen.block.p_radps()),
        told_speed(1e-3 * specimen.block.p_radps() * specimen.block.size_m()),
        brief_s(2 * told_speed / g) {
    if (as_under_laws || has_laws(specimen) || push != 0) laws.emplace(specimen);
    if (laws && laws->legs.frequency_radps > 0) rest_rotation = std::fmin(rest_rotation, hop_over_legs);
    if (!std::isnan(settings.acceleration_height_m)) point = {0.5 * (right - left), settings.acceleration_height_m - h};
  }

  // What laws do to a block that rests, up to some time: the largest force, lift and moment, the least friction factor.
  struct AtRest {
    double force = 0, lift = 0, moment = 0, factor = 1;
    bool known = true;
    double until = std::numeric_limits<double>::infinity();  // [s]; infinite: they do not change at all
    bool constant() const { return known && until == std::numeric_limits<double>::infinity(); }
  };
  // No floor acceleration with |a| <= a_max, |v| <= v_max can move the block from rest.
  bool stays_put(double a_max, double v_max, const AtRest& rest) const {
    const double weight = g - v_max - rest.lift, push_max = carried_mass() * a_max + rest.force;
    return rest.known && (!can_slip || push_max < mu_s * rest.factor * weight) &&
           (!can_rock || h * push_max + rest.moment < (right < left ? right : left) * weight) && weight > 0;
  }

  double offset(int pivot) const { return pivot > 0 ? right : -left; }
  Corner<double> corner(int pivot) const { return {offset(pivot), h, k2}; }
  // What moves away from a wall no faster than this stays at it [m/s].
  double slow() const { return std::sqrt(2 * g * rest_height); }
  double half_base() const { return 0.5 * (right + left); }
  double carried_mass() const { return laws ? laws->carried_mass : 1; }
  // About the pivot, per mass.
  double inertia(int pivot) const { return k2 + carried_mass() * h * h + offset(pivot) * offset(pivot); }

  double hop_rotation(int pivot, double omega) const {
    return dynamics::hop_rotation(inertia(pivot), omega, g, offset(pivot));
  }
};

// What of the side face touches a wall: of an upright block all of it. A block on the corner beside the wall touches it with
// the upper edge, one on the other corner with the lower one.
enum class Edge { face, lower, upper };
inline Edge touching_edge(int pivot, int side) {
  return pivot == 0 ? Edge::face : pivot == side ? Edge::upper : Edge::lower;
}

// Where the block is. `pivot`: +1 right corner, -1 left corner, 0 both or none. `sigma`: direction of slip, 0 when
// stuck.
struct State : Kinks {
  Mode mode = Mode::rest;
  int pivot = 0;
  int sigma = 0;
  double theta = 0, omega = 0;  // [rad], [rad/s]
  double xi = 0, w = 0;         // contact's displacement and slip speed, when a corner is down [m], [m/s]
  double x = 0, vx = 0;         // centre of mass relative to the floor, in flight [m], [m/s]
  double y = 0, vy = 0;
  double doubt = 1;  // by how much more than round-off the last choice of mode took for zero

  // With laws only.
  double path = 0;         // slid by the contact [m]
  double deflection = 0;   // of the legs [m]
  double foot = 0;         // slip speed of the contact under the legs [m/s]
  double still_since = 0;  // the contact, if it stands still: since the last slip, flight or blow [s]
  std::array<double, max_states> states{};
  // An edge of the side face stays at the wall on that side (+1, -1; 0: none does), and which. One that is `released` leaves
  // the wall at this very instant. An upright block on the floor touches a wall by its displacement alone.
  int wall = 0;
  Edge edge = Edge::face;
  bool released = false;

  // For how long the contact has stood still [s].
  double rested(double time) const { return sigma == 0 && mode != Mode::flight ? time - still_since : 0; }
  bool at_wall() const { return wall != 0 && !released; }
  // It is this edge of that side, alone or with its whole face, that is at the wall.
  bool is_by(int side, Edge which) const { return wall == side && (edge == Edge::face || edge == which); }
};

}  // namespace freestand::dynamics
