// The tape: Taylor coefficients of every operation against series known in closed form, and what is folded away.
#include "dynamics/tape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace freestand::dynamics::tape_test {
namespace {

constexpr int N = 8;

// Coefficients of f(x) where x = x0 + x1 tau, against f's derivatives: f^(k)(x0) x1^k / k!.
void expect_series(const std::function<Value(Value)>& f, const std::function<double(double, int)>& derivative,
                   double x0, double x1, std::uint32_t sides = 0) {
  Tape tape;
  const Value result = f(tape.input(Input::u));
  Series<double, N> values[max_nodes];
  for (int k = 0; k <= N; ++k) values[0][k] = k == 0 ? x0 : k == 1 ? x1 : 0;
  for (int k = 0; k <= N; ++k) tape.advance(input_count, tape.size(), k, sides, values);
  double factor = 1;
  for (int k = 0; k <= N; ++k) {
    const double expected = derivative(x0, k) * factor;
    EXPECT_NEAR(values[result.node][k], expected, 1e-12 * (1 + std::abs(expected))) << k;
    factor *= x1 / (k + 1);
  }
}

double falling(double n, int k) {
  double product = 1;
  for (int i = 0; i < k; ++i) product *= n - i;
  return product;
}

TEST(Tape, OperationsHaveTheirTaylorSeries) {
  expect_series([](Value x) { return exp(2.0 * x); }, [](double x, int k) { return std::pow(2, k) * std::exp(2 * x); },
                0.3, 1.7);
  expect_series([](Value x) { return log(x); },
                [](double x, int k) { return k == 0 ? std::log(x) : -falling(-1, k - 1) * -1 * std::pow(x, -k); }, 1.3,
                0.4);
  for (const double n : {0.5, -0.7, 3.0, -2.0, 2.6})
    expect_series([n](Value x) { return pow(x, n); },
                  [n](double x, int k) { return falling(n, k) * std::pow(x, n - k); }, 1.3, -0.4);
  expect_series([](Value x) { return sqrt(x); }, [](double x, int k) { return falling(0.5, k) * std::pow(x, 0.5 - k); },
                1.3, 0.7);
  expect_series([](Value x) { return sin(x); }, [](double x, int k) { return std::sin(x + k * std::acos(-1) / 2); },
                0.3, 1.7);
  expect_series([](Value x) { return cos(x); }, [](double x, int k) { return std::cos(x + k * std::acos(-1) / 2); },
                0.3, 1.7);
  expect_series([](Value x) { return 1.0 / (x * x - x / 2.0); },  // 2/(x - 1/2) - 2/x
                [](double x, int k) { return 2 * falling(-1, k) * (std::pow(x - 0.5, -1 - k) - std::pow(x, -1 - k)); },
                1.3, 0.4);
  expect_series([](Value x) { return x * exp(x); }, [](double x, int k) { return (x + k) * std::exp(x); }, 0.3, 1.7);
  expect_series([](Value x) { return tanh(x) * (exp(2.0 * x) + 1.0); },
                [](double x, int k) { return std::pow(2, k) * std::exp(2 * x) - (k == 0); }, 0.3, 1.1);
}

TEST(Tape, KinksAreSmoothOnEitherSide) {
  const auto line = [](double slope) {
    return [slope](double x, int k) { return k == 0 ? slope * x : k == 1 ? slope : 0.0; };
  };
  expect_series([](Value x) { return abs(x); }, line(1), 0.3, 2);
  expect_series([](Value x) { return abs(x); }, line(-1), -0.3, 2, 1);
  expect_series([](Value x) { return positive(x); }, line(0), -0.3, 2, 1);
  expect_series([](Value x) { return max(x, 3.0 * x); }, line(3), 0.3, 2, 1);  // side of x - 3 x
  expect_series([](Value x) { return min(x, 3.0 * x); }, line(1), 0.3, 2, 1);
  expect_series([](Value x) { return where(x, 2.0 * x, 5.0 * x); }, line(2), 0.3, 2);
  expect_series([](Value x) { return where(x, 2.0 * x, 5.0 * x); }, line(5), -0.3, 2, 1);
}

TEST(Tape, ConstantsFoldIntoOneNode) {
  Tape tape;
  const Value x = tape.input(Input::v);
  const int before = tape.size();
  const Value y = 1.0 - 2.0 * (3.0 - (x + 4.0) / 5.0);
  EXPECT_EQ(tape.node(y)->op, Op::affine);
  EXPECT_DOUBLE_EQ(tape.node(y)->value, 0.4);
  EXPECT_DOUBLE_EQ(tape.node(y)->shift, 1 - 2 * (3 - 0.8));
  EXPECT_EQ(tape.node(y)->a, x.node);
  EXPECT_GT(tape.size(), before);
  EXPECT_EQ(tape.node(tape.constant(3) * tape.constant(4) + tape.constant(1))->op, Op::constant);
  EXPECT_TRUE(tape.depends(y.node, Input::v));
  EXPECT_FALSE(tape.depends(y.node, Input::u));
}

TEST(Tape, OverflowIsToldAndHarmless) {
  Tape tape;
  Value x = tape.input(Input::u);
  for (int i = 0; i < 2 * max_nodes; ++i) x = x * x;
  EXPECT_TRUE(tape.overflow());
  EXPECT_LE(tape.size(), max_nodes);
  Tape kinks;
  Value y = kinks.input(Input::u);
  for (int i = 0; i < 2 * max_kinks; ++i) y = abs(y);
  EXPECT_TRUE(kinks.overflow());
}

}  // namespace
}  // namespace freestand::dynamics::tape_test
