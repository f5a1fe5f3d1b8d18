#include "dynamics/speed_law.hpp"

#include <array>
#include <cmath>

namespace freestand::dynamics {
namespace {

bool has_packs(Op op) {
  return (takes_two(op) && op != Op::select) || op == Op::constant || op == Op::affine || op == Op::exp;
}

// The tape folds one operation into the next, and leaves behind what nobody asks for then.
SpeedLaw without_unused(const SpeedLaw& all) {
  bool used[speed_law_nodes + 1] = {};
  used[all.count] = true;
  for (int i = all.count; i > 0; --i) {
    const Node& node = all.nodes[i - 1];
    if (!used[i] || node.op == Op::constant) continue;
    used[node.a] = true;
    if (takes_two(node.op)) used[node.b] = true;
  }
  SpeedLaw law;
  std::int16_t place[speed_law_nodes + 1] = {};
  for (int i = 1; i <= all.count; ++i) {
    if (!used[i]) continue;
    Node& node = law.nodes[law.count] = all.nodes[i - 1];
    node.a = place[node.a];
    node.b = place[node.b];
    place[i] = static_cast<std::int16_t>(++law.count);
  }
  return law;
}

bool fading(const SpeedLaw& law) {
  const auto is = [&](int i, Op op) { return law.nodes[i].op == op && law.nodes[i].a == i; };
  return law.count == 3 && is(0, Op::affine) && is(1, Op::exp) && is(2, Op::affine);
}

}  // namespace

bool same_shape(const SpeedLaw& a, const SpeedLaw& b) {
  if (a.count != b.count) return false;
  for (int i = 0; i < a.count; ++i) {
    const Node &x = a.nodes[i], &y = b.nodes[i];
    if (x.op != y.op || x.a != y.a || x.b != y.b) return false;
  }
  return true;
}

std::optional<SpeedLaw> speed_law(const Laws& laws) {
  const bool more = laws.force >= 0 || laws.lift >= 0 || laws.moment >= 0 || laws.states > 0 || laws.walls.any() ||
                    laws.legs.frequency_radps > 0 || laws.carried_mass != 1 || laws.tape.kink_count() > 0;
  if (more || laws.friction < 0) return {};
  constexpr int speed = static_cast<int>(Input::speed);
  if (laws.tape.dependence(laws.friction) & ~(1U << speed)) return {};
  // Where each node of the tape is in the law; -1: it takes no part.
  std::array<int, max_nodes> place;
  place.fill(-1);
  place[speed] = 0;
  SpeedLaw law;
  for (int i = laws.forces_end; i <= laws.friction; ++i) {
    const Node node = laws.tape.operation(i);
    const auto from = [&](int operand) { return place[static_cast<std::size_t>(operand)]; };
    const bool used = node.op == Op::constant || (from(node.a) >= 0 && (!takes_two(node.op) || from(node.b) >= 0));
    if (!used || !has_packs(node.op) || law.count == speed_law_nodes) return {};
    const int a = node.op == Op::constant ? 0 : from(node.a), b = takes_two(node.op) ? from(node.b) : 0;
    law.nodes[law.count] = {node.op, static_cast<std::int16_t>(a), static_cast<std::int16_t>(b), node.value, node.shift,
                            -1};
    place[static_cast<std::size_t>(i)] = ++law.count;
  }
  law = without_unused(law);
  law.fades = fading(law);
  return law;
}

namespace {

// The values of all operations, that of the speed itself first.
void evaluate(const SpeedLaw& law, double speed, double (&at)[speed_law_nodes + 1]) {
  at[0] = speed;
  for (int i = 0; i < law.count; ++i) {
    const Node& node = law.nodes[i];
    const double x = at[node.a], y = at[node.b];
    double& z = at[i + 1];
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

double friction_factor(const SpeedLaw& law, double speed) {
  double at[speed_law_nodes + 1];
  evaluate(law, speed, at);
  return at[law.count];
}

double steepest_exponent(const SpeedLaw& law, double change) {
  constexpr double fastest = 10;  // [m/s]
  double most = 0;
  double before[speed_law_nodes + 1], after[speed_law_nodes + 1];
  for (double speed = 0; speed < fastest; speed = 2 * speed + change) {
    evaluate(law, speed, before);
    evaluate(law, speed + change, after);
    for (int i = 0; i < law.count; ++i)
      if (law.nodes[i].op == Op::exp) most = std::fmax(most, std::abs(after[law.nodes[i].a] - before[law.nodes[i].a]));
    if (law.fades) break;  // its exponent is a straight line
  }
  return most;
}

}  // namespace freestand::dynamics
