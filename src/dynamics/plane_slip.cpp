#include "dynamics/plane_slip.hpp"

#include <algorithm>

#include "base/units.hpp"

namespace freestand::dynamics {
namespace {

constexpr int N = plane_order;
constexpr int angles = N - 1;  // terms of a series from rest are kept to those that theta's equation determines

PlaneVector along(const PlaneVector& axis, double x) { return {axis.x * x, axis.y * x}; }

// Coefficient k of (y0 + y1 tau) x.
double times_linear(double y0, double y1, const PlaneSeries& x, int k) {
  return k == 0 ? y0 * x[0] : y0 * x[k] + y1 * x[k - 1];
}

// The rate at which a slip in a steady direction grows: where e_i = -A_i/(rate + F m_i) has length 1. False: it has no such direction. The
// sum of squares falls with the rate and bends upwards, so that Newton's rule comes from below.
bool steady_rate(const PlaneVector& A, double F, double m, double& rate) {
  rate = m == 1 ? size(A) - F : std::fmax(std::abs(A.x) - F, std::abs(A.y) - m * F);
  if (!(rate > -F * std::fmin(1.0, m))) return false;
  for (int turn = 0; m != 1 && turn < 60; ++turn) {
    const double x = rate + F, y = rate + m * F, ex = A.x / x, ey = A.y / y;
    const double step = (ex * ex + ey * ey - 1) / (2 * (ex * ex / x + ey * ey / y));
    rate += step;
    if (!(step > 1e-16 * (std::abs(rate) + F))) break;
  }
  return std::isfinite(rate);
}

// The equation of theta, coefficient by coefficient.
struct Follower {
  PlaneVector A, B;  // the drive, and its rate
  double F = 0, dF = 0, m = 1;
  PlaneSeries v, theta, c, s, sc, ss;
  double settles = 0;  // -dG/dtheta

  // One pass; `before`: theta of the pass before, for the term v_0 (k + 1) theta_(k+1). False: its direction does not follow.
  bool pass(const PlaneSeries& before, double zero) {
    const double bend = m - 1;
    for (int turn = 0; v[0] > 0 && turn < 20; ++turn) {
      const double sine = std::sin(theta[0]), cosine = std::cos(theta[0]);
      const double missed = A.x * sine - A.y * cosine - F * bend * sine * cosine - v[0] * before[1];
      const double slope = A.x * cosine + A.y * sine - F * bend * (cosine - sine) * (cosine + sine);
      const double step = missed / slope;
      if (!(std::abs(step) < 0.5)) return false;
      theta[0] -= step;
      if (std::abs(step) < 1e-8) break;  // and Newton's rule squares what is missing
    }
    c[0] = std::cos(theta[0]);
    s[0] = std::sin(theta[0]);
    sc[0] = s[0] * c[0];
    ss[0] = s[0] * s[0];
    const double turned = (c[0] - s[0]) * (c[0] + s[0]);
    settles = -(A.x * c[0] + A.y * s[0] - F * bend * turned);
    v[1] = -(A.x * c[0] + A.y * s[0] + F * (1 + bend * ss[0]));
    if (v[0] == 0 && std::abs(v[1]) <= zero) v[1] = 0;
    for (int k = 1; k <= angles; ++k) {
      const double held = k * v[1] + settles;
      if (!(settles > 0) || !(held > 0.5 * settles)) return false;
      double sine = 0, cosine = 0;  // but for what theta_k adds
      for (int j = 1; j < k; ++j) sine += j * theta[j] * c[k - j], cosine -= j * theta[j] * s[k - j];
      s[k] = sine / k;
      c[k] = cosine / k;
      double right = times_linear(A.x, B.x, s, k) - times_linear(A.y, B.y, c, k);
      if (bend != 0) {
        sc[k] = product(s, c, k);
        right -= bend * times_linear(F, dF, sc, k);
      }
      right -= v[0] * (k + 1) * (k < angles ? before[k + 1] : 0.0);
      for (int j = 2; j <= k; ++j) right -= v[j] * (k - j + 1) * theta[k - j + 1];
      theta[k] = right / held;
      s[k] += theta[k] * c[0];
      c[k] -= theta[k] * s[0];
      double rubs = k == 1 ? dF : 0.0;
      if (bend != 0) {
        sc[k] += theta[k] * turned;
        ss[k] = product(s, s, k);
        rubs += bend * times_linear(F, dF, ss, k);
      }
      v[k + 1] = -(times_linear(A.x, B.x, c, k) + times_linear(A.y, B.y, s, k) + rubs) / (k + 1);
    }
    theta[N] = c[N] = s[N] = ss[N] = 0;
    return true;
  }
};

// Pass by pass one more coefficient of theta is right, and those before it hardly change.
bool settle(Follower& f, double zero, double h, double allowed) {
  PlaneSeries before = PlaneSeries::zero();
  for (int pass = 0; pass < N; ++pass) {
    if (!f.pass(before, zero)) return false;
    double change = 0;
    for (int k = N; k >= 0; --k) change = change * h + std::abs(f.theta[k] - before[k]);
    if (f.v[0] * change <= allowed) return true;
    before = f.theta;
  }
  return true;
}

}  // namespace

double place_in_series(const SlipSeries<double>& slip, double t, double s_end) {
  double low = 0, high = s_end, s = std::fmin(t / slip.v[0], s_end);
  for (int turn = 0; turn < 60 && high > low; ++turn) {
    const double miss = slip.t.at(s) - t;
    (miss > 0 ? high : low) = s;
    const double next = s - miss / slip.v.at(s);
    const double taken = next >= low && next <= high ? next : 0.5 * (low + high);
    if (std::abs(taken - s) <= 1e-8 * s) return taken;  // and Newton's rule squares what is missing
    s = taken;
  }
  return s;
}

// With A and F constant, P = integral of v, and x, z, q those of a.w/A, n.w and (a.w)^2/(A^2 v), n across a:
//   v^2 = 2 F P + 2 A x,   v (a.w)/A = 2 F x + A q + A P,   (a.w)^2/A^2 = 2 A x + 2 F q,
//   v (n.w) = 2 F z + r,   (a.w)(n.w)/A = A z + 2 F r/A.
SlipEnd slip_end(const PlaneVector& a, double F, const PlaneVector& w) {
  const double A = size(a), v = size(w);
  const PlaneVector ahead = A > 0 ? along(a, 1 / A) : PlaneVector{1, 0}, aside{-ahead.y, ahead.x};
  const double b = dot(ahead, w), m = dot(aside, w), left = (F - A) * (F + A);
  const double x = (2 * F * v * b - A * (b * b + v * v)) / (4 * left);
  const double z = (2 * F * v * m - A * b * m) / (4 * F * F - A * A);
  return {
      (F * v - A * b) / left, (v * v - 2 * A * x) / (2 * F), {ahead.x * x + aside.x * z, ahead.y * x + aside.y * z}};
}

bool driven_slip(const PlaneFloor& floor, const EllipticGrip& grip, const PlaneVector& w, const PlaneVector& u,
                 double weight, double zero, double h, double allowed, DrivenSlip& found) {
  const double r = grip.ratio, speed = size(grip.scaled(w));
  Follower f;
  f.m = r * r;
  f.A = grip.scaled(floor.a);
  f.B = grip.scaled(floor.da);
  f.F = grip.mu * floor.g;
  f.dF = grip.mu * floor.dg;
  double rate = 0;
  if (!(size(f.A) > 0) || !steady_rate(f.A, f.F, f.m, rate)) return false;
  f.theta[0] = std::atan2(-f.A.y / (rate + f.m * f.F), -f.A.x / (rate + f.F));
  f.v[0] = speed;
  if (!settle(f, zero, h, allowed)) return false;
  SlipSeries<double>& y = found.slip;
  y.in_time = true;
  y.v = f.v;
  y.t = PlaneSeries::zero();
  y.t[1] = 1;
  y.ux[0] = u.x, y.uy[0] = u.y;
  y.path[0] = 0;
  // |w| = v (c^2 + s^2/r^2)^(1/2), and friction F (c, r s).
  PlaneSeries square, length, F2 = PlaneSeries::zero();
  F2[0] = f.F * f.F, F2[1] = 2 * f.F * f.dF, F2[2] = f.dF * f.dF;
  const double lift = floor.g - weight;
  for (int k = 0; k <= N; ++k) {
    y.wx[k] = product(f.v, f.c, k);
    y.wy[k] = product(f.v, f.s, k) / r;
    y.felt2[k] = F2[k] + (k == 0   ? lift * lift
                          : k == 1 ? 2 * lift * floor.dg
                          : k == 2 ? floor.dg * floor.dg
                                   : 0.0);
    length[k] = k == 0 ? 1 : 0;
    if (f.m != 1) {
      y.felt2[k] += (f.m - 1) * (F2[0] * f.ss[k] + (k > 0 ? F2[1] * f.ss[k - 1] : 0) + (k > 1 ? F2[2] * f.ss[k - 2] : 0));
      double rest = square[k] = (k == 0 ? 1 : 0) + (1 / f.m - 1) * f.ss[k];
      for (int j = 1; j < k; ++j) rest -= length[j] * length[k - j];
      length[k] = k == 0 ? std::sqrt(rest) : 0.5 * rest / length[0];
    }
    if (k == N) break;
    y.ux[k + 1] = y.wx[k] / (k + 1);
    y.uy[k + 1] = y.wy[k] / (k + 1);
    y.path[k + 1] = (f.m != 1 ? product(f.v, length, k) : f.v[k]) / (k + 1);
  }
  found.last_angle = f.theta[angles];
  found.settles = f.settles;
  found.bends = std::abs(f.F * (f.m - 1) * f.sc[0]) / f.settles;
  found.turned = speed == 0 ? 0.0 : std::remainder(std::atan2(r * w.y, w.x) - f.theta[0], 2 * pi);
  return true;
}

SlipSeries<double> free_slip(const PlaneFloor& floor, const PlaneVector& w, const PlaneVector& u) {
  SlipSeries<double> y;
  for (PlaneSeries* x : {&y.v, &y.wx, &y.wy, &y.ux, &y.uy, &y.path, &y.t}) *x = PlaneSeries::zero();
  y.wx[0] = w.x, y.wx[1] = -floor.a.x, y.wx[2] = -0.5 * floor.da.x;
  y.wy[0] = w.y, y.wy[1] = -floor.a.y, y.wy[2] = -0.5 * floor.da.y;
  y.ux[0] = u.x, y.uy[0] = u.y;
  for (int k = 0; k < 3; ++k) {
    y.ux[k + 1] = y.wx[k] / (k + 1);
    y.uy[k + 1] = y.wy[k] / (k + 1);
  }
  y.in_time = true;
  y.t[1] = 1;
  return y;
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
  const PlaneVector q = grip.scaled(w), A = grip.scaled(floor.a);
  return dot(A, q) + grip.mu * floor.g * (q.x * q.x + grip.ratio * grip.ratio * q.y * q.y) / size(q);
}

}  // namespace freestand::dynamics
