#include "dynamics/roots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "dynamics/single_root.hpp"
#include "dynamics/tape.hpp"

namespace freestand::dynamics::detail {
namespace {

template <int N>
using Polynomial = std::array<double, N + 1>;  // coefficients of 1, x ... x^N; x = 0 ... 1
constexpr int deepest = 45;  // halvings, after which an interval is shorter than the resolution of time

double evaluate(const double* c, int order, double x) {
  double value = c[order];
  for (int k = order - 1; k >= 0; --k) value = value * x + c[k];
  return value;
}

double magnitude(const double* c, int order, double h) {
  double sum = 0;
  for (int k = order; k >= 0; --k) sum = sum * h + std::abs(c[k]);
  return sum;
}

// The same polynomial about x = 1.
template <int N>
void shift_by_one(Polynomial<N>& c) {
#pragma GCC unroll 16
  for (int i = 0; i < N; ++i)
#pragma GCC unroll 16
    for (int k = N - 1; k >= i; --k) c[k] += c[k + 1];
}

// Changes of sign among the coefficients of (1 + x)^N c(1/(1 + x)): as many as c has roots on (0, 1), or an even number
// more (Descartes' rule; Collins & Akritas 1976).
template <int N>
int sign_changes(const Polynomial<N>& c) {
  Polynomial<N> d;
  std::reverse_copy(c.begin(), c.end(), d.begin());
  shift_by_one<N>(d);
  int changes = 0;
  double last = d[N];
  for (int k = N - 1; k >= 0; --k) {
    if (d[k] == 0) continue;
    changes += (d[k] > 0) != (last > 0);
    last = d[k];
  }
  return changes;
}

// First root of a polynomial on (0, 1], positive at 0.
template <int N>
class Search {
 public:
  explicit Search(const Polynomial<N>& c) : noise_(1e-15 * magnitude(c.data(), N, 1)) {}

  // False: there is none.
  bool find(const Polynomial<N>& c, int depth, double& x) {
    const int changes = sign_changes<N>(c);
    if (changes == 0 || magnitude(c.data(), N, 1) <= noise_ || --intervals_left_ < 0) return false;
    if (changes == 1 || depth == deepest) {
      if (evaluate(c.data(), N, 1) > 0) return false;
      x = only_root<N, OwnNumbers>(c.data(), true);
      return true;
    }
    Polynomial<N> half = c;
    double scale = 1;
    for (int k = 1; k <= N; ++k) half[k] *= scale *= 0.5;
    if (find(half, depth + 1, x)) {
      x *= 0.5;
      return true;
    }
    shift_by_one<N>(half);
    x = 0;
    if (half[0] > 0 && !find(half, depth + 1, x)) return false;
    x = 0.5 + 0.5 * x;
    return true;
  }

 private:
  double noise_;               // what is all below this is zero, not a row of roots
  int intervals_left_ = 4000;  // no polynomial of this order with a sign needs as many
};

template <int N>
bool first_root_of(const double* c, double h, double& tau) {
  Polynomial<N> unit;
  double scale = 1, sum = 0;
  for (int k = 0; k <= N; ++k, scale *= h) sum += std::abs(unit[k] = c[k] * scale);
  if (!std::isfinite(sum)) return false;
  if (falls_once<N>(unit.data()))
    tau = only_root<N, OwnNumbers>(unit.data(), true);
  else if (!Search<N>(unit).find(unit, 0, tau))
    return false;
  tau *= h;
  return true;
}

using Solve = bool (*)(const double* c, double h, double& tau);
template <int... N>
constexpr std::array<Solve, sizeof...(N)> of_each_order(std::integer_sequence<int, N...>) {
  return {first_root_of<N + 1>...};
}
constexpr auto solve = of_each_order(std::make_integer_sequence<int, max_root_order>{});

// Index of the first coefficient that is not zero within the tolerance, one that is no number included; order + 1 when
// there is none.
int leading(const double* c, int order, ZeroTolerance zero) {
  double tolerance = zero.acceleration;
  for (int k = 0; k <= order; ++k) {
    if (k < zero.level ? c[k] != 0 : !(std::abs(c[k]) <= tolerance)) return k;
    if (k >= zero.level) tolerance *= 1000;  // rates of accelerations: over a millisecond
  }
  return order + 1;
}

}  // namespace

int sign_after(const double* c, int order, ZeroTolerance zero) {
  const int first = leading(c, order, zero);
  if (first > order) return 0;
  return c[first] > 0 ? 1 : -1;
}

bool first_root(const double* c, int order, double h, ZeroTolerance zero, double& tau) {
  const int first = leading(c, order, zero);
  if (first > order) return false;
  if (!(c[first] > 0)) {
    tau = 0;
    return true;
  }
  if (first == order) return false;
  return solve[order - first - 1](c + first, h, tau);
}

int turns(const double* c, int order, double h, double* values) {
  std::array<double, max_root_order + 1> y{}, slope{};
  std::copy(c, c + order + 1, y.begin());
  // Walk from one stationary point to the next.
  int found = 0;
  while (found < order && h > 0) {
    for (int k = 0; k < order; ++k) slope[k] = (k + 1) * y[k + 1];
    if (sign_after(slope.data(), order - 1, {0, 0.0}) < 0)
      for (double& coefficient : slope) coefficient = -coefficient;
    double tau = 0;
    if (!first_root(slope.data(), order - 1, h, {0, 0.0}, tau) || tau <= 0 || tau >= h) break;
    for (int i = 0; i < order; ++i)  // about tau
      for (int k = order - 1; k >= i; --k) y[k] += tau * y[k + 1];
    y[1] = 0;
    h -= tau;
    values[found++] = y[0];
  }
  return found;
}

namespace {

// The largest size(y) over [0, h], or floor. size: y itself, or |y|.
template <class Size>
double largest(const double* c, int order, double h, double floor, Size size) {
  double peak = std::max({floor, size(c[0]), size(evaluate(c, order, h))}), values[max_root_order];
  for (int i = turns(c, order, h, values) - 1; i >= 0; --i) peak = std::max(peak, size(values[i]));
  return peak;
}

}  // namespace

double max_abs(const double* c, int order, double h, double floor) {
  return largest(c, order, h, floor, [](double y) { return std::abs(y); });
}

double max_of(const double* c, int order, double h, double floor) {
  return largest(c, order, h, floor, [](double y) { return y; });
}

}  // namespace freestand::dynamics::detail
