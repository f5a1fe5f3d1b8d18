// The dynamic effects of one specimen, recorded together: their factors of friction multiplied, their forces summed.
#pragma once

#include <freestand/floor_motion.hpp>
#include <freestand/specimen.hpp>

#include "dynamics/effect.hpp"
#include "dynamics/tape.hpp"

namespace freestand::dynamics {

// What laws ask for that there is no room for.
enum class Excess { none, operations, kinks, states };

struct Laws {
  explicit Laws(const Specimen& specimen);

  Excess excess = Excess::none;  // other than none: no law is recorded
  bool sound() const {
    return excess == Excess::none && carried_mass > 0 && !(walls.any() && legs.frequency_radps > 0);
  }

  Tape tape;
  // Nodes of the results; -1 where no effect has a say. Nodes [input_count, forces_end) serve force, lift and moment,
  // [forces_end, friction_end) the friction, [friction_end, tape.size()) the rates of the states.
  int force = -1, lift = -1, moment = -1, friction = -1;
  int tension = -1, contents = -1;  // told alone: no part of the equations of motion
  double strength = 0;              // of the tension, 0: it does not break [m/s2]
  int forces_end = input_count, friction_end = input_count;
  int states = 0;
  int rate[max_states] = {};
  bool relative_velocity[max_states] = {};
  double carried_mass = 1;  // M
  Walls walls;
  Legs legs;
  double settling_s = 0;

  // States go on moving while the block rests.
  bool evolve_at_rest() const { return states > 0 || legs.frequency_radps > 0; }
  bool uses(Input input) const;
  // Any node looks at it.
  bool reads(Input input) const { return read_ >> static_cast<int>(input) & 1U; }
  // Nothing but a friction and a force, without kinks.
  bool plain() const {
    return lift < 0 && moment < 0 && states == 0 && !walls.any() && !(legs.frequency_radps > 0) && carried_mass == 1 &&
           tape.kink_count() == 0;
  }
  // They change while nothing moves.
  bool change_at_rest() const { return uses(Input::t) || uses(Input::rest); }
  bool sees_rise() const { return reads(Input::rise) || reads(Input::climb); }
  // Of a block on a corner, that slips or not: forces, moments or friction depend on the normal force, which depends on them.
  bool sees_normal_force(bool slips) const {
    const auto looks = [&](int node) { return node >= 0 && tape.depends(node, Input::normal); };
    return looks(force) || looks(lift) || looks(moment) || (slips && looks(friction));
  }
  // The share of the normal force that friction may take changes while a contact is stuck.
  bool grip_changes() const;
  // Of a contact that slips or not: those in its equations are sums and multiples of what they look at, on either side of their
  // kinks: they bend no series that the block does not bend itself, whose last terms tell what a step neglects.
  bool straight(bool slips) const;
  // A pack can step along: no kinks turn with the direction of a slip that is about to begin, and no foot slips under legs, which has
  // no mass and moves faster than the knots of a record follow one another.
  bool in_packs(bool slips) const;
  // The two differ in numbers only.
  bool same_shape(const Laws& other) const;
  // On which side of their kinks the laws are when nothing has moved yet.
  std::uint32_t initial_sides() const;
  // The same for the inputs in `values`, whose nodes are filled in; what has broken in `before` stays broken.
  std::uint32_t sides_at(Series<double, 0>* values, std::uint32_t before) const;
  // The same for the friction of a slip that is about to begin: other sides than those of forces, and than the opposite slip's.
  // turned: kinks that were met at this instant stay, unless their argument is zero for good.
  template <int N>
  std::uint32_t sides_of_slip(std::uint32_t sides, std::uint32_t turned, Series<double, N>* values) const {
    constexpr std::uint32_t of_slip =
        1U << static_cast<int>(Input::sigma) | 1U << static_cast<int>(Input::speed) | 1U << static_cast<int>(Input::v);
    for (int j = 0; j < tape.kink_count(); ++j) {
      const int node = tape.kink_node(j), argument = tape.kink_argument(j);
      if (node < forces_end || node >= friction_end) continue;
      if (!(tape.dependence(argument) & of_slip)) continue;
      const bool met = turned >> j & 1U;
      for (int k = 0; k < (met ? N : 1); ++k) tape.advance(forces_end, node, k, sides, values);
      if (met && !vanishes(values[argument])) continue;
      sides = (sides & ~(1U << j)) | (tape.below(j, values[argument][0]) ? 1U << j : 0U);
    }
    return sides;
  }
  // Something has broken.
  bool broken(std::uint32_t sides) const;

 private:
  Laws() = default;
  void record(const Specimen& specimen);

  std::uint32_t read_ = 0;  // inputs, one bit each
};

// Specimen and floor as the effects that are no part of the equations of motion leave them.
struct Setup {
  Specimen specimen;
  Shaking shaking;
  FloorInput floor;
};
Setup set_up(const Specimen& specimen, const Shaking& shaking);

// Any effect whose hooks act within the equations of motion.
bool has_laws(const Specimen& specimen);

}  // namespace freestand::dynamics
