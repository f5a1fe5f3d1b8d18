#include "motion/pulse_fit.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

namespace freestand::motion {
namespace {

constexpr int points = 512;

// Velocity samples over the neighbourhood of the guess, mirrored where the guess is negative, so that a mirrored record
// gives the mirrored fit to the bit.
struct Problem {
  const Pulse& pulse;
  double begin_s, step_s;
  std::vector<double> velocity;
};

struct Parameters {
  double period_s, velocity_mps, start_s;
};

Parameters parameters(const gsl_vector* x) {
  return {std::exp(gsl_vector_get(x, 0)), gsl_vector_get(x, 1), gsl_vector_get(x, 2)};
}

// The pulse's velocity for v_p = 1, and its derivative by time in periods; both zero outside the pulse.
std::array<double, 2> unit_velocity(const Pulse& pulse, double t) {
  if (t < 0 || t > pulse.duration) return {0, 0};
  const PulseState state = pulse.at(t);
  return {state.velocity / pulse.velocity_amplitude, state.acceleration / pulse.velocity_amplitude};
}

int residual(const gsl_vector* x, void* problem, gsl_vector* f) {
  const Problem& p = *static_cast<const Problem*>(problem);
  const Parameters now = parameters(x);
  for (std::size_t i = 0; i < p.velocity.size(); ++i) {
    const double t = (p.begin_s + p.step_s * static_cast<double>(i) - now.start_s) / now.period_s;
    gsl_vector_set(f, i, now.velocity_mps * unit_velocity(p.pulse, t)[0] - p.velocity[i]);
  }
  return GSL_SUCCESS;
}

int jacobian(const gsl_vector* x, void* problem, gsl_matrix* J) {
  const Problem& p = *static_cast<const Problem*>(problem);
  const Parameters now = parameters(x);
  for (std::size_t i = 0; i < p.velocity.size(); ++i) {
    const double t = (p.begin_s + p.step_s * static_cast<double>(i) - now.start_s) / now.period_s;
    const auto [shape, slope] = unit_velocity(p.pulse, t);
    gsl_matrix_set(J, i, 0, -now.velocity_mps * slope * t);
    gsl_matrix_set(J, i, 1, shape);
    gsl_matrix_set(J, i, 2, -now.velocity_mps * slope / now.period_s);
  }
  return GSL_SUCCESS;
}

// Integral of velocity^2 less that of the misfit: over the pulse only, elsewhere they are the same.
double gain(const FloorVelocity& velocity, double duration_s, const Pulse& pulse, const Parameters& now) {
  const double begin = std::max(0.0, now.start_s);
  const double end = std::min(duration_s, now.start_s + pulse.duration * now.period_s);
  const double step = (end - begin) / points;
  double sum = 0;
  for (int i = 0; i < points && step > 0; ++i) {
    const double t = begin + step * (i + 0.5);
    const double fitted = now.velocity_mps * unit_velocity(pulse, (t - now.start_s) / now.period_s)[0];
    sum += fitted * (2 * velocity(t) - fitted);
  }
  return sum * step;
}

// GSL reports instead of ending the program, as long as this lives.
struct QuietGsl {
  gsl_error_handler_t* before = gsl_set_error_handler_off();
  QuietGsl() = default;
  QuietGsl(const QuietGsl&) = delete;
  ~QuietGsl() { gsl_set_error_handler(before); }
};

Parameters levenberg_marquardt(Problem& problem, const Parameters& guess) {
  const QuietGsl quiet;
  gsl_multifit_nlinear_fdf fdf{};
  fdf.f = residual;
  fdf.df = jacobian;
  fdf.n = problem.velocity.size();
  fdf.p = 3;
  fdf.params = &problem;
  gsl_multifit_nlinear_parameters settings = gsl_multifit_nlinear_default_parameters();
  const std::unique_ptr<gsl_multifit_nlinear_workspace, decltype(&gsl_multifit_nlinear_free)> work(
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &settings, fdf.n, fdf.p), gsl_multifit_nlinear_free);
  const double start[] = {std::log(guess.period_s), guess.velocity_mps, guess.start_s};
  const gsl_vector_const_view x = gsl_vector_const_view_array(start, 3);
  if (gsl_multifit_nlinear_init(&x.vector, &fdf, work.get()) != GSL_SUCCESS) return guess;
  int info = 0;
  gsl_multifit_nlinear_driver(200, 1e-12, 1e-12, 0, nullptr, nullptr, &info, work.get());
  return parameters(gsl_multifit_nlinear_position(work.get()));
}

}  // namespace

PulseFit refine(const FloorVelocity& velocity, double duration_s, const Pulse& pulse, const PulseFit& guess) {
  const double sign = guess.velocity_mps < 0 ? -1 : 1, length = pulse.duration * guess.period_s;
  const double begin = std::max(0.0, guess.start_s - 0.5 * length);
  const double end = std::min(duration_s, guess.start_s + 1.5 * length);
  Problem problem{pulse, begin, (end - begin) / points, {}};
  for (int i = 0; i <= points; ++i)
    problem.velocity.push_back(sign * velocity(std::min(duration_s, begin + problem.step_s * i)));
  const Parameters first{guess.period_s, sign * guess.velocity_mps, guess.start_s};
  const Parameters fit = levenberg_marquardt(problem, first);
  const auto result = [&](const Parameters& p) -> PulseFit {
    const Parameters turned{p.period_s, sign * p.velocity_mps, p.start_s};
    return {p.period_s, turned.velocity_mps, p.start_s, gain(velocity, duration_s, pulse, turned)};
  };
  const PulseFit before = result(first), after = result(fit);
  const double growth = fit.period_s / first.period_s;
  const bool near = growth > 0.6 && growth < 1.6 && std::abs(fit.start_s - first.start_s) < 0.5 * length;
  return near && after.gain > before.gain ? after : before;
}

}  // namespace freestand::motion
