#include "dynamics/plane_slip.hpp"

#include <algorithm>
namespace freestand::dynamics {
namespace {

constexpr int N = driven_order;
constexpr int angles = N - 1;  // terms of a series from rest are kept to those that theta's equation determines
using DrivenSeries = Series<double, N>;
constexpr double over[] = {0, 1, 1.0 / 2, 1.0 / 3, 1.0 / 4, 1.0 / 5, 1.0 / 6, 1.0 / 7};
static_assert(sizeof over / sizeof over[0] == N + 1);

PlaneVector along(const PlaneVector& axis, double x) { return {axis.x * x, axis.y * x}; }

// Coefficient k of (y0 + y1 tau) x.
double times_linear(double y0, double y1, const DrivenSeries& x, int k) {
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
  DrivenSeries v, theta, c, s, sc, ss;  // cosine and sine of theta; theta_0 from the direction of the first pass
  double settles = 0;                   // -dG/dtheta

  // One pass; `before`: theta of the pass before, for the term v_0 (k + 1) theta_(k+1). False: its direction does not follow.
  bool pass(const DrivenSeries& before, double zero) {
    const double anisotropy = m - 1;
    for (int turn = 0; v[0] > 0 && turn < 20; ++turn) {
      const double missed = A.x * s[0] - A.y * c[0] - F * anisotropy * s[0] * c[0] - v[0] * before[1];
      const double slope = A.x * c[0] + A.y * s[0] - F * anisotropy * (c[0] - s[0]) * (c[0] + s[0]);
      const double step = missed / slope;
      if (!(std::abs(step) < 0.5)) return false;
      theta[0] -= step;
      const double turned = 1 / std::sqrt(1 + step * step), cosine = c[0];
      c[0] = (c[0] + step * s[0]) * turned;
      s[0] = (s[0] - step * cosine) * turned;
      if (std::abs(step) < 1e-8) break;  // and Newton's rule squares what is missing
    }
    sc[0] = s[0] * c[0];
    ss[0] = s[0] * s[0];
    const double turned = (c[0] - s[0]) * (c[0] + s[0]);
    settles = -(A.x * c[0] + A.y * s[0] - F * anisotropy * turned);
    v[1] = -(A.x * c[0] + A.y * s[0] + F * (1 + anisotropy * ss[0]));
    if (v[0] == 0 && std::abs(v[1]) <= zero) v[1] = 0;
    if (!(settles > 0) || !(angles * v[1] > -0.5 * settles)) return false;
    for (int k = 1; k <= angles; ++k) {
      const double held = k * v[1] + settles;
      double sine = 0, cosine = 0;  // but for what theta_k adds
      for (int j = 1; j < k; ++j) sine += j * theta[j] * c[k - j], cosine -= j * theta[j] * s[k - j];
      s[k] = sine * over[k];
      c[k] = cosine * over[k];
      double right = times_linear(A.x, B.x, s, k) - times_linear(A.y, B.y, c, k);
      if (anisotropy != 0) {
        sc[k] = product(s, c, k);
        right -= anisotropy * times_linear(F, dF, sc, k);
      }
      right -= v[0] * (k + 1) * (k < angles ? before[k + 1] : 0.0);
      for (int j = 2; j <= k; ++j) right -= v[j] * (k - j + 1) * theta[k - j + 1];
      theta[k] = right / held;
      s[k] += theta[k] * c[0];
      c[k] -= theta[k] * s[0];
      double rubs = k == 1 ? dF : 0.0;
      if (anisotropy != 0) {
        sc[k] += theta[k] * turned;
        ss[k] = product(s, s, k);
        rubs += anisotropy * times_linear(F, dF, ss, k);
      }
      v[k + 1] = -(times_linear(A.x, B.x, c, k) + times_linear(A.y, B.y, s, k) + rubs) * over[k + 1];
    }
    theta[N] = c[N] = s[N] = ss[N] = 0;
    return true;
  }
};

// Pass by pass theta changes less, while its direction settles fast against its changes. False: it does not.
bool settle(Follower& f, double zero, double h, double allowed) {
  DrivenSeries before = DrivenSeries::zero();
  for (int pass = 0; pass < N; ++pass) {
    if (!f.pass(before, zero)) return false;
    double change = 0;
    for (int k = N; k >= 0; --k) change = change * h + std::abs(f.theta[k] - before[k]);
    if (f.v[0] * change <= allowed) return true;
    before = f.theta;
  }
  return false;
}

// |w| = v (c^2 + s^2/r^2)^(1/2), and friction F (c, r s).
void expand(const Follower& f, const EllipticGrip& grip, const PlaneFloor& floor, const PlaneVector& q,
            const PlaneVector& u, double weight, DrivenSlip& found) {
  SlipSeries<double>& y = found.slip;
  for (PlaneSeries* x : {&y.v, &y.wx, &y.wy, &y.ux, &y.uy, &y.path, &y.t, &y.felt2}) *x = PlaneSeries::zero();
  y.in_time = true;
  y.t[1] = 1;
  y.ux[0] = u.x, y.uy[0] = u.y;
  DrivenSeries length = DrivenSeries::zero();
  length[0] = 1;
  if (f.m != 1) {
    const double lift = floor.g - weight, F2[3] = {f.F * f.F, 2 * f.F * f.dF, f.dF * f.dF};
    const double lift2[3] = {lift * lift, 2 * lift * floor.dg, floor.dg * floor.dg};
    for (int k = 0; k <= N; ++k) {
      double felt2 = k < 3 ? F2[k] + lift2[k] : 0.0, rest = (k == 0 ? 1 : 0) + (1 / f.m - 1) * f.ss[k];
      for (int j = 0; j < 3 && j <= k; ++j) felt2 += (f.m - 1) * F2[j] * f.ss[k - j];
      for (int j = 1; j < k; ++j) rest -= length[j] * length[k - j];
      length[k] = k == 0 ? std::sqrt(rest) : 0.5 * rest / length[0];
      y.felt2[k] = felt2;
    }
  }
  for (int k = 0; k <= N; ++k) {
    y.v[k] = f.v[k];
    y.wx[k] = product(f.v, f.c, k);
    y.wy[k] = product(f.v, f.s, k) / grip.ratio;
    if (k == N) break;
    y.ux[k + 1] = y.wx[k] * over[k + 1];
    y.uy[k + 1] = y.wy[k] * over[k + 1];
    y.path[k + 1] = (f.m != 1 ? product(f.v, length, k) : f.v[k]) * over[k + 1];
  }
  found.last_angle = f.theta[angles];
  found.settles = f.settles;
  found.bends = std::abs(f.F * (f.m - 1) * f.sc[0]) / f.settles;
  const double ahead = f.c[0] * q.x + f.s[0] * q.y, aside = f.c[0] * q.y - f.s[0] * q.x;
  found.turned = aside == 0 && ahead >= 0 ? 0.0 : ahead > 0 ? std::abs(aside) / ahead : 4.0;
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
  const PlaneVector steady{-f.A.x / (rate + f.F), -f.A.y / (rate + f.m * f.F)};
  f.theta[0] = 0;
  f.c[0] = steady.x, f.s[0] = steady.y;
  f.v[0] = speed;
  if (!settle(f, zero, h, allowed)) return false;
  expand(f, grip, floor, w.x == 0 && w.y == 0 ? PlaneVector{} : grip.scaled(w), u, weight, found);
  return found.turned < 1;
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
