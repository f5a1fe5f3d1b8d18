#include "dynamics/tape.hpp"

namespace freestand::dynamics {

Tape::Tape() {
  for (int i = 0; i < input_count; ++i) depends_[i] = 1U << i;
}

Value Tape::append(Op op, int a, int b, double value, double shift, int kink) {
  Node node{op,    static_cast<std::int16_t>(a),   static_cast<std::int16_t>(b), value,
            shift, static_cast<std::int16_t>(kink)};
  if (const int same = find(node); same >= 0) return {this, same};
  const bool bends = op == Op::abs || op == Op::positive || op == Op::step || op == Op::latch;
  out_of_nodes_ |= size_ == max_nodes;
  out_of_kinks_ |= bends && kink_count_ == max_kinks;
  if (overflow()) return {this, 0};
  const int place = size_++;
  depends_[place] = op == Op::constant ? 0 : depends_[a] | (takes_two(op) ? depends_[b] : 0);
  if (kink >= 0) depends_[place] |= depends_[kinks_[kink]];
  if (bends) {
    node.kink = static_cast<std::int16_t>(kink_count_);
    kinks_[kink_count_++] = static_cast<std::int16_t>(place);
  }
  nodes_[place] = node;
  return {this, place};
}

int Tape::find(const Node& node) const {
  for (int i = section_; i < size_; ++i) {
    const Node& same = nodes_[i];
    if (same.op == node.op && same.a == node.a && (!takes_two(node.op) || same.b == node.b) &&
        same.value == node.value && same.shift == node.shift && (node.kink < 0 || same.kink == node.kink))
      return i;
  }
  return -1;
}

// The two need each other's lower coefficients, so both are recorded.
Value Tape::append_circular(Op op, int a) {
  if (const int same = find({op, static_cast<std::int16_t>(a), 0, 0, 0, -1}); same >= 0) return {this, same};
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
Value of_two(Op op, Value a, Value b) { return a.tape->append(op, a.node, b.node); }
Value unary(Op op, Value x) { return x.tape->append(op, x.node, 0); }

// x to a power that is not whole, as a root or otherwise.
Value power(Op op, Value x, double exponent) {
  const int kink = x.tape->kink_at(x - zero_of_roots);
  const double slope = exponent > 0 ? std::pow(zero_of_roots, exponent - 1) : std::numeric_limits<double>::infinity();
  return x.tape->append(op, x.node, 0, exponent, slope, kink);
}

// Null unless x is a constant.
const double* constant(Value x) {
  const Node* node = x.tape->node(x);
  return node && node->op == Op::constant ? &node->value : nullptr;
}

}  // namespace

Value operator+(Value a, Value b) {
  if (const double* c = constant(a)) return b + *c;
  if (const double* c = constant(b)) return a + *c;
  return of_two(Op::add, a, b);
}
Value operator+(Value a, double b) { return affine(a, 1, b); }
Value operator+(double a, Value b) { return affine(b, 1, a); }
Value operator-(Value a) { return affine(a, -1, 0); }
Value operator-(Value a, Value b) {
  if (const double* c = constant(a)) return *c - b;
  if (const double* c = constant(b)) return a - *c;
  return of_two(Op::subtract, a, b);
}
Value operator-(Value a, double b) { return affine(a, 1, -b); }
Value operator-(double a, Value b) { return affine(b, -1, a); }
Value operator*(Value a, Value b) {
  if (const double* c = constant(a)) return b * *c;
  if (const double* c = constant(b)) return a * *c;
  return of_two(Op::multiply, a, b);
}
Value operator*(Value a, double b) { return affine(a, b, 0); }
Value operator*(double a, Value b) { return affine(b, a, 0); }
Value operator/(Value a, Value b) {
  if (const double* c = constant(b)) return a / *c;
  return of_two(Op::divide, a, b);
}
Value operator/(Value a, double b) { return affine(a, 1 / b, 0); }
Value operator/(double a, Value b) { return a * pow(b, -1.0); }
Value exp(Value x) { return unary(Op::exp, x); }
Value log(Value x) { return unary(Op::log, x); }
Value sqrt(Value x) { return power(Op::sqrt, x, 0.5); }
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
    return exponent > 0 ? result : of_two(Op::divide, x.tape->constant(1), result);
  }
  if (exponent == 0) return x.tape->constant(1);
  return power(Op::power, x, exponent);
}

Value power_of_positive(Value x, double exponent) { return x.tape->append(Op::power, x.node, 0, exponent); }

// As next to zero a power that is known.
Value pow(Value x, Value exponent) {
  const Value line = x / zero_of_roots * exp(exponent * std::log(zero_of_roots));
  return where(x - zero_of_roots, exp(exponent * log(x)), where(x + zero_of_roots, line, log(x)));
}
Value where(Value condition, Value yes, Value no) {
  return yes.tape->append(Op::select, yes.node, no.node, 0, 0, condition.tape->kink_at(condition));
}

}  // namespace freestand::dynamics
