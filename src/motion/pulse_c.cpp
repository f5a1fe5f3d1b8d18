// Type Cn: n main cycles of velocity that end without velocity and without displacement.
//   a = w v_p cos(w t + phi),  v = v_p (sin(w t + phi) - sin(phi)),
//   u = (v_p / w)(cos(phi) - cos(w t + phi)) - v_p t sin(phi),  0 <= t <= (n + 1/2 - phi/pi) T.
// The duration makes the final velocity vanish; the phase, the final displacement:
//   cos(phi) + (phi - (n + 1/2) pi) sin(phi) = 0  [KM05 5.5].
// The cosine reaches -1 for every n >= 1, so the peak acceleration is w v_p; the peak velocity is (1 + sin(phi)) v_p.
#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <memory>

#include "base/units.hpp"
#include "motion/pulse_family.hpp"

namespace freestand::motion {
namespace {

constexpr double w = 2 * pi;

double final_displacement(double phi, void* parameters) {
  const double n = *static_cast<const int*>(parameters);
  return std::cos(phi) + (phi - (n + 0.5) * pi) * std::sin(phi);
}

PulseState state(double phi, double t) {
  const double angle = w * t + phi;
  return {std::cos(angle), (std::sin(angle) - std::sin(phi)) / w,
          ((std::cos(phi) - std::cos(angle)) / w - t * std::sin(phi)) / w};
}

// The velocity vanishes where sin(w t + phi) = sin(phi): at w t = 2 pi k and at w t = (2 k + 1) pi - 2 phi.
double peak_displacement(int n, double phi) {
  double peak = 0;
  for (int k = 0; k <= n; ++k)
    for (const double t : {static_cast<double>(k), k + 0.5 - phi / pi})
      peak = std::max(peak, std::abs(state(phi, t).displacement));
  return peak;
}

Pulse make(int n) {
  const double phi = c_pulse_phase_rad(n), duration = n + 0.5 - phi / pi;
  const std::string number = std::to_string(n);
  return {.name = std::string("C").append(number),
          .summary = std::string(number).append(" cycles of velocity: the floor ends where it began"),
          .source = "[KM05 ch. 5], the phase by [KM05 5.5]; Makris (1997)",
          .duration = duration,
          .phase_rad = phi,
          .velocity_amplitude = 1 / w,
          .peak_velocity = (1 + std::sin(phi)) / w,
          .peak_displacement = peak_displacement(n, phi),
          .breaks = {0, duration},
          .at = [phi](double t) { return state(phi, t); }};
}

const RegisteredPulse here{{.name = "Cn", .make = make, .numbered = true}};

}  // namespace

double c_pulse_phase_rad(int n) {
  if (n < 1) throw Error("no pulse C" + std::to_string(n) + " (n counts cycles): use n >= 1");
  gsl_function f{final_displacement, &n};
  const std::unique_ptr<gsl_root_fsolver, decltype(&gsl_root_fsolver_free)> solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), gsl_root_fsolver_free);
  gsl_root_fsolver_set(solver.get(), &f, 0, pi / 2);
  for (int i = 0; i < 100; ++i) {
    gsl_root_fsolver_iterate(solver.get());
    const double lower = gsl_root_fsolver_x_lower(solver.get()), upper = gsl_root_fsolver_x_upper(solver.get());
    if (gsl_root_test_interval(lower, upper, 0, 4e-16) == GSL_SUCCESS) break;
  }
  return gsl_root_fsolver_root(solver.get());
}

}  // namespace freestand::motion
