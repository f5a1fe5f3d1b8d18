#include "dynamics/linear_pull.hpp"

#include <array>
#include <cmath>

namespace freestand::dynamics {
namespace {

// A node of the tape as u's share, that of u', and a constant.
struct Linear {
  double u = 0, v = 0, constant = NAN;  // NAN: it is something else

  bool linear() const { return std::isfinite(constant); }
};

Linear sum(const Linear& a, const Linear& b, double sign) {
  return {a.u + sign * b.u, a.v + sign * b.v, a.constant + sign * b.constant};
}

}  // namespace

std::optional<LinearPull> linear_pull(const Laws& laws) {
  if (!laws.plain() || laws.friction >= 0 || laws.force < 0 || laws.tension >= 0 || laws.contents >= 0) return {};
  std::array<Linear, max_nodes> nodes;
  nodes[static_cast<std::size_t>(Input::u)] = {1, 0, 0};
  nodes[static_cast<std::size_t>(Input::v)] = {0, 1, 0};
  for (int i = input_count; i <= laws.force; ++i) {
    const Node node = laws.tape.operation(i);
    Linear& now = nodes[static_cast<std::size_t>(i)];
    if (node.op == Op::constant) {
      now = {0, 0, node.value};
      continue;
    }
    const Linear& a = nodes[static_cast<std::size_t>(node.a)];
    if (node.op == Op::affine) now = {node.value * a.u, node.value * a.v, node.value * a.constant + node.shift};
    if (node.op == Op::add || node.op == Op::subtract)
      now = sum(a, nodes[static_cast<std::size_t>(node.b)], node.op == Op::add ? 1 : -1);
  }
  const Linear& force = nodes[static_cast<std::size_t>(laws.force)];
  const bool passive = force.u <= 0 && force.v <= 0 && std::isfinite(force.u) && std::isfinite(force.v);
  if (!force.linear() || force.constant != 0 || !passive) return {};
  return LinearPull{0 - force.u, 0 - force.v};
}

}  // namespace freestand::dynamics
