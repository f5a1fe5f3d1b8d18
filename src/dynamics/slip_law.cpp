#include "dynamics/slip_law.hpp"

#include <array>
#include <cmath>

namespace freestand::dynamics {
namespace {

bool has_packs(Op op) {
  return (takes_two(op) && op != Op::select) || op == Op::constant || op == Op::affine || op == Op::exp;
}

// The tape folds one operation into the next, and leaves behind what nobody asks for then.
SlipLaw without_unused(const SlipLaw& all) {
  bool used[slip_places + slip_law_nodes] = {};
  used[all.place()] = true;
  for (int i = all.count; i-- > 0;) {
    const Node& node = all.nodes[i];
    if (!used[slip_places + i] || node.op == Op::constant) continue;
    used[node.a] = true;
    if (takes_two(node.op)) used[node.b] = true;
  }
  SlipLaw law;
  law.sees_path = used[slip_path_place];
  law.sees_direction = used[slip_direction_place];
  std::int16_t place[slip_places + slip_law_nodes] = {slip_speed_place, slip_path_place, slip_direction_place};
  for (int i = 0; i < all.count; ++i) {
    if (!used[slip_places + i]) continue;
    Node& node = law.nodes[law.count] = all.nodes[i];
    node.a = place[node.a];
    node.b = place[node.b];
    place[slip_places + i] = static_cast<std::int16_t>(slip_places + law.count++);
  }
  return law;
}

bool fading(const SlipLaw& law) {
  const auto is = [&](int i, Op op, int of) { return law.nodes[i].op == op && law.nodes[i].a == of; };
  return law.count == 3 && is(0, Op::affine, slip_speed_place) && is(1, Op::exp, slip_places) &&
         is(2, Op::affine, slip_places + 1);
}

}  // namespace

bool same_shape(const SlipLaw& a, const SlipLaw& b) {
  if (a.count != b.count) return false;
  for (int i = 0; i < a.count; ++i) {
    const Node &x = a.nodes[i], &y = b.nodes[i];
    if (x.op != y.op || x.a != y.a || x.b != y.b) return false;
  }
  return true;
}

std::optional<SlipLaw> slip_law(const Laws& laws) {
  if (!laws.plain() || laws.force >= 0 || laws.friction < 0) return {};
  constexpr Input seen[slip_places] = {Input::speed, Input::path, Input::sigma};
  std::uint32_t others = laws.tape.dependence(laws.friction);
  for (const Input input : seen) others &= ~(1U << static_cast<int>(input));
  if (others) return {};
  // Where each node of the tape is in the law; -1: it takes no part.
  std::array<int, max_nodes> place;
  place.fill(-1);
  for (int i = 0; i < slip_places; ++i) place[static_cast<std::size_t>(seen[i])] = i;
  SlipLaw law;
  for (int i = laws.forces_end; i <= laws.friction; ++i) {
    const Node node = laws.tape.operation(i);
    const auto from = [&](int operand) { return place[static_cast<std::size_t>(operand)]; };
    const bool used = node.op == Op::constant || (from(node.a) >= 0 && (!takes_two(node.op) || from(node.b) >= 0));
    if (!used || !has_packs(node.op) || law.count == slip_law_nodes) return {};
    const int a = node.op == Op::constant ? 0 : from(node.a), b = takes_two(node.op) ? from(node.b) : 0;
    law.nodes[law.count] = {node.op, static_cast<std::int16_t>(a), static_cast<std::int16_t>(b), node.value, node.shift,
                            -1};
    place[static_cast<std::size_t>(i)] = slip_places + law.count++;
  }
  if (law.count == 0) return {};  // what it looks at is itself the factor
  law = without_unused(law);
  law.fades = fading(law);
  return law;
}

namespace {

using Places = double[slip_places + slip_law_nodes];

void evaluate(const SlipLaw& law, const Slip& slip, Places& at) {
  at[slip_speed_place] = slip.speed;
  at[slip_path_place] = slip.path;
  at[slip_direction_place] = slip.direction;
  for (int i = 0; i < law.count; ++i) {
    const Node& node = law.nodes[i];
    const double x = at[node.a], y = at[node.b];
    double& z = at[slip_places + i];
    switch (node.op) {
      case Op::constant:
        z = node.value;
        break;
      case Op::affine:
        z = node.value * x + node.shift;
        break;
      case Op::add:
        z = x + y;
        break;
      case Op::subtract:
        z = x - y;
        break;
      case Op::multiply:
        z = x * y;
        break;
      case Op::divide:
        z = x / y;
        break;
      default:
        z = std::exp(x);
    }
  }
}

}  // namespace

double friction_factor(const SlipLaw& law, const Slip& slip) {
  Places at;
  evaluate(law, slip, at);
  return at[law.place()];
}

double steepest_exponent(const SlipLaw& law, double change, double within) {
  constexpr double fastest = 10;  // [m/s]
  double most = 0;
  Places before, after;
  for (double speed = 0; speed < fastest; speed = 2 * speed + change) {
    const double later = speed + change;
    for (const double path : {0.0, 0.1, 1.0, 10.0})
      for (const int direction : {1, -1}) {
        if ((path > 0 && !law.sees_path) || (direction < 0 && !law.sees_direction)) continue;
        evaluate(law, {speed, path, direction}, before);
        evaluate(law, {later, path + later * within, direction}, after);
        for (int i = 0; i < law.count; ++i)
          if (law.nodes[i].op == Op::exp)
            most = std::fmax(most, std::abs(after[law.nodes[i].a] - before[law.nodes[i].a]));
      }
    if (law.fades) break;  // its exponent is a straight line
  }
  return most;
}

}  // namespace freestand::dynamics
