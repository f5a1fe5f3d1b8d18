// Independent simulator of the freestanding rigid block: time-stepping with contact impulses.
//
// It shares nothing with src/dynamics. State: centre of mass (X, Y) and rotation theta (clockwise) in the frame of the
// floor. In every step of fixed length dt the velocity v = (X', Y', theta') changes by
//   v+ = v + dt (-a + X/M, -(g + v_floor), 0) + diag(1/M, 1, 1/k^2) J^T p,
// where p are the impulses at the corners that are closed in the step. They obey, corner by corner,
//   normal:   0 <= p_n  perpendicular to  J_n v+ >= 0                     (plastic: no rebound)
//   friction: p_t = -mu p_n sgn(J_t v+), or J_t v+ = 0 and |p_t| <= mu p_n  (Coulomb)
// (Moreau 1988, Stewart & Trinkle 1996). The problem has at most two corners; it is solved exactly by trying the cases
// {no corner, left, right, both} x {stick, slip to the right, slip to the left} and taking the consistent one.
// J is taken at the middle of the step for the impulses and at its end for the velocities, forces at its middle, so
// smooth motion is followed to second order in dt. A step in which a corner meets the floor, the contact meets the wall,
// slip stops or reverses, or grip breaks is cut there. A corner that carries is put back on the floor after each step,
// one that sticks is put back to where it stuck.
//
// Static friction above kinetic friction (mu_s > mu_k), stated since Coulomb's law with two coefficients has no unique
// form. A contact that stuck, or that closes (an impact), tries to stick with mu_s first, then slips with mu_k. A
// contact that slipped goes on slipping with mu_k in its direction while that is consistent; when it would reverse it
// tries to stick with mu_s, and reverses with mu_k otherwise. Both corners closed and stuck: only the sum of the two
// friction forces is determined, and it is bounded by mu_s times the sum of the normal forces.
//
// Where friction is so strong that a corner could as well go on carrying as leave the floor, it goes on as it does beyond Painleve's
// paradox, and leaves where pressure_friction makes it grow without bounds as the pressure falls.
//
// A block that cannot slip lifts off from both corners only; on one of them it turns about a hinge, as Housner's does.
//
// With legs the corner is that of the block over them and the foot under them slips: stuck, its force is that of the
// legs; legs pass on no blow, and a foot in the air has no force, so that its legs relax.
//
// Walls: the side face of the block is a rectangle's, as high over the centre of mass as the base is under it. Its two
// ends, the lower and the upper edge, meet a smooth wall each on its own. A blow turns the edge's speed v into -e v; the
// corners that are closed, and edges that rest against walls, take part in it as in a step, without rebound. An edge
// that comes so slowly that its rebound would be over within the step stays at the wall: from then on
//   0 <= p_wall  perpendicular to  J_wall v+ <= 0.
// The upright face meets the wall as a whole and comes back upright. A block that stands against the wall: friction
// holds it as far as it can, the wall takes the rest, and pushes where it has to between floor and top.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "support/contact_laws.hpp"
#include "support/floor_line.hpp"

namespace freestand::test {

enum Corner { left = 0, right = 1 };
enum Edge { lower = 0, upper = 1 };
inline constexpr int edge_count = 4;                 // of both sides: number 2 side + edge
enum class Grip { none, stuck, to_right, to_left };  // friction state of the closed corners; none: nothing closed
inline int direction(Grip grip) { return grip == Grip::to_right ? 1 : grip == Grip::to_left ? -1 : 0; }

struct ContactBody {
  double left_m = 0, right_m = 0, height_m = 0, gyration2_m2 = 0;  // as in Block
  bool can_slip = true, can_tip = true;
  bool housner = false;      // impact law; else plastic impulses
  double impact_factor = 1;  // on Housner's rate
};

class MoreauStepper {
 public:
  MoreauStepper(const ContactBody& body, const ContactLaws& laws);

  // One step. False: no case is consistent.
  bool step(const FloorLine& floor, double t, double dt);
  // Passes over dt, if the block is stuck on both corners and stays so however the floor moves between its ends.
  bool rest(const FloorLine& floor, double t, double dt);

  double slip() const { return slip_of(state_); }  // displacement of the middle of the base
  double rotation() const { return state_.theta; }
  double rotation_rate() const { return state_.v.q; }
  double path() const { return state_.path; }
  double acceleration() const {
    return state_.acceleration;
  }  // absolute, horizontal, of the centre of mass, blows left out
  // Largest total acceleration of the centre of mass in the last step, blows left out: without gravity, as the floor's is.
  double felt() const { return felt_; }
  double contact_speed() const { return state_.w; }  // of the foot, with legs
  bool closed(Corner k) const { return state_.closed[k]; }
  bool slips() const { return state_.grip == Grip::to_left || state_.grip == Grip::to_right; }
  bool flies() const { return state_.grip == Grip::none; }
  // It came down from flight so flat that less than anyone computes decides which corner came first.
  bool landed_nearly_flat() const { return landed_nearly_flat_; }
  bool at_wall() const { return state_.touching != 0; }
  // What met a wall in the last step.
  struct Strikes {
    bool face = false, lower = false, upper = false, in_flight = false;
  };
  Strikes strikes() const { return strikes_; }
  bool chain_broken() const { return state_.chain_broken; }
  double closing_speed() const { return closing_speed_; }  // of the corner that closed in the last step, 0: none

 private:
  struct Velocity {
    double x = 0, y = 0, q = 0;
  };
  struct Arm {  // from the centre of mass to a point
    double x = 0, y = 0;
  };
  struct State {
    double x = 0, y = 0, theta = 0, c = 1, s = 0;  // c, s: cosine and sine of theta
    Velocity v;
    std::array<bool, 2> closed{true, true};
    Grip grip = Grip::stuck;
    double w = 0, w_rate = 0;               // speed of the foot
    double first_w = 0;                     // of a foot under legs, as the last step began
    bool struck = false;                    // a blow, and no step since
    double base_rate = 0, corner_rate = 0;  // accelerations of the middle of the base and of the corner, last step
    double normal = 0;                      // normal force per mass, last step
    double foot = 0;                        // where the contact is stuck
    double stuck_since = 0, path = 0, legs = 0;
    double contents = 0, contents_v = 0, contents_rate = 0;
    double acceleration = 0, felt = 0;
    double margin = std::numeric_limits<double>::quiet_NaN(), margin_time = 0;  // grip to spare, in the last step
    unsigned touching = 0;                                                      // edges at walls, as bits
    bool chain_broken = false;
  };
  // One step, before its impulses are known.
  struct Step {
    double t, dt;
    std::array<Arm, 2> push, stop;  // arms of the impulses, and of the velocities that must not point into the floor
    std::array<bool, 2> near{false, false};
    std::array<Arm, edge_count> wall_push, wall_stop;  // of the edges, likewise
    unsigned touching = 0;                             // edges that may meet an impulse
    int struck = -1;                                   // edge that leaves the wall at `rebound`
    double rebound = 0;
    Velocity free;        // what the velocity becomes without contact
    double a = 0, g = 0;  // at the middle
    double leg_force = 0, contents_force = 0;
    double lift = 0;    // by the chain
    double corner = 0;  // speed of the corner over the legs as the step begins
    ContactLaws::Place place;
    double speed = 0, age = 0;
    bool blow = false;
  };
  // The impulses of a case, and what they lead to.
  struct Case {
    Velocity next;
    double tangential = 0;
    std::array<double, edge_count> wall{};
    std::array<double, 2> normal{0, 0};
    double slip = 0, legs = 0;  // speed of the foot and deflection of the legs after it
    double middle_slip = 0;     // of a foot under legs, in the middle of the step
    double first_slip() const { return 2 * middle_slip - slip; }
    double total() const { return normal[left] + normal[right]; }
  };
  struct Event {
    enum class Kind { none, closing, wall, slip_end, grip_break, chain_break, tether } kind = Kind::none;
    double after = 0;
    int edge = -1;
  };
  // Which contacts carry in a case.
  struct Contacts {
    bool left = false, right = false;
    unsigned edges = 0;  // as bits
    bool none() const { return !left && !right; }
    bool flat() const { return left && right; }
  };

  // Of the case that would go on as before, where it was not allowed.
  struct Refused {
    double slip = std::numeric_limits<double>::quiet_NaN(), margin = std::numeric_limits<double>::quiet_NaN();
    double first_slip = 0;  // of a foot under legs, as the step begins
  };

  Arm arm(Corner k, double c, double s) const;
  double gap(const State& state, Corner k) const { return state.y + arm(k, state.c, state.s).y; }
  Corner carrier(const State& state) const { return state.closed[left] ? left : right; }
  double contact_position(const State& state) const;  // displacement of the carrying corner
  double slip_of(const State& state) const;
  double middle_speed(const State& state) const;
  void turn(State& state, double theta) const;
  Arm edge_arm(int edge, double c, double s) const;
  double clearance(const State& state, int edge) const;  // from its wall
  // But for round-off: a rate under which it turns by less than 1e-16 in a minute.
  bool standing(const State& state) const { return std::abs(state.theta) < 1e-18 && std::abs(state.v.q) < 1e-18; }
  double chain_displacement(double x, double c, double s) const;
  double chain_rise(double y, double c, double s) const;
  double chain_pull(const State& state) const;
  Step prepare(const State& state, const FloorLine& floor, double t, double dt) const;
  bool impulses(const Step& step, const State& state, Contacts contacts, Grip grip, Case& c) const;
  bool impulses_at(const Step& step, const State& state, Contacts contacts, Grip grip, Case& c) const;
  bool one_corner(const Step& step, Corner k, Grip grip, Case& c) const;
  void both_corners(const Step& step, Grip grip, Case& c) const;
  bool against_face(const Step& step, int side, Case& c) const;
  bool with_edges(const Step& step, Contacts contacts, Grip grip, Case& c) const;
  void sway(const Step& step, const State& state, Grip grip, Case& c) const;
  bool allowed(const Step& step, const State& state, Contacts contacts, Grip grip, const Case& c) const;
  bool possible(const Step& step, const State& state, Contacts contacts, Grip grip) const;
  bool meets_floor(const Step& step, const State& state, Contacts contacts) const;
  bool hinged(const Step& step) const;
  double holding(const Step& step, const Case& c) const;
  double margin(const Step& step, const Case& c) const;
  bool choose(const Step& step, State& state, Case& chosen, bool closing, Refused& refused) const;
  bool advance(State& state, const FloorLine& floor, double t, double dt, std::optional<Grip> forced,
               Refused& refused) const;
  void move(const State& before, State& state, const Step& step, const Case& c) const;
  Event first_event(const State& before, const State& after, double t, double dt, const Refused& refused) const;
  double grip_breaks_after(const State& before, double margin, double t, double dt) const;
  void meet(const Event& event, double t, double dt);
  void hold(double t);
  void lie_down();
  void collide(double t, double dt);
  void strike(Corner from);
  bool short_hop(double dt) const;
  double into_wall(const State& state, int edge) const;
  void look_about(Step& step, double t) const;
  void meet_wall(int edge, double t, double dt);
  bool strike_edge(int edge, double back, double t);

  ContactBody body_;
  ContactLaws laws_;
  State state_;
  double closing_speed_ = 0, felt_ = 0;
  bool landed_nearly_flat_ = false;
  Strikes strikes_;
};

}  // namespace freestand::test
