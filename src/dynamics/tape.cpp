#include "dynamics/tape.hpp"

namespace freestand::dynamics {

Tape::Tape() {
  for (int i = 0; i < input_count; ++i) depends_[at(i)] = 1U << i;
}

Value Tape::append(Op op, int a, int b, double value) {
  const bool kink = op == Op::abs || op == Op::positive || op == Op::step;
  if (size_ == max_nodes || (kink && kink_count_ == max_kinks)) {
    overflow_ = true;
    return {this, 0};
  }
  const int node = size_++;
  nodes_[at(node)] = {op, static_cast<std::int16_t>(a), static_cast<std::int16_t>(b), value};
  const bool binary = op == Op::add || op == Op::subtract || op == Op::multiply || op == Op::divide;
  depends_[at(node)] = op == Op::constant ? 0 : depends_[at(a)] | (binary ? depends_[at(b)] : 0);
  if (kink) {
    nodes_[at(node)].b = static_cast<std::int16_t>(kink_count_);
    kinks_[at(kink_count_++)] = static_cast<std::int16_t>(node);
  }
  return {this, node};
}

// The two need each other's lower coefficients, so both are recorded.
Value Tape::append_circular(Op op, int a) {
  const int first = size_;
  append(Op::sin, a, first + 1);
  append(Op::cos, a, first);
  return overflow_ ? Value{this, 0} : Value{this, op == Op::sin ? first : first + 1};
}

namespace {
Value constant(Value like, double value) { return like.tape->constant(value); }
Value binary(Op op, Value a, Value b) { return a.tape->append(op, a.node, b.node); }
Value unary(Op op, Value x) { return x.tape->append(op, x.node, 0); }
}  // namespace

Value operator+(Value a, Value b) { return binary(Op::add, a, b); }
Value operator+(Value a, double b) { return a + constant(a, b); }
Value operator+(double a, Value b) { return constant(b, a) + b; }
Value operator-(Value a) { return 0.0 - a; }
Value operator-(Value a, Value b) { return binary(Op::subtract, a, b); }
Value operator-(Value a, double b) { return a - constant(a, b); }
Value operator-(double a, Value b) { return constant(b, a) - b; }
Value operator*(Value a, Value b) { return binary(Op::multiply, a, b); }
Value operator*(Value a, double b) { return a * constant(a, b); }
Value operator*(double a, Value b) { return constant(b, a) * b; }
Value operator/(Value a, Value b) { return binary(Op::divide, a, b); }
Value operator/(Value a, double b) { return a / constant(a, b); }
Value operator/(double a, Value b) { return constant(b, a) / b; }
Value exp(Value x) { return unary(Op::exp, x); }
Value log(Value x) { return unary(Op::log, x); }
Value sqrt(Value x) { return unary(Op::sqrt, x); }
Value sin(Value x) { return x.tape->append_circular(Op::sin, x.node); }
Value cos(Value x) { return x.tape->append_circular(Op::cos, x.node); }
Value tanh(Value x) { return 1.0 - 2.0 / (exp(2.0 * x) + 1.0); }
Value abs(Value x) { return unary(Op::abs, x); }
Value positive(Value x) { return unary(Op::positive, x); }
Value step(Value x) { return unary(Op::step, x); }
Value max(Value a, Value b) { return b + positive(a - b); }
Value min(Value a, Value b) { return a - positive(a - b); }

// Small whole powers are products, which have no trouble where x = 0.
Value pow(Value x, double exponent) {
  const double whole = std::abs(exponent);
  if (whole > 0 && whole <= 8 && whole == std::floor(whole)) {
    Value result = x;
    for (int i = 1; i < static_cast<int>(whole); ++i) result = result * x;
    return exponent > 0 ? result : 1.0 / result;
  }
  if (exponent == 0) return constant(x, 1.0);
  return x.tape->append(Op::power, x.node, 0, exponent);
}

Value pow(Value x, Value exponent) { return exp(exponent * log(x)); }
Value where(Value condition, Value yes, Value no) { return no + step(condition) * (yes - no); }

}  // namespace freestand::dynamics
