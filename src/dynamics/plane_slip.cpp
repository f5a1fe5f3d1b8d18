#include "dynamics/plane_slip.hpp"

#include <algorithm>

#include "dynamics/along_slip.hpp"

namespace freestand::dynamics {
namespace {

constexpr int N = plane_order;

PlaneVector along(const PlaneVector& axis, double x) { return {axis.x * x, axis.y * x}; }

// Terms of a series from rest are kept to those that theta's equation determines.
constexpr int angles = N - 1;

// The equation of theta, coefficient by coefficient; axes as in the header.
struct Follower {
  PlaneSeries a1, a2, F, v, theta, c, s;
  double A = 0;

  // One pass; `before`: theta of the pass before, for the term v_0 (k + 1) theta_(k+1). False: its direction does not follow.
  bool pass(const PlaneSeries& before, double zero) {
    const double sine = -v[0] * before[1] / A;
    if (!(std::abs(sine) < 0.5)) return false;
    theta[0] = std::asin(sine);
    s[0] = sine;
    c[0] = std::sqrt(1 - sine * sine);
    v[1] = -F[0] - a1[0] * c[0] - a2[0] * s[0];
    if (v[0] == 0 && std::abs(v[1]) <= zero) v[1] = 0;
    for (int k = 1; k <= angles; ++k) {
      const double held = k * v[1] + A * c[0];
      if (!(held > 0.5 * A)) return false;
      double known_sine = 0, right = 0;
      for (int j = 1; j < k; ++j) known_sine += j * theta[j] * c[k - j];
      known_sine /= k;
      right = -A * known_sine - v[0] * (k + 1) * (k < angles ? before[k + 1] : 0.0);
      for (int i = 1; i <= k; ++i) right += a1[i] * s[k - i] - a2[i] * c[k - i];
      for (int j = 2; j <= k; ++j) right -= v[j] * (k - j + 1) * theta[k - j + 1];
      theta[k] = right / held;
      s[k] = known_sine + theta[k] * c[0];
      double cosine = 0;
      for (int j = 1; j <= k; ++j) cosine -= j * theta[j] * s[k - j];
      c[k] = cosine / k;
      double push = F[k];
      for (int i = 0; i <= k; ++i) push += a1[i] * c[k - i] + a2[i] * s[k - i];
      v[k + 1] = -push / (k + 1);
    }
    return true;
  }
};

// The first M coefficients; `Shaken`: g' changes with time. Degree: of the floor's polynomials.
template <int M, int Degree, bool Shaken>
void slip_to_order(const PlaneFloor& floor, double mu_k, SlipSeries& y) {
  AlongSlip<Degree> ax(floor.ax, 1), ay(floor.ay, 1);
  AlongSlip<Shaken ? Degree : 0> F(floor.g, mu_k);
  const double still = F.series()[0];
#pragma GCC unroll 16
  for (int k = 0; k < M; ++k) {
    const double one_over = 1.0 / (k + 1);
    const auto held = [&](const PlaneSeries& x) {
      if constexpr (Shaken) return product(F.series(), x, k);
      return still * x[k];
    };
    y.t[k + 1] = y.v[k] * one_over;
    y.ux[k + 1] = product(y.v, y.wx, k) * one_over;
    y.uy[k + 1] = product(y.v, y.wy, k) * one_over;
    y.path[k + 1] = product(y.v, y.v, k) * one_over;
    const double work = product(ax.series(), y.wx, k) + product(ay.series(), y.wy, k);
    const double push_x = product(ax.series(), y.v, k), push_y = product(ay.series(), y.v, k);
    y.wx[k + 1] = -(push_x + held(y.wx)) * one_over;
    y.wy[k + 1] = -(push_y + held(y.wy)) * one_over;
    y.v[k + 1] = -(work + held(y.v)) * one_over;
    ax.advance(y.v, k);
    ay.advance(y.v, k);
    F.advance(y.v, k);
  }
}

template <int M>
void slip_to_order(const PlaneFloor& floor, double mu_k, SlipSeries& y) {
  if (floor.degree > 1)
    return floor.shakes_vertically ? slip_to_order<M, plane_degree, true>(floor, mu_k, y)
                                   : slip_to_order<M, plane_degree, false>(floor, mu_k, y);
  return floor.shakes_vertically ? slip_to_order<M, 1, true>(floor, mu_k, y)
                                 : slip_to_order<M, 1, false>(floor, mu_k, y);
}

}  // namespace

SlipSeries slip_series(const PlaneFloor& floor, double mu_k, const PlaneVector& w, const PlaneVector& u, int order) {
  SlipSeries y;
  y.order = order;
  y.v[0] = size(w);
  y.wx[0] = w.x;
  y.wy[0] = w.y;
  y.ux[0] = u.x;
  y.uy[0] = u.y;
  y.path[0] = y.t[0] = 0;
  if (order == N) {
    slip_to_order<N>(floor, mu_k, y);
    return y;
  }
  slip_to_order<short_order>(floor, mu_k, y);
  for (PlaneSeries* x : {&y.v, &y.wx, &y.wy, &y.ux, &y.uy, &y.path, &y.t})
    for (int k = short_order + 1; k <= N; ++k) (*x)[k] = 0;
  return y;
}

double place_in_series(const SlipSeries& slip, double t, double s_end) {
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

bool driven_slip(const PlaneFloor& floor, double mu_k, const PlaneVector& w, const PlaneVector& u, double zero,
                 DrivenSlip& found) {
  Follower f;
  f.A = size(floor.a());
  if (!(f.A > 0)) return false;
  const PlaneVector one = along(floor.a(), -1 / f.A), two{-one.y, one.x};
  for (int k = 0; k <= N; ++k) {
    f.a1[k] = one.x * floor.ax[k] + one.y * floor.ay[k];
    f.a2[k] = two.x * floor.ax[k] + two.y * floor.ay[k];
    f.F[k] = mu_k * floor.g[k];
  }
  f.a1[0] = -f.A;
  f.a2[0] = 0;
  const double speed = size(w);
  f.v[0] = speed;
  PlaneSeries before = PlaneSeries::zero();
  // Pass by pass one more coefficient of theta is right.
  const int passes = speed == 0 ? 1 : N;
  for (int pass = 0; pass < passes; ++pass) {
    f.theta[N] = f.c[N] = f.s[N] = 0;
    if (!f.pass(before, zero)) return false;
    before = f.theta;
  }
  SlipSeries& y = found.slip;
  y.in_time = true;
  y.v = f.v;
  y.t = PlaneSeries::zero();
  y.t[1] = 1;
  y.ux[0] = u.x;
  y.uy[0] = u.y;
  y.path[0] = 0;
  for (int k = 0; k <= N; ++k) {
    const double w1 = product(f.v, f.c, k), w2 = product(f.v, f.s, k);
    y.wx[k] = one.x * w1 + two.x * w2;
    y.wy[k] = one.y * w1 + two.y * w2;
    if (k == N) break;
    y.ux[k + 1] = y.wx[k] / (k + 1);
    y.uy[k + 1] = y.wy[k] / (k + 1);
    y.path[k + 1] = f.v[k] / (k + 1);
  }
  found.last_angle = f.theta[angles];
  found.settles = f.A;
  found.turned = speed == 0 ? 0.0 : std::atan2(dot(two, w), dot(one, w)) - f.theta[0];
  return true;
}

SlipSeries free_slip(const PlaneFloor& floor, const PlaneVector& w, const PlaneVector& u) {
  SlipSeries y;
  y.wx[0] = w.x;
  y.wy[0] = w.y;
  y.ux[0] = u.x;
  y.uy[0] = u.y;
  for (int k = 0; k < N; ++k) {
    y.wx[k + 1] = -floor.ax[k] / (k + 1);
    y.wy[k + 1] = -floor.ay[k] / (k + 1);
    y.ux[k + 1] = y.wx[k] / (k + 1);
    y.uy[k + 1] = y.wy[k] / (k + 1);
  }
  y.in_time = true;
  y.t = y.v = y.path = PlaneSeries::zero();
  y.t[1] = 1;
  return y;
}

}  // namespace freestand::dynamics
