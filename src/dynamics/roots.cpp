#include "dynamics/roots.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace freestand::dynamics::detail {
namespace {

using Coefficients = std::array<double, max_root_order + 1>;
constexpr int deepest = 45;  // halvings, after which an interval is shorter than the resolution of time

double evaluate(const Coefficients& c, int order, double tau) {
  double value = c[order];
  for (int k = order - 1; k >= 0; --k) value = value * tau + c[k];
  return value;
}

// The same polynomial about `by`.
Coefficients shifted(Coefficients c, int order, double by) {
  for (int i = 0; i < order; ++i)
    for (int k = order - 1; k >= i; --k) c[k] += by * c[k + 1];
  return c;
}

Coefficients derivative(const Coefficients& c, int order) {
  Coefficients d{};
  for (int k = 0; k < order; ++k) d[k] = (k + 1) * c[k + 1];
  return d;
}

// True when the sign of c[0] is proven on [0, h].
bool keeps_sign(const Coefficients& c, int order, double h) {
  double bound = 0;
  for (int k = order; k >= 1; --k) bound = (bound + std::abs(c[k])) * h;
  return std::abs(c[0]) > bound;
}

// Root of a monotone polynomial with c(lo) > 0 >= c(hi): Newton, kept inside the bracket by bisection.
double monotone_root(const Coefficients& c, int order, double lo, double hi) {
  const Coefficients slope = derivative(c, order);
  double x = 0.5 * (lo + hi);
  for (int i = 0; i < 100; ++i) {
    const double f = evaluate(c, order, x);
    (f > 0 ? lo : hi) = x;
    const double newton = x - f / evaluate(slope, order, x);
    const double next = newton > lo && newton < hi ? newton : 0.5 * (lo + hi);
    if (next == x || next <= lo || next >= hi) return next == x ? x : hi;
    x = next;
  }
  return hi;
}

double magnitude(const Coefficients& c, int order, double h) {
  double sum = 0;
  for (int k = order; k >= 0; --k) sum = sum * h + std::abs(c[k]);
  return sum;
}

// First root of a polynomial on (0, h], positive at 0.
class Search {
 public:
  Search(const Coefficients& c, int order, double h) : order_(order), noise_(1e-15 * magnitude(c, order, h)) {}

  // False: there is none.
  bool find(const Coefficients& c, double h, int depth, double& tau) {
    if (keeps_sign(c, order_, h) || magnitude(c, order_, h) <= noise_ || --intervals_left_ < 0) return false;
    const bool monotone = keeps_sign(derivative(c, order_), order_ - 1, h);
    if (monotone || depth == deepest) {
      if (evaluate(c, order_, h) > 0) return false;
      tau = monotone_root(c, order_, 0, h);
      return true;
    }
    const double half = 0.5 * h;
    if (find(c, half, depth + 1, tau)) return true;
    const Coefficients right = shifted(c, order_, half);
    if (right[0] <= 0) {
      tau = half;
      return true;
    }
    if (!find(right, half, depth + 1, tau)) return false;
    tau += half;
    return true;
  }

 private:
  int order_;
  double noise_;               // what is all below this is zero, not a row of roots
  int intervals_left_ = 4000;  // no polynomial of this order with a sign needs as many
};

// Index of the first coefficient that is not zero within the tolerance; order + 1 when there is none.
int leading(const double* c, int order, ZeroTolerance zero) {
  double tolerance = zero.acceleration;
  for (int k = 0; k <= order; ++k) {
    if (k < zero.level ? c[k] != 0 : std::abs(c[k]) > tolerance) return k;
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
  Coefficients deflated{};
  std::copy(c + first, c + order + 1, deflated.begin());
  const int deflated_order = order - first;
  if (deflated_order == 0) return false;
  if (!std::isfinite(magnitude(deflated, deflated_order, h))) return false;
  return Search(deflated, deflated_order, h).find(deflated, h, 0, tau);
}

double max_abs(const double* c, int order, double h, double floor) {
  Coefficients y{};
  std::copy(c, c + order + 1, y.begin());
  double peak = std::max({floor, std::abs(y[0]), std::abs(evaluate(y, order, h))});
  // Walk from one stationary point to the next.
  for (int turn = 0; turn < order && h > 0; ++turn) {
    Coefficients slope = derivative(y, order);
    if (sign_after(slope.data(), order - 1, {0, 0.0}) < 0)
      for (double& coefficient : slope) coefficient = -coefficient;
    double tau = 0;
    if (!first_root(slope.data(), order - 1, h, {0, 0.0}, tau) || tau <= 0 || tau >= h) break;
    y = shifted(y, order, tau);
    y[1] = 0;
    h -= tau;
    peak = std::max(peak, std::abs(y[0]));
  }
  return peak;
}

}  // namespace freestand::dynamics::detail
