#include "dynamics/laws.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace freestand::dynamics {
namespace {

At inputs(Tape& tape, const Specimen& specimen) {
  const auto input = [&](Input which) { return tape.input(which); };
  return {.u = input(Input::u),
          .v = input(Input::v),
          .theta = input(Input::theta),
          .omega = input(Input::omega),
          .t = input(Input::t),
          .path = input(Input::path),
          .normal = input(Input::normal),
          .side = input(Input::side),
          .sigma = input(Input::sigma),
          .speed = input(Input::speed),
          .rest = input(Input::rest),
          .rise = input(Input::rise),
          .climb = input(Input::climb),
          .mu = specimen.friction.mu_k,
          .block = specimen.block,
          .acceleration = input(Input::acceleration),
          .own_state = {}};
}

}  // namespace

Laws::Laws(const Specimen& specimen) {
  std::size_t wanted = 0;
  for (const auto& use : specimen.effects) wanted += use.effect->states.size();
  if (wanted > max_states) {
    excess = Excess::states;
    return;
  }
  record(specimen);
  if (!tape.overflow()) return;
  const Excess found = tape.out_of_kinks() ? Excess::kinks : Excess::operations;
  *this = Laws();
  excess = found;
}

void Laws::record(const Specimen& specimen) {
  std::vector<At> at;
  for (const auto& [effect, parameters] : specimen.effects) {
    at.push_back(inputs(tape, specimen));
    for (std::size_t i = 0; i < effect->states.size(); ++i)
      at.back().own_state.push_back(tape.input(Input::state, states++));
  }
  const auto combine = [&](auto hook, int& result, auto with) {
    for (std::size_t i = 0; i < specimen.effects.size(); ++i) {
      const auto& [effect, parameters] = specimen.effects[i];
      if (!(effect->*hook)) continue;
      const Value value = (effect->*hook)(at[i], parameters);
      result = result < 0 ? value.node : with(Value{&tape, result}, value).node;
    }
  };
  const auto sum = [](Value a, Value b) { return a + b; };
  combine(&Effect::force, force, sum);
  combine(&Effect::lift, lift, sum);
  combine(&Effect::moment, moment, sum);
  combine(&Effect::tension, tension, sum);
  combine(&Effect::contents, contents, [](Value a, Value) { return a; });
  forces_end = tape.size();
  tape.begin_section();
  combine(&Effect::friction, friction, [](Value a, Value b) { return a * b; });
  friction_end = tape.size();
  tape.begin_section();

  int state = 0;
  for (std::size_t i = 0; i < specimen.effects.size(); ++i) {
    const auto& [effect, parameters] = specimen.effects[i];
    for (const OwnState& own : effect->states) {
      rate[state] = own.rate(at[i], parameters).node;
      relative_velocity[state++] = own.relative_velocity;
    }
    if (effect->carried_mass) carried_mass -= 1 - effect->carried_mass(parameters);
    if (effect->strength) strength = effect->strength(parameters);
    if (effect->wall) effect->wall(walls, parameters);
    if (effect->legs) effect->legs(legs, parameters);
    if (effect->settling_s) settling_s = std::max(settling_s, effect->settling_s(parameters));
  }
  for (int node = input_count; node < tape.size(); ++node) read_ |= tape.dependence(node);
  for (const int node : {force, lift, moment, friction})
    if (node >= 0) read_ |= tape.dependence(node);
  for (int i = 0; i < states; ++i) read_ |= tape.dependence(rate[i]);
}

bool Laws::uses(Input input) const {
  for (const int node : {force, lift, moment, friction})
    if (node >= 0 && tape.depends(node, input)) return true;
  return false;
}

bool Laws::grip_changes() const {
  std::uint32_t constant = 0;
  for (const Input input : {Input::path, Input::side, Input::sigma, Input::speed})
    constant |= 1U << static_cast<int>(input);
  return friction >= 0 && (tape.dependence(friction) & ~constant) != 0;
}

bool Laws::straight(bool slips) const {
  const auto enters = [&](int node) { return slips || node < forces_end || node >= friction_end; };
  for (int i = input_count; i < tape.size(); ++i) switch (enters(i) ? tape.operation(i).op : Op::constant) {
      case Op::constant:
      case Op::affine:
      case Op::add:
      case Op::subtract:
      case Op::abs:
      case Op::positive:
      case Op::step:
      case Op::latch:
      case Op::select:
        break;
      default:
        return false;
    }
  return !sees_normal_force(slips);
}

bool Laws::in_packs(bool slips) const {
  if (slips) return legs.frequency_radps == 0;
  for (int j = 0; j < tape.kink_count(); ++j) {
    const int node = tape.kink_node(j), argument = tape.kink_argument(j);
    if (node < forces_end || node >= friction_end) continue;
    if (tape.depends(argument, Input::sigma) || tape.depends(argument, Input::speed)) return false;
  }
  return true;
}

bool Laws::same_shape(const Laws& other) const {
  const auto numbers = [](const Laws& laws) {
    return std::array{laws.force,
                      laws.lift,
                      laws.moment,
                      laws.friction,
                      laws.forces_end,
                      laws.friction_end,
                      laws.states,
                      laws.tape.size(),
                      laws.walls.right.stands + 2 * laws.walls.left.stands,
                      static_cast<int>(laws.legs.frequency_radps > 0),
                      static_cast<int>(laws.carried_mass == 1)};
  };
  if (numbers(*this) != numbers(other)) return false;
  if (!std::equal(rate, rate + states, other.rate) ||
      !std::equal(relative_velocity, relative_velocity + states, other.relative_velocity))
    return false;
  for (int i = input_count; i < tape.size(); ++i) {
    const Node &x = tape.operation(i), &y = other.tape.operation(i);
    if (x.op != y.op || x.a != y.a || x.b != y.b || x.kink != y.kink) return false;
  }
  return true;
}

std::uint32_t Laws::initial_sides() const {
  Series<double, 0> values[max_nodes];
  for (int i = 0; i < input_count; ++i) values[i][0] = 0;
  values[static_cast<int>(Input::normal)][0] = 1;
  return sides_at(values, 0);
}

std::uint32_t Laws::sides_at(Series<double, 0>* values, std::uint32_t before) const {
  std::uint32_t sides = 0;
  for (int j = 0, from = input_count; j <= tape.kink_count(); ++j) {
    const int to = j < tape.kink_count() ? tape.kink_node(j) : tape.size();
    tape.advance(from, to, 0, sides, values);
    from = to;
    if (j < tape.kink_count() && (tape.below(j, values[tape.kink_argument(j)][0]) || tape.latched(j, before)))
      sides |= 1U << j;
  }
  return sides;
}

bool Laws::broken(std::uint32_t sides) const {
  for (int kink = 0; kink < tape.kink_count(); ++kink)
    if (tape.latched(kink, sides)) return true;
  return false;
}

Setup set_up(const Specimen& specimen, const Shaking& shaking) {
  Setup setup{specimen, shaking, {}};
  for (const auto& [effect, parameters] : specimen.effects) {
    if (effect->specimen) effect->specimen(setup.specimen, parameters);
    if (effect->floor) effect->floor(setup.floor, parameters);
  }
  if (setup.floor.vertical_scale != 0)
    setup.shaking.vertical_scale = setup.floor.vertical_scale * std::abs(shaking.scale);
  return setup;
}

bool has_laws(const Specimen& specimen) {
  return std::any_of(specimen.effects.begin(), specimen.effects.end(),
                     [](const EffectUse& use) { return use.effect->dynamic(); });
}

}  // namespace freestand::dynamics
