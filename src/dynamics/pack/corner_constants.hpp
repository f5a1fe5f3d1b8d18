// What a sample of slide-rock needs on either corner, computed once.
#pragma once

#include <cmath>

#include "dynamics/batch.hpp"
#include "dynamics/pack/search.hpp"

namespace freestand::dynamics::FREESTAND_ISA {
namespace {

inline double smaller(double a, double b) { return b < a ? b : a; }

// The share of |f''| by which a grip, or a force, leaves its chord.
inline double bent_share(double mu_s) { return (mu_s > 0.5 ? 1 + mu_s : 1.5) / 8; }

struct CornerConstants {
  double arm, per_inertia;  // signed, as c in dynamics/contact.hpp; 1/J
  double weight, tip, kappa,
      kappa_by_a;      // beta = weight + tip a pulls the block back; kappa - kappa_by_a a: d theta''/d theta there
  double kept;         // of the rate, at the impact that ends the stay on this corner
  double per_weight;   // 1/weight: a free hop with rate omega turns by omega^2/(2 weight)
  double told, rests;  // squared rates of the hops at whose end an impact counts, or rest begins
  double curvature0, curvature1, curvature2;  // bounds of what the forces do within an interval, in rates per interval
  double lift_curvature;  // as curvature1, for changes of the floor's vertical acceleration times h^2

  CornerConstants(const BatchCase& c, int side) {
    const double b = side > 0 ? c.right : c.left, other = side > 0 ? c.left : c.right, size2 = c.h * c.h + b * b;
    arm = side * b;
    per_inertia = 1 / (c.k2 + size2);
    weight = c.g * b * per_inertia;
    tip = side * c.h * per_inertia;
    kappa = c.g * c.h * per_inertia;
    kappa_by_a = side * b * per_inertia;
    const double ratio = (c.k2 + c.h * c.h - b * other) / (c.k2 + c.h * c.h + other * other);
    kept = c.factor * larger(ratio, 0);
    per_weight = 1 / weight;
    told = 2 * weight * c.told_rotation;
    rests = 2 * weight * c.rest_rotation;
    bound_curvatures(c, size2);
  }

  double pull(double a, double v) const { return weight + tip * a + magnitude(arm) * per_inertia * v; }

 private:
  // The forces are almost straight within an interval, as the floor's acceleration is. With r = |r|,
  // E = (g + |v| + |a|) h^2/J,
  // |Omega'| <= E r and |Omega| <= |Omega_0| + E r,
  //     |f''| <= r^2 (4 E^2 r + 5 E Omega^2 + 6 (h^2/J) (|da| + |dv|) |Omega|) + smaller terms,
  // and f leaves its chord by |f''|/8 at most; here times 1.5 or 1 + mu, for both forces.
  void bound_curvatures(const BatchCase& c, double size2) {
    const double size = std::sqrt(size2), per = c.table->step_s * c.table->step_s * per_inertia;
    double most = magnitude(c.scale) * c.table->later_peak[0] + magnitude(c.along);
    if (c.vertical_scale != 0) most += magnitude(c.vertical_scale) * c.table->later_vertical_peak[0];
    const double field = (c.g + most) * per;
    const double share = bent_share(c.mu_s);
    curvature0 = share * 17 * size2 * field * field * size;
    curvature1 = share * 6.6 * size2 * magnitude(c.scale) * per;
    lift_curvature = share * 6.6 * size2 * per_inertia;
    curvature2 = share * 17 * size2 * field;
  }
};

// Bounds for small rotations on either corner.
struct HopBounds {
  double tips;             // |a| that comes close to tipping the block; times 1 - |v|/g
  double fx, fx1;          // |f_x| <= fx (1 + |v|/g) + fx1 |a|
  double lift, lift1;      // |f_y - g| <= lift + |v| + lift1 |a|
  double slow, slow1;      // the block falls back with slow (1 - |v|/g) - slow1 |a| at least
  double fast, fast_lift;  // changes of that: fast da + fast_lift dv
  double row;              // a row of hops lasts row/slow times its first rate, at most
  double limit2;           // squared rotation up to which the series of hops holds

  HopBounds(const BatchCase& c, const CornerConstants& left, const CornerConstants& right) {
    const double shorter = smaller(c.left, c.right), rim = larger(c.left, c.right), h2 = c.h * c.h;
    const double most = larger(left.per_inertia, right.per_inertia),
                 least = smaller(left.per_inertia, right.per_inertia);
    tips = 0.98 * shorter * c.g / c.h;
    fx = c.g * c.h * rim * most;
    fx1 = larger(magnitude(1 - h2 * most), magnitude(1 - h2 * least));
    lift = rim * c.g * rim * most;
    lift1 = rim * c.h * most;
    slow = shorter * c.g * least;
    slow1 = c.h * least;
    fast = c.h * most;
    fast_lift = rim * most;
    row = 2 / (1 - larger(left.kept, right.kept));
    const double limit = small_rotation * shorter / c.h;
    limit2 = limit * limit;
  }

  // |a| up to which |f_x| <= fx0 + fx1 |a| and |f_y - g| <= lift0 + lift1 |a| are no larger acceleration than that whose
  // square is force2; negative: none.
  double unseen_push(double fx0, double lift0, double force2) const {
    const double square = fx1 * fx1 + lift1 * lift1, slope = fx0 * fx1 + lift0 * lift1;
    const double room = force2 - fx0 * fx0 - lift0 * lift0;
    return room > 0 ? (std::sqrt(slope * slope + square * room) - slope) / square : -1;
  }

  static constexpr double small_rotation = 1e-3;  // in angles of slenderness
};

}  // namespace
}  // namespace freestand::dynamics::FREESTAND_ISA
