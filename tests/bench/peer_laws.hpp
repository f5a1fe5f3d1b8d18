// The laws of the effects, one struct each, as one writes them by hand into a fast loop. The block (law_block.hpp) is a
// template of its law, so that what a law does not say costs nothing.
#pragma once

#include <cmath>
#include <vector>

#include "base/units.hpp"
#include "peer_block.hpp"

namespace freestand::bench {

// A block under a law: PeerState, and what laws bring along.
struct LawState : PeerState {
  double path = 0;        // slid by the contact [m]
  double e0 = 0, e1 = 0;  // unknowns of the law's own
  int side = 0;           // on which side of a kink of the law
};

// What is true of a block without effects. A law hides what it changes.
struct NoLaw {
  explicit NoLaw(const std::vector<double>&) {}

  static constexpr bool has_kinks = false;       // the force has a kink where witness() changes its sign
  static constexpr bool is_shaken = false;       // by the vertical channel
  static constexpr bool factor_changes = false;  // during a slip in one direction
  static constexpr bool factor_follows_force = false, factor_follows_path = false;
  static constexpr int own = 0;      // unknowns of its own
  static constexpr double mass = 1;  // M, share of the mass that moves sideways with the block

  double push = 0;                                                    // along the floor [m/s2]
  double gravity = standard_gravity_mps2;                             // across the floor [m/s2]
  double settling_s = 0;                                              // at rest for so long it stays at rest
  static double force(double, double, const LawState&) { return 0; }  // per mass, at displacement u and velocity v
  static double factor(double, double) { return 1; }                  // of friction, at direction of slip and path
};

struct FloorTilt : NoLaw {
  explicit FloorTilt(const std::vector<double>& p) : NoLaw(p) {
    push = gravity * std::sin(p[0]);
    gravity *= std::cos(p[0]);
  }
};

struct VerticalShaking : NoLaw {
  explicit VerticalShaking(const std::vector<double>& p) : NoLaw(p), scale(p[0]) {}
  static constexpr bool is_shaken = true;
  double scale;
};

struct DirectionalFriction : NoLaw {
  explicit DirectionalFriction(const std::vector<double>& p) : NoLaw(p), asymmetry(p[0]) {}
  double factor(double sigma, double) const { return 1 + asymmetry * sigma; }
  double asymmetry;
};

struct FrictionWear : NoLaw {
  explicit FrictionWear(const std::vector<double>& p) : NoLaw(p), last(p[0]), over_path(1 / p[1]) {}
  static constexpr bool factor_changes = true, factor_follows_path = true;
  double factor(double, double path) const { return last + (1 - last) * std::exp(-path * over_path); }
  double last, over_path;
};

// F(N/(m g)) = (N/(m g))^k; the block asks for it by share(), not by factor().
struct PressureFriction : NoLaw {
  explicit PressureFriction(const std::vector<double>& p) : NoLaw(p), exponent(p[0]) {}
  static constexpr bool factor_follows_force = true;
  double share(double normal) const { return std::pow(std::fmax(normal, 1e-18), exponent); }
  double exponent;
};

struct ViscousDrag : NoLaw {
  explicit ViscousDrag(const std::vector<double>& p) : NoLaw(p), rate(p[0]) {}
  double force(double, double v, const LawState&) const { return -rate * v; }
  double rate;
};

struct CenteringSpring : NoLaw {
  explicit CenteringSpring(const std::vector<double>& p) : NoLaw(p), w2(4 * pi * pi * p[0] * p[0]) {}
  double force(double u, double, const LawState&) const { return -w2 * u; }
  double w2;
};

// force -c v |v|
struct QuadraticDrag : NoLaw {
  explicit QuadraticDrag(const std::vector<double>& p) : NoLaw(p), rate(p[0]) {}
  static constexpr bool has_kinks = true;
  double force(double, double v, const LawState& y) const { return -y.side * rate * v * v; }
  static double witness(double, double v, int side) { return side * v; }
  static int side_at(double, double v) { return v < 0 ? -1 : 1; }
  static int side_beyond(double, double, int side) { return -side; }
  double rate;
};

// Slack, held back, or longer than its slack but coming back so fast that spring and dashpot together do not pull.
struct SlackTether : NoLaw {
  explicit SlackTether(const std::vector<double>& p)
      : NoLaw(p), way(p[0] < 0 ? -1 : 1), slack(std::abs(p[0])), w2(4 * pi * pi * p[1] * p[1]), rate(p[2]) {}
  static constexpr bool has_kinks = true;
  enum Side { loose, pulls, longer };
  double force(double u, double v, const LawState& y) const {
    return y.side == pulls ? -way * (w2 * (way * u - slack) + rate * way * v) : 0.0;
  }
  double witness(double u, double v, int side) const {  // above zero as long as it is on that side
    const double stretch = way * u - slack, pull = w2 * stretch + rate * way * v;
    return side == loose ? -stretch : std::fmin(stretch, side == pulls ? pull : -pull);
  }
  int side_at(double u, double v) const {
    const double stretch = way * u - slack;
    return stretch < 0 ? loose : w2 * stretch + rate * way * v > 0 ? pulls : longer;
  }
  // What zero is crossed to: both witnesses are zero there but for round-off.
  int side_beyond(double u, double v, int side) const {
    const double stretch = way * u - slack, pull = w2 * stretch + rate * way * v;
    if (side == loose) return way * v * rate >= 0 ? pulls : longer;
    if (stretch <= std::abs(side == pulls ? pull : -pull) / w2) return loose;
    return side == pulls ? longer : pulls;
  }
  double way, slack, w2, rate;
};

// Unknowns: displacement of the contents in the block, and its rate.
struct MovingContents : NoLaw {
  explicit MovingContents(const std::vector<double>& p)
      : NoLaw(p), share(p[0]), w2(4 * pi * pi * p[1] * p[1]), damping(4 * pi * p[2] * p[1]), mass(1 - p[0]) {
    settling_s = 1 / p[1];
  }
  static constexpr int own = 2;
  double force(double, double, const LawState& y) const { return share * (w2 * y.e0 + damping * y.e1); }
  double rate_of_speed(const LawState& y, double acceleration) const {
    return -acceleration - w2 * y.e0 - damping * y.e1;
  }
  double share, w2, damping, mass;
};

}  // namespace freestand::bench
