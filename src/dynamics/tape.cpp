#include "dynamics/tape.hpp"

namespace freestand::dynamics {

Tape::Tape() {
  for (int i = 0; i < input_count; ++i) depends_[i] = 1U << i;
}

Value Tape::append(Op op, int a, int b, double value, double shift) {
  if (const int same = find(op, a, b, value, shift); same >= 0) return {this, same};
  const bool kink = op == Op::abs || op == Op::positive || op == Op::step || op == Op::latch;
  out_of_nodes_ |= size_ == max_nodes;
  out_of_kinks_ |= kink && kink_count_ == max_kinks;
  if (overflow()) return {this, 0};
  const int node = size_++;
  nodes_[node] = {op, static_cast<std::int16_t>(a), static_cast<std::int16_t>(b), value, shift};
  const bool binary = op == Op::add || op == Op::subtract || op == Op::multiply || op == Op::divide;
  depends_[node] = op == Op::constant ? 0 : depends_[a] | (binary ? depends_[b] : 0);
  if (kink) {
    nodes_[node].b = static_cast<std::int16_t>(kink_count_);
    kinks_[kink_count_++] = static_cast<std::int16_t>(node);
  }
  return {this, node};
}

int Tape::find(Op op, int a, int b, double value, double shift) const {
  const bool unary = op != Op::add && op != Op::subtract && op != Op::multiply && op != Op::divide;
  for (int i = section_; i < size_; ++i) {
    const Node& node = nodes_[i];
    if (node.op == op && node.a == a && (unary || node.b == b) && node.value == value && node.shift == shift) return i;
  }
  return -1;
}

// The two need each other's lower coefficients, so both are recorded.
Value Tape::append_circular(Op op, int a) {
  if (const int same = find(op, a, 0, 0, 0); same >= 0) return {this, same};
  const int first = size_;
  append(Op::sin, a, first + 1);
  append(Op::cos, a, first);
  return overflow() ? Value{this, 0} : Value{this, op == Op::sin ? first : first + 1};
}

Value Tape::affine(Value x, double factor, double shift) {
  const Node* of = node(x);
  if (of && of->op == Op::constant) return constant(factor * of->value + shift);
  if (of && of->op == Op::affine) return append(Op::affine, of->a, 0, factor * of->value, factor * of->shift + shift);
  return append(Op::affine, x.node, 0, factor, shift);
}

namespace {

Value affine(Value x, double factor, double shift) { return x.tape->affine(x, factor, shift); }
Value binary(Op op, Value a, Value b) { return a.tape->append(op, a.node, b.node); }
Value unary(Op op, Value x) { return x.tape->append(op, x.node, 0); }

// Null unless x is a constant.
const double* constant(Value x) {
  const Node* node = x.tape->node(x);
  return node && node->op == Op::constant ? &node->value : nullptr;
}

}  // namespace

Value operator+(Value a, Value b) {
  if (const double* c = constant(a)) return b + *c;
  if (const double* c = constant(b)) return a + *c;
  return binary(Op::add, a, b);
}
Value operator+(Value a, double b) { return affine(a, 1, b); }
Value operator+(double a, Value b) { return affine(b, 1, a); }
Value operator-(Value a) { return affine(a, -1, 0); }
Value operator-(Value a, Value b) {
  if (const double* c = constant(a)) return *c - b;
  if (const double* c = constant(b)) return a - *c;
  return binary(Op::subtract, a, b);
}
Value operator-(Value a, double b) { return affine(a, 1, -b); }
Value operator-(double a, Value b) { return affine(b, -1, a); }
Value operator*(Value a, Value b) {
  if (const double* c = constant(a)) return b * *c;
  if (const double* c = constant(b)) return a * *c;
  return binary(Op::multiply, a, b);
}
Value operator*(Value a, double b) { return affine(a, b, 0); }
Value operator*(double a, Value b) { return affine(b, a, 0); }
Value operator/(Value a, Value b) {
  if (const double* c = constant(b)) return a / *c;
  return binary(Op::divide, a, b);
}
Value operator/(Value a, double b) { return affine(a, 1 / b, 0); }
Value operator/(double a, Value b) { return a * pow(b, -1.0); }
Value exp(Value x) { return unary(Op::exp, x); }
Value log(Value x) { return unary(Op::log, x); }
Value sqrt(Value x) { return unary(Op::sqrt, x); }
Value sin(Value x) { return x.tape->append_circular(Op::sin, x.node); }
Value cos(Value x) { return x.tape->append_circular(Op::cos, x.node); }
Value tanh(Value x) { return 1.0 - 2.0 / (exp(2.0 * x) + 1.0); }
Value abs(Value x) { return unary(Op::abs, x); }
Value positive(Value x) { return unary(Op::positive, x); }
Value step(Value x) { return unary(Op::step, x); }
Value latch(Value x) { return unary(Op::latch, x); }
Value max(Value a, Value b) { return b + positive(a - b); }
Value min(Value a, Value b) { return a - positive(a - b); }

// Small whole powers are products, which have no trouble where x = 0.
Value pow(Value x, double exponent) {
  const double whole = std::abs(exponent);
  if (whole > 0 && whole <= 8 && whole == std::floor(whole)) {
    Value result = x;
    for (int i = 1; i < static_cast<int>(whole); ++i) result = result * x;
    return exponent > 0 ? result : binary(Op::divide, x.tape->constant(1), result);
  }
  if (exponent == 0) return x.tape->constant(1);
  return x.tape->append(Op::power, x.node, 0, exponent);
}

Value pow(Value x, Value exponent) { return exp(exponent * log(x)); }
Value where(Value condition, Value yes, Value no) { return no + step(condition) * (yes - no); }

}  // namespace freestand::dynamics
