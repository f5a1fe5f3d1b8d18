#include "dynamics/plane_ellipse.hpp"

#include <algorithm>

#include "base/units.hpp"
#include "dynamics/along_slip.hpp"

namespace freestand::dynamics {
namespace {

constexpr int N = plane_order;

// Coefficient k of the root of y, whose coefficients before it are known.
double root_term(const PlaneSeries& y, const PlaneSeries& root, int k) {
  if (k == 0) return std::sqrt(y[0]);
  double rest = y[k];
  for (int j = 1; j < k; ++j) rest -= root[j] * root[k - j];
  return 0.5 * rest / root[0];
}

// The rate at which a slip in a steady direction grows: where e_i = -A_i/(rate + F m_i) has length 1. False: it has no such direction. The
// sum of squares falls with the rate and bends upwards, so that Newton's rule comes from below.
bool steady_rate(const PlaneVector& A, double F, double m, double& rate) {
  rate = std::fmax(std::abs(A.x) - F, std::abs(A.y) - m * F);
  if (!(rate > -F * std::fmin(1.0, m))) return false;
  for (int turn = 0; turn < 60; ++turn) {
    const double x = rate + F, y = rate + m * F, ex = A.x / x, ey = A.y / y;
    const double step = (ex * ex + ey * ey - 1) / (2 * (ex * ex / x + ey * ey / y));
    rate += step;
    if (!(step > 1e-16 * (std::abs(rate) + F))) break;
  }
  return std::isfinite(rate);
}

// The equation of theta, coefficient by coefficient.
struct Follower {
  PlaneSeries ax, ay, F, v, theta, c, s, sc;
  double m = 1;
  double settles = 0;  // -dG/dtheta

  // One pass, as that of the isotropic slip. False: its direction does not follow.
  bool pass(const PlaneSeries& before, double zero) {
    const double bend = m - 1;
    for (int turn = 0; v[0] > 0 && turn < 20; ++turn) {
      const double sine = std::sin(theta[0]), cosine = std::cos(theta[0]);
      const double missed = ax[0] * sine - ay[0] * cosine - F[0] * bend * sine * cosine - v[0] * before[1];
      const double slope = ax[0] * cosine + ay[0] * sine - F[0] * bend * (cosine - sine) * (cosine + sine);
      const double step = missed / slope;
      if (!(std::abs(step) < 0.5)) return false;
      theta[0] -= step;
      if (std::abs(step) < 1e-15) break;
    }
    c[0] = std::cos(theta[0]);
    s[0] = std::sin(theta[0]);
    sc[0] = s[0] * c[0];
    const double turned = (c[0] - s[0]) * (c[0] + s[0]);
    settles = -(ax[0] * c[0] + ay[0] * s[0] - F[0] * bend * turned);
    v[1] = -(ax[0] * c[0] + ay[0] * s[0] + F[0] * (1 + bend * s[0] * s[0]));
    if (v[0] == 0 && std::abs(v[1]) <= zero) v[1] = 0;
    for (int k = 1; k < N; ++k) {
      const double held = k * v[1] + settles;
      if (!(settles > 0) || !(held > 0.5 * settles)) return false;
      double sine = 0, cosine = 0;  // but for what theta_k adds
      for (int j = 1; j < k; ++j) sine += j * theta[j] * c[k - j], cosine -= j * theta[j] * s[k - j];
      s[k] = sine / k;
      c[k] = cosine / k;
      sc[k] = product(s, c, k);
      double right = product(ax, s, k) - product(ay, c, k) - bend * product(F, sc, k);
      right -= v[0] * (k + 1) * (k < N - 1 ? before[k + 1] : 0.0);
      for (int j = 2; j <= k; ++j) right -= v[j] * (k - j + 1) * theta[k - j + 1];
      theta[k] = right / held;
      s[k] += theta[k] * c[0];
      c[k] -= theta[k] * s[0];
      sc[k] += theta[k] * turned;
      PlaneSeries hard = PlaneSeries::zero();
      for (int j = 0; j <= k; ++j) hard[j] = (j == 0 ? 1 : 0) + bend * product(s, s, j);
      v[k + 1] = -(product(ax, c, k) + product(ay, s, k) + product(F, hard, k)) / (k + 1);
    }
    theta[N] = c[N] = s[N] = 0;
    return true;
  }
};

}  // namespace

SlipSeries elliptic_slip(const PlaneFloor& floor, const EllipticGrip& grip, const PlaneVector& w, const PlaneVector& u,
                         double weight) {
  const double r = grip.ratio, m = r * r;
  AlongSlip<plane_degree> ax(floor.ax, 1), ay(floor.ay, r), F(floor.g, grip.mu), g(floor.g, 1);
  SlipSeries y;
  y.order = N;
  y.v[0] = grip.speed(w);
  y.ux[0] = u.x, y.uy[0] = u.y;
  y.path[0] = y.t[0] = 0;
  PlaneSeries qx, qy, ex, ey, hard, square, size, fx = PlaneSeries::zero(), fy = fx, lift;
  qx[0] = w.x, qy[0] = r * w.y;
  for (int k = 0; k <= N; ++k) {
    ex[k] = qx[k], ey[k] = qy[k];
    for (int j = 1; j <= k; ++j) ex[k] -= y.v[j] * ex[k - j], ey[k] -= y.v[j] * ey[k - j];
    ex[k] /= y.v[0], ey[k] /= y.v[0];
    fx[k] = product(F.series(), ex, k);
    fy[k] = r * product(F.series(), ey, k);
    lift[k] = g.series()[k] - (k == 0 ? weight : 0.0);
    y.felt2[k] = product(fx, fx, k) + product(fy, fy, k) + product(lift, lift, k);
    y.wx[k] = qx[k], y.wy[k] = qy[k] / r;
    if (k == N) break;
    const double one_over = 1.0 / (k + 1);
    hard[k] = product(qx, ex, k) + m * product(qy, ey, k);
    square[k] = product(y.wx, y.wx, k) + product(y.wy, y.wy, k);
    size[k] = root_term(square, size, k);
    y.t[k + 1] = y.v[k] * one_over;
    y.ux[k + 1] = product(y.v, y.wx, k) * one_over;
    y.uy[k + 1] = product(y.v, y.wy, k) * one_over;
    y.path[k + 1] = product(y.v, size, k) * one_over;
    y.v[k + 1] = -(product(ax.series(), qx, k) + product(ay.series(), qy, k) + product(F.series(), hard, k)) * one_over;
    qx[k + 1] = -(product(ax.series(), y.v, k) + product(F.series(), qx, k)) * one_over;
    qy[k + 1] = -(product(ay.series(), y.v, k) + m * product(F.series(), qy, k)) * one_over;
    ax.advance(y.v, k);
    ay.advance(y.v, k);
    F.advance(y.v, k);
    g.advance(y.v, k);
  }
  return y;
}

bool elliptic_driven_slip(const PlaneFloor& floor, const EllipticGrip& grip, const PlaneVector& w, const PlaneVector& u,
                          double weight, double zero, DrivenSlip& found) {
  const double r = grip.ratio;
  Follower f;
  f.m = r * r;
  for (int k = 0; k <= N; ++k) f.ax[k] = floor.ax[k], f.ay[k] = r * floor.ay[k], f.F[k] = grip.mu * floor.g[k];
  double rate = 0;
  if (!steady_rate({f.ax[0], f.ay[0]}, f.F[0], f.m, rate)) return false;
  f.theta[0] = std::atan2(-f.ay[0] / (rate + f.m * f.F[0]), -f.ax[0] / (rate + f.F[0]));
  f.v[0] = grip.speed(w);
  PlaneSeries before = PlaneSeries::zero();
  const int passes = f.v[0] == 0 ? 1 : N;
  for (int pass = 0; pass < passes; ++pass) {
    if (!f.pass(before, zero)) return false;
    before = f.theta;
  }
  SlipSeries& y = found.slip;
  y.in_time = true;
  y.order = N;
  y.v = f.v;
  y.t = PlaneSeries::zero();
  y.t[1] = 1;
  y.ux[0] = u.x, y.uy[0] = u.y;
  y.path[0] = 0;
  PlaneSeries square, size, fx = PlaneSeries::zero(), fy = fx, lift = floor.g;
  lift[0] -= weight;
  for (int k = 0; k <= N; ++k) {
    y.wx[k] = product(f.v, f.c, k);
    y.wy[k] = product(f.v, f.s, k) / r;
    square[k] = product(f.c, f.c, k) + product(f.s, f.s, k) / f.m;
    size[k] = root_term(square, size, k);
    fx[k] = product(f.F, f.c, k);
    fy[k] = r * product(f.F, f.s, k);
    y.felt2[k] = product(fx, fx, k) + product(fy, fy, k) + product(lift, lift, k);
    if (k == N) break;
    y.ux[k + 1] = y.wx[k] / (k + 1);
    y.uy[k + 1] = y.wy[k] / (k + 1);
    y.path[k + 1] = product(f.v, size, k) / (k + 1);
  }
  found.last_angle = f.theta[N - 1];
  found.settles = f.settles;
  found.bends = std::abs(f.F[0] * (f.m - 1) * f.sc[0]) / f.settles;
  found.turned = f.v[0] == 0 ? 0.0 : std::remainder(std::atan2(r * w.y, w.x) - f.theta[0], 2 * pi);
  return true;
}

// q (1 + P m_i/|q|) = q before: the length of q is the root of a sum of squares that falls with it.
PlaneVector slip_after_push(const EllipticGrip& grip, const PlaneVector& w, double push) {
  const double P = grip.mu * push, m = grip.ratio * grip.ratio;
  const PlaneVector q = grip.scaled(w);
  const auto shares = [&](double length) { return PlaneVector{q.x / (length + P), q.y / (length + m * P)}; };
  if (dot(shares(0), shares(0)) <= 1) return {};
  double low = 0, high = size(q);
  for (int half = 0; half < 200 && high > low; ++half) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (dot(shares(middle), shares(middle)) > 1 ? low : high) = middle;
  }
  const PlaneVector e = shares(high);
  return {high * e.x, high * e.y / grip.ratio};
}

double slows(const PlaneFloor& floor, const EllipticGrip& grip, const PlaneVector& w) {
  const PlaneVector q = grip.scaled(w), A = grip.scaled(floor.a());
  return dot(A, q) + grip.mu * floor.g[0] * (q.x * q.x + grip.ratio * grip.ratio * q.y * q.y) / size(q);
}

}  // namespace freestand::dynamics
