// The peers on model bouc_wen, gamma = beta = 1/2:  u'' = -a - mu g z,  z' = u' (1 - [u' z > 0] |z|^n)/u_y.
//
// Steps end at the knots of the record and where the velocity changes its sign, for there the right-hand side has a kink.
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>
#include <stdexcept>

#include "peers.hpp"

namespace freestand::bench {
namespace {

using X = std::array<double, 3>;  // u, u', z
using Dopri5 = boost::numeric::odeint::runge_kutta_dopri5<X, double, X, double, boost::numeric::odeint::array_algebra>;

constexpr int ring_knots = 200;  // looked at after the record: the block rings about where it stands

struct Contact {
  explicit Contact(const Specimen& s)
      : yield(s.bouc_wen.yield_displacement_m),
        n(s.bouc_wen.exponent),
        strength(s.friction.mu_k * standard_gravity_mps2),
        rate(std::sqrt(strength / yield)),
        whole(n == std::floor(n) && n < 100 ? static_cast<int>(n) : 0) {}
  double yield, n, strength, rate;
  int whole;  // n, if it is one

  double power(double z) const {
    if (!whole) return std::pow(z, n);
    double result = 1, square = z;
    for (int k = whole; k; k >>= 1, square *= square)
      if (k & 1) result *= square;
    return result;
  }
  void operator()(const double* x, double* dx, double a) const {
    dx[0] = x[1];
    dx[1] = -a - strength * x[2];
    dx[2] = x[1] * (x[1] * x[2] > 0 ? 1 - power(std::fabs(x[2])) : 1.0) / yield;
  }
  // A hair's breadth past the turn, in the direction in which it goes on.
  double after_turn(const double* x, double a) const { return (-a - strength * x[2]) * 1e-12; }
};

class OdeintBoucWen {
 public:
  OdeintBoucWen(const Specimen& specimen, const Shaking& shaking) : contact_(specimen), record_(shaking) {}

  double peak() {
    for (knot_ = 0; knot_ < record_.count + ring_knots; ++knot_) interval();
    return std::max(peak_, std::fabs(x_[0]));
  }

 private:
  static constexpr double tolerance = 1e-7;

  void interval() {
    const auto rates = [this](const X& x, X& dx, double t) { contact_(x.data(), dx.data(), acceleration(t)); };
    X next{}, dx{}, dnext{}, error{};
    double t = 0;
    rates(x_, dx, t);
    while (t < record_.dt) {
      const double h = std::min(step_, record_.dt - t);
      const bool last = h >= record_.dt - t;
      stepper_.do_step(rates, x_, dx, t, next, dnext, h, error);
      const double size = std::max({std::fabs(error[0]) / contact_.yield,
                                    std::fabs(error[1]) / (contact_.rate * contact_.yield), std::fabs(error[2])}) /
                          tolerance;
      if (size > 1) {
        step_ = h * std::max(0.2, 0.9 * std::pow(size, -0.25));
        continue;
      }
      if (x_[1] * next[1] < 0) {
        const double when = turn(dx, next, dnext, t, h);
        stepper_.calc_state(t + when, x_, X(x_), dx, t, next, dnext, t + h);
        peak_ = std::max(peak_, std::fabs(x_[0]));
        t += when;
        x_[1] = contact_.after_turn(x_.data(), acceleration(t));
        rates(x_, dx, t);
        continue;
      }
      x_ = next;
      dx = dnext;
      t = last ? record_.dt : t + h;
      step_ = std::min(record_.dt, h * std::min(5.0, 0.9 * std::pow(std::max(size, 1e-10), -0.2)));
    }
  }
  double acceleration(double t) const { return record_.at(knot_) + record_.slope(knot_) * t; }

  // When within the step the velocity is zero (Illinois method).
  double turn(const X& dx, const X& next, const X& dnext, double t, double h) {
    double lo = 0, hi = h, f_lo = x_[1], f_hi = next[1];
    int side = 0;
    for (int i = 0; i < 60 && hi - lo > 1e-13; ++i) {
      double middle = hi - f_hi * (hi - lo) / (f_hi - f_lo);
      if (!(middle > lo && middle < hi)) middle = 0.5 * (lo + hi);
      X y;
      stepper_.calc_state(t + middle, y, x_, dx, t, next, dnext, t + h);
      if (y[1] == 0) return middle;
      if (y[1] * f_lo > 0) {
        lo = middle;
        f_lo = y[1];
        if (side == 1) f_hi *= 0.5;
        side = 1;
      } else {
        hi = middle;
        f_hi = y[1];
        if (side == -1) f_lo *= 0.5;
        side = -1;
      }
    }
    return hi;
  }

  Contact contact_;
  PeerRecord record_;
  Dopri5 stepper_;
  X x_{};
  double step_ = 1e-4, peak_ = 0;
  int knot_ = 0;
};

void check(int flag) {
  if (flag < 0) throw std::runtime_error("CVODE failed");
}

struct CvodeRun {
  Contact contact;
  PeerRecord record;
  int knot = 0;
  double acceleration(double t) const { return record.at(knot) + record.slope(knot) * (t - knot * record.dt); }
};

int cvode_rates(double t, N_Vector y, N_Vector dy, void* user) {
  const CvodeRun& run = *static_cast<CvodeRun*>(user);
  run.contact(N_VGetArrayPointer(y), N_VGetArrayPointer(dy), run.acceleration(t));
  return 0;
}

int cvode_velocity(double, N_Vector y, double* g, void*) {
  g[0] = N_VGetArrayPointer(y)[1];
  return 0;
}

}  // namespace

PeerResponse odeint_bouc_wen(const Specimen& specimen, const Shaking& shaking) {
  PeerResponse response;
  response.slip_m = OdeintBoucWen(specimen, shaking).peak();
  return response;
}

PeerResponse cvode_bouc_wen(const Specimen& specimen, const Shaking& shaking) {
  CvodeRun run{Contact(specimen), PeerRecord(shaking)};
  // Slipping on so short a contact is stiff.
  const bool stiff = specimen.bouc_wen.yield_displacement_m < 1e-5;
  const double tolerance = stiff ? 1e-6 : 1e-8;
  SUNContext context = nullptr;
  check(SUNContext_Create(nullptr, &context));
  N_Vector y = N_VNew_Serial(3, context), scale = N_VNew_Serial(3, context);
  double *x = N_VGetArrayPointer(y), *tolerances = N_VGetArrayPointer(scale);
  std::fill(x, x + 3, 0.0);
  tolerances[0] = tolerance * run.contact.yield;
  tolerances[1] = tolerances[0] * run.contact.rate;
  tolerances[2] = tolerance;
  void* cvode = CVodeCreate(stiff ? CV_BDF : CV_ADAMS, context);
  check(CVodeInit(cvode, cvode_rates, 0, y));
  check(CVodeSVtolerances(cvode, tolerance, scale));
  check(CVodeSetUserData(cvode, &run));
  SUNNonlinearSolver fixed_point = stiff ? nullptr : SUNNonlinSol_FixedPoint(y, 0, context);
  SUNMatrix matrix = stiff ? SUNDenseMatrix(3, 3, context) : nullptr;
  SUNLinearSolver linear = stiff ? SUNLinSol_Dense(y, matrix, context) : nullptr;
  check(stiff ? CVodeSetLinearSolver(cvode, linear, matrix) : CVodeSetNonlinearSolver(cvode, fixed_point));
  check(CVodeRootInit(cvode, 1, cvode_velocity));
  check(CVodeSetNoInactiveRootWarn(cvode));
  check(CVodeSetMaxNumSteps(cvode, 10000000));

  PeerResponse response;
  const double dt = run.record.dt;
  double t = 0;
  check(CVodeSetStopTime(cvode, dt));
  while (run.knot < run.record.count + ring_knots) {
    const int flag = CVode(cvode, (run.knot + 1) * dt, y, &t, CV_NORMAL);
    check(flag);
    response.slip_m = std::max(response.slip_m, std::fabs(x[0]));
    if (flag == CV_ROOT_RETURN) {
      ++response.events;
      x[1] = run.contact.after_turn(x, run.acceleration(t));
      check(CVodeReInit(cvode, t, y));
    } else {
      t = ++run.knot * dt;
    }
    check(CVodeSetStopTime(cvode, (run.knot + 1) * dt));
  }
  CVodeFree(&cvode);
  if (fixed_point) SUNNonlinSolFree(fixed_point);
  if (linear) SUNLinSolFree(linear);
  if (matrix) SUNMatDestroy(matrix);
  N_VDestroy(y);
  N_VDestroy(scale);
  SUNContext_Free(&context);
  return response;
}

}  // namespace freestand::bench
