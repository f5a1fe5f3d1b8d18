#include "dynamics/spring_sway.hpp"

namespace freestand::dynamics {

void sway(const Rig& rig, const SpringBase& base, const SwayState& at, const Floor<double, sway_order>& floor,
          std::size_t held, bool stands, int sigma, Sway& s) {
  constexpr int N = sway_order;
  const Rotation<double> rotation = rotation_by(at.theta);
  s.x[0] = at.x, s.y[0] = at.y, s.theta[0] = at.theta, s.vx[0] = at.vx, s.vy[0] = at.vy, s.omega[0] = at.omega;
  SwaySeries sine, cosine, omega2, moment, load, inertia;
  std::array<SwaySeries, 2> rx, ry;
  sine[0] = rotation.sine, cosine[0] = rotation.cosine;
  Arc<double, N>& arc = s.arc;
  for (int k = 0; k <= N; ++k) {
    for (const std::size_t i : both_legs) {
      const double c = base.legs[i].offset;
      rx[i][k] = rig.h * sine[k] - c * cosine[k];
      ry[i][k] = c * sine[k] + rig.h * cosine[k];
      s.rise[i][k] = s.y[k] - c * sine[k] - rig.h * (k == 0 ? -rotation.versine : cosine[k]);
    }
    if (k == N) break;
    omega2[k] = product(s.omega, s.omega, k);
    s.total[k] = moment[k] = 0;
    for (const std::size_t i : both_legs) {
      s.push[i][k] = (k == 0 ? base.legs[i].stands_on : 0) - base.stiffness * s.rise[i][k] -
                     base.dashpot * (s.vy[k] + product(rx[i], s.omega, k));
      if (!base.legs[i].on) continue;
      s.total[k] += s.push[i][k];
      moment[k] += product(s.push[i], rx[i], k);
    }
    if (stands) {
      load[k] = floor.a[k] - product(rx[held], omega2, k);
      inertia[k] = product(ry[held], ry[held], k) + (k == 0 ? rig.k2 : 0);
      double numerator = moment[k] - product(ry[held], load, k);
      for (int i = 1; i <= k; ++i) numerator -= inertia[i] * arc.alpha[k - i];
      arc.alpha[k] = numerator / inertia[0];
      arc.fx[k] = load[k] + product(ry[held], arc.alpha, k);
    } else {
      arc.fx[k] = -sigma * rig.mu_k * s.total[k];
      arc.alpha[k] = (moment[k] - product(ry[held], arc.fx, k)) / rig.k2;
    }
    const double over = 1.0 / (k + 1);
    s.x[k + 1] = s.vx[k] * over;
    s.vx[k + 1] = (arc.fx[k] - floor.a[k]) * over;
    s.y[k + 1] = s.vy[k] * over;
    s.vy[k + 1] = (s.total[k] - floor.g[k]) * over;
    s.theta[k + 1] = s.omega[k] * over;
    s.omega[k + 1] = arc.alpha[k] * over;
    sine[k + 1] = product(cosine, s.omega, k) * over;
    cosine[k + 1] = -product(sine, s.omega, k) * over;
  }
  s.total[N] = s.push[0][N] = s.push[1][N] = 0;
  arc.theta = s.theta, arc.omega = s.omega, arc.rx = rx[held], arc.ry = ry[held], arc.fy = s.total;
  for (int k = 0; k <= N; ++k) {
    arc.xi[k] = s.x[k] - arc.rx[k] - (k == 0 ? base.legs[held].offset : 0);
    arc.w[k] = s.vx[k] - product(arc.ry, arc.omega, k);
  }
  finish_arc(arc);
}

}  // namespace freestand::dynamics
