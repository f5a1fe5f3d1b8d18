// The laws of the effects as the integrators read them: an expression, recorded once per sample and evaluated on Taylor
// series.
//
// An effect states its law in plain algebra on Values, e.g. 1.0 - drop * (1.0 - exp(-at.speed / c)). Each operation
// appends a node to a Tape; coefficient k of every node follows from coefficients 0..k of the nodes before it [Griewank
// & Walther, Evaluating Derivatives, 2nd ed., ch. 13], which is all that a Taylor step asks for. No code is written
// twice for the derivative, the step and the search for events.
//
// Kinks (abs, min, max, step) are smooth on either side. Each has one bit that says on which side it is; its argument
// is a witness, and where that changes sign the integrators end their step and turn the bit. So a law may jump or bend
// and is still integrated to full order.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "dynamics/series.hpp"

namespace freestand::dynamics {

// What a law may look at. The first nodes of every tape, in this order.
enum class Input : int {
  u,             // displacement of the middle of the base relative to the floor [m]
  v,             // its rate [m/s]
  theta,         // rotation, positive clockwise [rad]
  omega,         // its rate [rad/s]
  t,             // time [s]
  path,          // slid path of the contact, integral of |slip speed| [m]
  normal,        // normal force over the weight m g [1]
  side,          // +1 on the right corner, -1 on the left one, 0 flat or in flight
  sigma,         // direction of the slip, or of the impending slip: +1 to the right, -1 to the left
  speed,         // |slip speed| of the contact [m/s]
  acceleration,  // absolute horizontal acceleration of the centre of mass [m/s2]; only for the rates of states
  state          // first of the states that effects bring along
};
inline constexpr int max_states = 6;
inline constexpr int input_count = static_cast<int>(Input::state) + max_states;
inline constexpr int max_nodes = 160;
inline constexpr int max_kinks = 16;

enum class Op : std::uint8_t {
  constant,
  affine,
  add,
  subtract,
  multiply,
  divide,
  exp,
  log,
  sqrt,
  power,
  sin,
  cos,
  abs,
  positive,
  step,
  latch
};

struct Node {
  Op op;
  std::int16_t a, b;  // operands; power: exponent in `value`; sin and cos: b is the partner
  double value;       // of a constant; of an exponent; affine: value * a + shift
  double shift;
};

class Tape;

// A quantity while a law is recorded.
struct Value {
  Tape* tape = nullptr;
  int node = 0;
};

class Tape {
 public:
  Value input(Input which, int offset = 0) { return {this, static_cast<int>(which) + offset}; }
  Value constant(double value) { return append(Op::constant, 0, 0, value); }
  // What is there already in this section is not recorded again: one kink, then, for a law that two hooks use.
  Value append(Op op, int a, int b, double value = 0, double shift = 0);
  void begin_section() { section_ = size_; }
  // factor * x + shift; of constants and of other such values, again one node.
  Value affine(Value x, double factor, double shift);
  const Node* node(Value x) const { return x.node < input_count ? nullptr : &nodes_[at(x.node)]; }
  Value append_circular(Op op, int a);  // sin or cos

  int size() const { return size_; }
  // Something found no room: the tape is of no use.
  bool overflow() const { return out_of_nodes_ || out_of_kinks_; }
  bool out_of_kinks() const { return out_of_kinks_; }
  bool depends(int node, Input on) const { return depends_[at(node)] >> static_cast<int>(on) & 1U; }
  std::uint32_t dependence(int node) const { return depends_[at(node)]; }
  int kink_count() const { return kink_count_; }
  int kink_argument(int kink) const { return nodes_[at(kinks_[at(kink)])].a; }
  int kink_node(int kink) const { return kinks_[at(kink)]; }
  bool latched(int kink, std::uint32_t sides) const {
    return (sides >> kink & 1U) && nodes_[at(kinks_[at(kink)])].op == Op::latch;
  }

  // Coefficient k of nodes [from, to). values: one series per node, inputs filled to order k. sides: bit j set when
  // kink j is on its negative side.
  template <int N>
  void advance(int from, int to, int k, std::uint32_t sides, Series<double, N>* values) const;

 private:
  int find(Op op, int a, int b, double value, double shift) const;  // -1: none
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  std::array<Node, max_nodes> nodes_;
  std::array<std::uint32_t, max_nodes> depends_;
  std::array<std::int16_t, max_kinks> kinks_;
  int size_ = input_count, section_ = input_count;
  int kink_count_ = 0;
  bool out_of_nodes_ = false, out_of_kinks_ = false;

 public:
  Tape();
};

Value operator+(Value a, Value b);
Value operator+(Value a, double b);
Value operator+(double a, Value b);
Value operator-(Value a);
Value operator-(Value a, Value b);
Value operator-(Value a, double b);
Value operator-(double a, Value b);
Value operator*(Value a, Value b);
Value operator*(Value a, double b);
Value operator*(double a, Value b);
Value operator/(Value a, Value b);
Value operator/(Value a, double b);
Value operator/(double a, Value b);
Value exp(Value x);
Value log(Value x);
Value sqrt(Value x);
Value sin(Value x);
Value cos(Value x);
Value tanh(Value x);
Value abs(Value x);
Value positive(Value x);  // max(x, 0)
Value step(Value x);      // 1 where x > 0, else 0
Value latch(Value x);     // 1 until x has once fallen below 0, then 0 for good: what breaks
Value max(Value a, Value b);
Value min(Value a, Value b);
Value pow(Value x, double exponent);
Value pow(Value x, Value exponent);
Value where(Value condition, Value yes, Value no);  // yes where condition > 0

template <int N>
void Tape::advance(int from, int to, int k, std::uint32_t sides, Series<double, N>* values) const {
  for (int i = from; i < to; ++i) {
    const Node& node = nodes_[at(i)];
    const Series<double, N>&x = values[node.a], &y = values[node.b];
    Series<double, N>& z = values[i];
    double sum = 0;
    switch (node.op) {
      case Op::constant:
        z[k] = k == 0 ? node.value : 0.0;
        break;
      case Op::affine:
        z[k] = node.value * x[k] + (k == 0 ? node.shift : 0.0);
        break;
      case Op::add:
        z[k] = x[k] + y[k];
        break;
      case Op::subtract:
        z[k] = x[k] - y[k];
        break;
      case Op::multiply:
        z[k] = product(x, y, k);
        break;
      case Op::divide:
        sum = x[k];
        for (int j = 1; j <= k; ++j) sum -= y[j] * z[k - j];
        z[k] = sum / y[0];
        break;
      case Op::exp:
        for (int j = 1; j <= k; ++j) sum += j * x[j] * z[k - j];
        z[k] = k == 0 ? std::exp(x[0]) : sum / k;
        break;
      case Op::log:
        for (int j = 1; j < k; ++j) sum += j * z[j] * x[k - j];
        z[k] = k == 0 ? std::log(x[0]) : (x[k] - sum / k) / x[0];
        break;
      case Op::sqrt:
        for (int j = 1; j < k; ++j) sum += z[j] * z[k - j];
        z[k] = k == 0 ? std::sqrt(x[0]) : (x[k] - sum) / (2 * z[0]);
        break;
      case Op::power:
        for (int j = 1; j <= k; ++j) sum += (j * node.value - (k - j)) * x[j] * z[k - j];
        z[k] = k == 0 ? std::pow(x[0], node.value) : sum / (k * x[0]);
        break;
      case Op::sin:
        for (int j = 1; j <= k; ++j) sum += j * x[j] * y[k - j];
        z[k] = k == 0 ? std::sin(x[0]) : sum / k;
        break;
      case Op::cos:
        for (int j = 1; j <= k; ++j) sum += j * x[j] * y[k - j];
        z[k] = k == 0 ? std::cos(x[0]) : -sum / k;
        break;
      case Op::abs:
        z[k] = sides >> node.b & 1U ? -x[k] : x[k];
        break;
      case Op::positive:
        z[k] = sides >> node.b & 1U ? 0.0 : x[k];
        break;
      case Op::step:
      case Op::latch:
        z[k] = k > 0 || (sides >> node.b & 1U) ? 0.0 : 1.0;
        break;
    }
  }
}

}  // namespace freestand::dynamics
