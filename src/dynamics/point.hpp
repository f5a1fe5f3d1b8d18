// A point of the block at a height over the base, above the middle of its width: how it moves beside the centre of mass.
//
//        ____________
//       /     o     /    q from the centre of mass x to the point o, turned clockwise by theta:
//      /      |    /       q_x = across cos(theta) + up sin(theta)       d/dt q_x =  omega q_y
//     /    x--+   /        q_y = up cos(theta) - across sin(theta)       d/dt q_y = -omega q_x
//    /___________/         acceleration = that of the centre of mass + d2/dt2 q
#pragma once

#include <freestand/specimen.hpp>

#include "dynamics/rotation.hpp"
#include "dynamics/series.hpp"

namespace freestand::dynamics {

struct Point {
  double across = 0, up = 0;  // from the centre of mass of the upright block [m]

  double qx(const Rotation<double>& r) const { return across * r.cosine + up * r.sine; }
  double qy(const Rotation<double>& r) const { return up * r.cosine - across * r.sine; }
};

// d2/dt2 q as series of time, of order N - 1; theta and omega: rotation and its rate.
template <int N>
struct PointAcceleration {
  Series<double, N> x, y;  // [m/s2]

  PointAcceleration(const Point& point, double theta, const Series<double, N>& omega) {
    Series<double, N> qx = Series<double, N>::zero(), qy = qx, vx = qx, vy = qx;
    const Rotation<double> rotation = rotation_by(theta);
    qx[0] = point.qx(rotation);
    qy[0] = point.qy(rotation);
    for (int k = 0; k < N; ++k) {
      qx[k + 1] = product(omega, qy, k) / (k + 1);
      qy[k + 1] = -product(omega, qx, k) / (k + 1);
    }
    for (int k = 0; k <= N; ++k) {
      vx[k] = product(omega, qy, k);
      vy[k] = -product(omega, qx, k);
    }
    x = derivative(vx);
    y = derivative(vy);
  }
};

}  // namespace freestand::dynamics
