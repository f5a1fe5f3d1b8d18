// Slip of a block that slides in the plane of a floor which moves in both horizontal directions. Vectors a, w, u in that
// plane: floor acceleration, slip velocity, displacement relative to the floor.
//
//   w' = -a - F e,   e = w/|w|,  F = mu_k g',   u' = w
//
// The direction e turns ever faster as the slip comes to its end: in time the equation is singular there. With
//   ds = dt/v,  v = |w|:     dv/ds = -F v - a.w,   dw/ds = -F w - a v,   dt/ds = v,   du/ds = v w
// it is linear in (v, w), no root and no quotient is left, and its end lies at s = infinity, reached exponentially: series
// in s have no radius to fear, and a step takes off a fixed share of the speed. Three pieces of a slip have forms of their own:
//
//  * the end. While a and F hold still,  d/dt (F v - a.w) = -(F^2 - A^2),  A = |a|, so that a slip with A < F ends after
//    T = (F v - a.w)/(F^2 - A^2); what it covers until then follows from three more such sums (see SlipEnd).
//  * the start, and any slip so slow that its direction follows the drive at once: e = -a/A but for an angle that is slaved to
//    the speed. In time, with axes (1, 2), 1 along -a(0), and the angle theta of e from 1:
//      v' = -F - a.e,   v theta' = a_1 sin(theta) - a_2 cos(theta)
//    whose series has theta_k (k v_1 + A cos(theta_0)) on the left side: no division by v, which may be zero (DrivenSlip).
//  * a floor without friction: polynomials in time.
#pragma once

#include <cmath>

#include "dynamics/series.hpp"

namespace freestand::dynamics {

inline constexpr int plane_order = 10,
                     short_order = 6;   // of series; where a knot is near, the shorter ones are as good
inline constexpr int plane_degree = 5;  // of the floor's polynomials, at most: the square of |a| is searched for roots

struct PlaneVector {
  double x = 0, y = 0;
};
inline double dot(const PlaneVector& p, const PlaneVector& q) { return p.x * q.x + p.y * q.y; }
inline double size(const PlaneVector& p) { return std::sqrt(dot(p, p)); }

// From axes whose x goes along `axis`, a unit vector, to those in which it is given; the same bits where they are the same.
inline PlaneVector turned_back(const PlaneVector& p, const PlaneVector& axis) {
  if (axis.y == 0) return p;
  return {axis.x * p.x - axis.y * p.y, axis.y * p.x + axis.x * p.y};
}

using PlaneSeries = Series<double, plane_order>;

// The floor about the present instant: accelerations, and effective gravity [m/s2]; degree of these polynomials.
struct PlaneFloor {
  PlaneSeries ax, ay, g;
  int degree = 1;
  bool shakes_vertically = false;

  PlaneVector a() const { return {ax[0], ay[0]}; }
};

// A slip about an instant, as series in s, or `in_time`. t: time since that instant.
struct SlipSeries {
  PlaneSeries v, wx, wy, ux, uy, path, t;
  PlaneSeries felt2;  // total acceleration, squared; of elliptic friction only [m2/s4]
  int order = plane_order;
  bool in_time = false;
};

// Series in s, of either order. u: displacement at the instant.
SlipSeries slip_series(const PlaneFloor& floor, double mu_k, const PlaneVector& w, const PlaneVector& u, int order);

// Where s is at time t after the instant, 0 <= t <= t(s_end).
double place_in_series(const SlipSeries& slip, double t, double s_end);

// What is left of a slip with A < F, the floor as it is at this instant.
struct SlipEnd {
  double after_s = 0;    // T
  double path_m = 0;     // length of what it covers
  PlaneVector covers_m;  // and where that leads
};
SlipEnd slip_end(const PlaneVector& a, double F, const PlaneVector& w);

// Series in time of a slip whose direction follows the drive: from rest (w = 0, and A >= F, to within `zero`), or at a speed
// that changes little while the direction settles. False: it does not follow. `turned`: angle between w and the direction
// of the series [rad].
struct DrivenSlip {
  SlipSeries slip;
  double last_angle = 0;  // last coefficient of theta
  double settles = 0;     // the direction does in |w| over this [m/s2]
  double bends =
      0;  // what turning changes of v', over the angle and `settles`; none where friction is the same in all directions
  double turned = 0;
};
bool driven_slip(const PlaneFloor& floor, double mu_k, const PlaneVector& w, const PlaneVector& u, double zero,
                 DrivenSlip& found);

// Series in time of a slip without friction: exact.
SlipSeries free_slip(const PlaneFloor& floor, const PlaneVector& w, const PlaneVector& u);

}  // namespace freestand::dynamics
