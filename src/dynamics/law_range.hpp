// What laws can be while a block rests from one time to another, and nothing changes but the time and how long it has rested: the tape
// evaluated on ranges of numbers [Moore, Interval Analysis, 1966]. Where a floor cannot move the block against the
// least of its friction and the largest of its forces, it rests on.
#pragma once

#include <algorithm>
#include <array>

#include "dynamics/law_values.hpp"

namespace freestand::dynamics {

// All numbers between two; ends that are none: it may be no number.
struct Range {
  double lower = 0, upper = 0;

  Range() = default;
  Range(double number) : lower(number), upper(number) {}
  Range(double a, double b) : lower(std::fmin(a, b)), upper(std::fmax(a, b)) {
    if (!(std::isfinite(a) && std::isfinite(b))) lower = upper = std::numeric_limits<double>::quiet_NaN();
  }
  bool known() const { return std::isfinite(lower) && std::isfinite(upper); }
  bool has_a_sign() const { return lower > 0 || upper < 0; }
  double magnitude() const { return std::fmax(std::abs(lower), std::abs(upper)); }
};

inline Range operator-(Range x) { return {-x.upper, -x.lower}; }
inline Range operator+(Range x, Range y) { return {x.lower + y.lower, x.upper + y.upper}; }
inline Range operator-(Range x, Range y) { return x + -y; }
// Of what both operands' ends give.
inline Range over_ends(const std::array<double, 4>& ends) {
  double sum = 0;
  for (const double end : ends) sum += end;
  if (!std::isfinite(sum)) return std::numeric_limits<double>::quiet_NaN();
  const auto [least, most] = std::minmax_element(ends.begin(), ends.end());
  return {*least, *most};
}
inline Range operator*(Range x, Range y) {
  return over_ends({x.lower * y.lower, x.lower * y.upper, x.upper * y.lower, x.upper * y.upper});
}
inline Range operator/(Range x, Range y) {
  if (!y.has_a_sign()) return std::numeric_limits<double>::quiet_NaN();
  return over_ends({x.lower / y.lower, x.lower / y.upper, x.upper / y.lower, x.upper / y.upper});
}
inline bool operator==(Range x, Range y) { return x.lower == y.lower && x.upper == y.upper; }
inline bool operator<(Range x, Range y) { return x.lower < y.lower; }  // somewhere

// The constants of a tape, and its functions, all of which rise or fall throughout but sine and cosine.
class RangeNumbers {
 public:
  RangeNumbers(const Tape& tape, std::uint32_t sides) : own_(tape, sides) {}
  double value(int node) const { return own_.value(node); }
  double shift(int node) const { return own_.shift(node); }
  Range on_side(int kink, Range positive, Range negative) const {
    return own_.sides() >> kink & 1U ? negative : positive;
  }
  static Range choose(bool which, Range yes, Range no) { return which ? yes : no; }
  static Range exp(Range x) { return {std::exp(x.lower), std::exp(x.upper)}; }
  static Range log(Range x) { return {std::log(x.lower), std::log(x.upper)}; }
  static Range sqrt(Range x) { return {std::sqrt(x.lower), std::sqrt(x.upper)}; }
  static Range sin(Range x) { return circular(x, std::sin(x.lower)); }
  static Range cos(Range x) { return circular(x, std::cos(x.lower)); }
  static Range pow(Range x, double exponent) { return {std::pow(x.lower, exponent), std::pow(x.upper, exponent)}; }

 private:
  // From a value on a sine changes by no more than its argument does, and it stays within 1.
  static Range circular(Range x, double value) {
    const double by = x.upper - x.lower;
    return {std::max(value - by, -1.0), std::min(value + by, 1.0)};
  }

  OwnNumbers own_;
};

// As LawValues. Not known: somewhere a law may have no value, or passes a kink.
struct LawRange {
  Range force = 0, lift = 0, moment = 0, factor = 1;
  bool known = false;
};

inline LawRange law_range(const Rig& rig, const State& state, double from, double to, int sigma) {
  const Laws& laws = *rig.laws;
  Series<double, 0> now[max_nodes];
  inputs_at(rig, state, from, sigma, now);
  const std::uint32_t sides = laws.sides_at(now, state.sides);
  Series<Range, 0> values[max_nodes];
  for (int i = 0; i < input_count; ++i) values[i][0] = now[i][0];
  values[static_cast<int>(Input::t)][0] = {from, to};
  values[static_cast<int>(Input::rest)][0] = {state.rested(from), state.rested(to)};
  laws.tape.advance(input_count, laws.tape.size(), 0, RangeNumbers(laws.tape, sides), values);
  const auto value = [&](int node, double without) { return node < 0 ? Range(without) : values[node][0]; };
  LawRange range{value(laws.force, 0), value(laws.lift, 0), value(laws.moment, 0), value(laws.friction, 1), true};
  for (const Range& one : {range.force, range.lift, range.moment, range.factor}) range.known &= one.known();
  range.known &= range.factor.lower >= 0;
  for (int j = 0; j < laws.tape.kink_count(); ++j) {
    const int argument = laws.tape.kink_argument(j);
    const bool goes_on = laws.tape.depends(argument, Input::t) || laws.tape.depends(argument, Input::rest);
    range.known &= !goes_on || values[argument][0].has_a_sign();
  }
  return range;
}

}  // namespace freestand::dynamics
