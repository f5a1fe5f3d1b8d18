#include "measurement/predict/sliding_law.hpp"

#include <limits>

#include "base/units.hpp"

namespace freestand::measurement {

using dynamics::Input;

namespace {

// All nodes of the tape at these inputs, each kink on the side that its argument says.
void evaluate(const dynamics::Tape& tape, dynamics::Series<double, 0>* values) {
  std::uint32_t sides = 0;
  int from = dynamics::input_count;
  for (int kink = 0; kink < tape.kink_count(); ++kink) {
    tape.advance(from, tape.kink_node(kink), 0, sides, values);
    if (values[tape.kink_argument(kink)][0] < 0) sides |= 1U << kink;
    from = tape.kink_node(kink);
  }
  tape.advance(from, tape.size(), 0, sides, values);
}

}  // namespace

SlidingLaw::SlidingLaw(const Specimen& specimen) {
  const FloorMotion still;
  dynamics::Setup setup = dynamics::set_up(specimen, {.motion = &still});
  mu_k_ = setup.specimen.friction.mu_k;
  floor_ = setup.floor;
  if (dynamics::has_laws(setup.specimen)) laws_.emplace(setup.specimen);
  known_ = !laws_ || (laws_->sound() && !laws_->evolve_at_rest());
}

double SlidingLaw::gravity_mps2(double vertical_mps2) const {
  return standard_gravity_mps2 + floor_.vertical_scale * vertical_mps2;
}

double SlidingLaw::friction(const Sliding& at) const {
  if (!known_) return std::numeric_limits<double>::quiet_NaN();
  const double normal = standard_gravity_mps2 * floor_.gravity_factor + floor_.vertical_scale * at.vertical_mps2;
  double factor = 1, force = 0, carried = 1;
  if (laws_) {
    dynamics::Series<double, 0> values[dynamics::max_nodes];
    for (int i = 0; i < dynamics::input_count; ++i) values[i][0] = 0;
    const auto set = [&](Input input, double value) { values[static_cast<int>(input)][0] = value; };
    set(Input::u, at.position_m);
    set(Input::v, at.sigma * at.speed_mps);
    set(Input::speed, at.speed_mps);
    set(Input::sigma, at.sigma);
    set(Input::path, at.path_m);
    set(Input::t, at.time_s);
    set(Input::normal, normal / standard_gravity_mps2);
    evaluate(laws_->tape, values);
    if (laws_->friction >= 0) factor = values[laws_->friction][0];
    if (laws_->force >= 0) force = values[laws_->force][0];
    carried = laws_->carried_mass;
  }
  const double total = (force - at.sigma * mu_k_ * factor * normal) / carried - floor_.push_mps2;
  return -at.sigma * total / gravity_mps2(at.vertical_mps2);
}

}  // namespace freestand::measurement
