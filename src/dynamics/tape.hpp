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

#include <cmath>
#include <cstdint>
#include <limits>

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
  rest,          // for how long the contact has stood still, and nothing struck the block; 0 in slips and in flight [s]
  rise,          // height of the middle of the base over the floor [m]
  climb,         // its rate [m/s]
  acceleration,  // absolute horizontal acceleration of the centre of mass [m/s2]; only for the rates of states
  state          // first of the states that effects bring along
};
inline constexpr int max_states = 6;
inline constexpr int input_count = static_cast<int>(Input::state) + max_states;
inline constexpr int max_nodes = 162;
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
  latch,
  select
};

struct Node {
  Op op;
  std::int16_t a, b;  // operands; power: exponent in `value`; sin and cos: b is the partner
  double value;       // of a constant; of an exponent; affine: value * a + shift
  double shift;       // sqrt and power: slope of the line that stands for them next to zero, where there is a kink to it
  std::int16_t kink;  // on whose sides it differs; -1: none
};

// Both operands are values.
inline bool takes_two(Op op) {
  return op == Op::add || op == Op::subtract || op == Op::multiply || op == Op::divide || op == Op::select;
}

// Roots and powers of less than this are taken for a straight line, on either side of zero, from where no series of them starts.
// It is many times what a step may miss in a speed (1e-9 times p and the block's size): such a speed has a sign.
inline constexpr double zero_of_roots = 1e-7;

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
  Value append(Op op, int a, int b, double value = 0, double shift = 0, int kink = -1);
  void begin_section() { section_ = size_; }
  // factor * x + shift; of constants and of other such values, again one node.
  Value affine(Value x, double factor, double shift);
  // Of a node that is no input.
  const Node& operation(int node) const { return nodes_[node]; }
  // No operation: it is an input.
  const Node* node(Value x) const { return x.node < input_count ? nullptr : &nodes_[x.node]; }
  // The kink at which x changes its sign.
  int kink_at(Value x) { return nodes_[append(Op::step, x.node, 0).node].kink; }
  Value append_circular(Op op, int a);  // sin or cos

  int size() const { return size_; }
  // Something found no room: the tape is of no use.
  bool overflow() const { return out_of_nodes_ || out_of_kinks_; }
  bool out_of_kinks() const { return out_of_kinks_; }
  bool depends(int node, Input on) const { return depends_[node] >> static_cast<int>(on) & 1U; }
  std::uint32_t dependence(int node) const { return depends_[node]; }
  int kink_count() const { return kink_count_; }
  int kink_argument(int kink) const { return nodes_[kinks_[kink]].a; }
  int kink_node(int kink) const { return kinks_[kink]; }
  bool latched(int kink, std::uint32_t sides) const {
    return (sides >> kink & 1U) && nodes_[kinks_[kink]].op == Op::latch;
  }

  // A step is 1 where its argument is greater than zero: not at rest, where a speed is zero for long.
  bool is_step(int kink) const { return nodes_[kinks_[kink]].op == Op::step; }
  bool is_latch(int kink) const { return nodes_[kinks_[kink]].op == Op::latch; }
  bool below(int kink, double argument) const { return argument < 0 || (argument == 0 && is_step(kink)); }

  // Whether the kink can turn: what has broken cannot, nor what looks at no number (on a branch that is not taken).
  bool turns(int kink, std::uint32_t sides, double argument) const {
    return !latched(kink, sides) && argument == argument;
  }

  // Coefficient k of nodes [from, to). values: one series per node, inputs filled to order k. Numbers: those of one sample, or
  // of the samples of a pack, whose tapes have the same nodes.
  template <int N, class Real, class Numbers>
  void advance(int from, int to, int k, const Numbers& numbers, Series<Real, N>* values) const;
  // Of one sample. sides: bit j set when kink j is on its negative side.
  template <int N>
  void advance(int from, int to, int k, std::uint32_t sides, Series<double, N>* values) const;

 private:
  int find(const Node& node) const;  // -1: none

  // Zero; what is no number stays none, on whichever side of a kink.
  template <class Real, class Numbers>
  static Real zero_of(const Real& x, const Numbers& numbers) {
    return numbers.choose(x == x, Real(0.0), x);
  }
  // Coefficient k of a root or a power of x at node i: `power`, or next to zero the line, and no number below.
  template <int N, class Real, class Numbers>
  Real next_to_zero(int i, int k, const Series<Real, N>& x, const Real& power, const Numbers& numbers) const {
    Real line = numbers.shift(i) * x[k];
    if (k == 0)
      line = numbers.choose(x[0] < Real(-zero_of_roots), Real(std::numeric_limits<double>::quiet_NaN()), line);
    return numbers.on_side(nodes_[i].kink, power, line);
  }

  // Plain arrays, which the kernels of packs may read without a call.
  Node nodes_[max_nodes];
  std::uint32_t depends_[max_nodes];
  std::int16_t kinks_[max_kinks];
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
Value power_of_positive(Value x, double exponent);  // of what stays above zero
Value pow(Value x, Value exponent);
Value where(Value condition, Value yes, Value no);  // yes where condition > 0

// The constants of one sample's tape, the sides of its kinks, and the functions that laws may use.
class OwnNumbers {
 public:
  OwnNumbers(const Tape& tape, std::uint32_t sides) : tape_(tape), sides_(sides) {}
  double value(int node) const { return tape_.operation(node).value; }
  double shift(int node) const { return tape_.operation(node).shift; }
  double on_side(int kink, double positive, double negative) const { return sides_ >> kink & 1U ? negative : positive; }
  static double choose(bool which, double yes, double no) { return which ? yes : no; }
  static bool any(bool which) { return which; }
  std::uint32_t sides() const { return sides_; }
  void turn(std::uint32_t sides) { sides_ = sides; }
  static double exp(double x) { return std::exp(x); }
  static double log(double x) { return std::log(x); }
  static double sqrt(double x) { return std::sqrt(x); }
  static double sin(double x) { return std::sin(x); }
  static double cos(double x) { return std::cos(x); }
  static double pow(double x, double exponent) { return std::pow(x, exponent); }

 private:
  const Tape& tape_;
  std::uint32_t sides_;
};

template <int N>
void Tape::advance(int from, int to, int k, std::uint32_t sides, Series<double, N>* values) const {
  advance(from, to, k, OwnNumbers(*this, sides), values);
}

template <int N, class Real, class Numbers>
void Tape::advance(int from, int to, int k, const Numbers& numbers, Series<Real, N>* values) const {
  const Real order(static_cast<double>(k)), over(1.0 / (k == 0 ? 1 : k));
  for (int i = from; i < to; ++i) {
    const Node& node = nodes_[i];
    const Series<Real, N>&x = values[node.a], &y = values[node.b];
    Series<Real, N>& z = values[i];
    Real sum(0.0);
    switch (node.op) {
      case Op::constant:
        z[k] = k == 0 ? numbers.value(i) : Real(0.0);
        break;
      case Op::affine:
        z[k] = numbers.value(i) * x[k];
        if (k == 0) z[k] = z[k] + numbers.shift(i);
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
        for (int j = 1; j <= k; ++j) sum = sum - y[j] * z[k - j];
        z[k] = sum / y[0];
        break;
      case Op::exp:
        for (int j = 1; j <= k; ++j) sum = sum + Real(double(j)) * x[j] * z[k - j];
        z[k] = k == 0 ? numbers.exp(x[0]) : sum * over;
        break;
      case Op::log:
        for (int j = 1; j < k; ++j) sum = sum + Real(double(j)) * z[j] * x[k - j];
        z[k] = k == 0 ? numbers.log(x[0]) : (x[k] - sum * over) / x[0];
        break;
      case Op::sqrt:
        for (int j = 1; j < k; ++j) sum = sum + z[j] * z[k - j];
        z[k] = k == 0 ? numbers.sqrt(x[0]) : (x[k] - sum) / (Real(2.0) * z[0]);
        z[k] = next_to_zero(i, k, x, z[k], numbers);
        break;
      case Op::power:
        for (int j = 1; j <= k; ++j)
          sum = sum + (Real(double(j)) * numbers.value(i) - Real(double(k - j))) * x[j] * z[k - j];
        z[k] = k == 0 ? numbers.pow(x[0], numbers.value(i)) : sum / (order * x[0]);
        if (node.kink >= 0) z[k] = next_to_zero(i, k, x, z[k], numbers);
        break;
      case Op::sin:
        for (int j = 1; j <= k; ++j) sum = sum + Real(double(j)) * x[j] * y[k - j];
        z[k] = k == 0 ? numbers.sin(x[0]) : sum * over;
        break;
      case Op::cos:
        for (int j = 1; j <= k; ++j) sum = sum + Real(double(j)) * x[j] * y[k - j];
        z[k] = k == 0 ? numbers.cos(x[0]) : -(sum * over);
        break;
      case Op::abs:
        z[k] = numbers.on_side(node.kink, x[k], -x[k]);
        break;
      case Op::positive:
        z[k] = numbers.on_side(node.kink, x[k], k == 0 ? zero_of(x[0], numbers) : Real(0.0));
        break;
      case Op::step:
      case Op::latch:
        z[k] = k > 0 ? Real(0.0) : numbers.on_side(node.kink, Real(1.0), Real(0.0)) + zero_of(x[0], numbers);
        break;
      case Op::select:
        z[k] = numbers.on_side(node.kink, x[k], y[k]);
        break;
    }
  }
}

}  // namespace freestand::dynamics
