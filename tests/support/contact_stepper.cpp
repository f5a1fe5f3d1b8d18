#include "support/contact_stepper.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "support/moreau_stepper.hpp"

namespace freestand::test {
namespace {

// The line through two instants within the step, so that a jump at its end is not seen.
FloorLine line_of(const FloorAt& floor, double t, double dt) {
  const double first = t + 0.25 * dt, second = t + 0.75 * dt;
  const FloorAcceleration a = floor(first), b = floor(second);
  return {first, a.horizontal_mps2, a.vertical_mps2, 2 * (b.horizontal_mps2 - a.horizontal_mps2) / dt,
          2 * (b.vertical_mps2 - a.vertical_mps2) / dt};
}

MoreauStepper stepper_of(const Specimen& specimen) {
  const Block& block = specimen.block;
  ContactBody body;
  body.left_m = block.left_m;
  body.right_m = block.right_m;
  body.height_m = block.height_m;
  body.gyration2_m2 = block.gyration2_m2;
  ContactLaws laws;
  laws.mu_s = specimen.friction.mu_s;
  laws.mu_k = specimen.friction.mu_k;
  laws.vertical_scale = 1;  // on the channel that the floor has
  return {body, laws};
}

}  // namespace

StepperResult step_contacts(const Specimen& specimen, const FloorAt& floor, const StepperSettings& settings) {
  MoreauStepper stepper = stepper_of(specimen);
  StepperResult result;
  const auto steps = static_cast<long>(std::llround(settings.end_time_s / settings.step_s));
  const auto stride = std::max(1L, std::lround(settings.output_step_s / settings.step_s));
  for (long i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) * settings.step_s, theta = stepper.rotation();
    if (i % stride == 0)
      result.points.push_back({t, stepper.slip(), theta, stepper.rotation_rate(), stepper.contact_speed(),
                               stepper.closed(left), stepper.closed(right)});
    result.peak_slip_m = std::max(result.peak_slip_m, std::abs(stepper.slip()));
    result.peak_rotation_rad = std::max(result.peak_rotation_rad, std::abs(theta));
    result.overturned = std::abs(theta) > 0.5 * pi;
    if (result.overturned || i == steps) break;
    if (!stepper.step(line_of(floor, t, settings.step_s), t, settings.step_s)) {
      result.inconsistent = true;
      break;
    }
    const bool slips = stepper.slips();
    result.flew = result.flew || stepper.flies();
    result.slide_rocked = result.slide_rocked || (slips && stepper.closed(left) != stepper.closed(right));
    result.impacts += stepper.closing_speed() > 1e-3 ? 1 : 0;
    result.slipping_impact = result.slipping_impact || (slips && stepper.closing_speed() > 1e-2);
  }
  result.slid_path_m = stepper.path();
  result.residual_slip_m = stepper.slip();
  result.residual_rotation_rad = stepper.rotation();
  return result;
}

FloorAt floor_of(const Shaking& shaking) {
  const FloorMotion* motion = shaking.motion;
  return [shaking, motion, segment = std::size_t{0}](double t) mutable -> FloorAcceleration {
    const double x = t / shaking.stretch;
    while (segment < motion->segments() && x >= motion->knot_s[segment + 1]) ++segment;
    while (segment > 0 && x < motion->knot_s[segment]) --segment;
    if (segment >= motion->segments()) return {};
    const auto width = static_cast<std::size_t>(motion->degree) + 1;
    const double tau = x - motion->knot_s[segment];
    FloorAcceleration a;
    double power = 1;
    for (std::size_t k = 0; k < width; ++k, power *= tau) {
      a.horizontal_mps2 += power * motion->horizontal_mps2[segment * width + k];
      if (!motion->vertical_mps2.empty()) a.vertical_mps2 += power * motion->vertical_mps2[segment * width + k];
    }
    a.horizontal_mps2 *= shaking.scale;
    a.vertical_mps2 *= shaking.vertical_scale;
    return a;
  };
}

}  // namespace freestand::test
