// The closed step of rocking against the recurrence of its Taylor series, two orders longer, and its turn of the centre of
// mass against sine and cosine.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/keyed_random.hpp"

#define FREESTAND_ISA tested
#include "dynamics/pack/rock_step.hpp"

namespace freestand::dynamics::tested {
namespace {

using test::KeyedRandom;

constexpr double round_off = 1e-15;

struct Case {
  double angle, size;             // of the line from the pivot to the centre of mass
  double omega, gravity, a0, a1;  // times the interval; times its square over the inertia
};

Case random_case(std::uint64_t i, double shortest, double longest) {
  KeyedRandom random(190, i);
  const double size = random.log_uniform(0.3, 3), step = random.log_uniform(shortest, longest);  // h p
  const double of_gravity = step * step / size;
  return {random.uniform(-1.5, 1.5),          size,
          step * random.uniform(-1, 1),       of_gravity,
          of_gravity * random.uniform(-1, 1), of_gravity * random.uniform(-0.1, 0.1)};
}

template <class Series>
Series expanded(const Case& c) {
  Series y;
  y.theta[0] = Pack(0.1);
  y.omega[0] = Pack(c.omega);
  y.rx[0] = Pack(-c.size * std::cos(c.angle));
  y.ry[0] = Pack(c.size * std::sin(c.angle));
  y.expand(Pack(c.gravity), Pack(c.a0), Pack(c.a1));
  return y;
}

TEST(RockStep, HasTheCoefficientsOfTheSeries) {
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Case c = random_case(i, 0.3, 1);  // long steps, where every order counts
    const auto step = expanded<RockStep>(c);
    const auto series = expanded<RockSeries<8>>(c);
    for (int k = 0; k <= RockStep::order; ++k)
      EXPECT_NEAR(step.omega_term(k).get(0), series.omega[k].get(0), 20 * round_off) << i << " " << k;
  }
}

TEST(RockStep, EndsWhereTheSeriesDoes) {
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Case c = random_case(i, 0.001, 0.02);
    const auto step = expanded<RockStep>(c);
    const auto series = expanded<RockSeries<8>>(c);
    const RockEnd a = step.end(Pack(0.0)), b = series.end(Pack(0.0));
    EXPECT_NEAR(a.theta.get(0), b.theta.get(0), round_off) << i;
    EXPECT_NEAR(a.omega.get(0), b.omega.get(0), round_off) << i;
    const double angle = c.angle + a.theta.get(0) - 0.1;
    EXPECT_NEAR(a.rx.get(0), -c.size * std::cos(angle), c.size * round_off) << i;
    EXPECT_NEAR(a.ry.get(0), c.size * std::sin(angle), c.size * round_off) << i;
  }
}

// Polynomials whose root lies where Halley's steps come near it by a constant share each: far out on a flat one, and
// beside a second root.
TEST(BracketedRoot, IsFoundWhereStepsConvergeSlowly) {
  const auto root = [](const std::vector<double>& c, double lo, double hi, double guess) {
    Pack p[10];
    for (std::size_t k = 0; k < 10; ++k) p[k] = Pack(k < c.size() ? c[k] : 0.0);
    return bracketed_root<9>(p, Pack(1.0), Pack(lo), Pack(hi), Pack(guess), Pack(1.0) > Pack(0.0)).get(0);
  };
  for (const double at : {0.5, 0.1, 0.01, 1e-3})  // at^9 - x^9
    EXPECT_NEAR(root({std::pow(at, 9), 0, 0, 0, 0, 0, 0, 0, 0, -1}, 0, 1, 1), at, 1e-12) << at;
  for (const double apart : {1e-2, 1e-4, 1e-5}) {  // (r - x)(x - r + apart): round-off of 1e-16 moves r by 1e-16/apart
    const double r = 0.3, other = r - apart;
    EXPECT_NEAR(root({-r * other, r + other, -1}, r - 0.5 * apart, 1, 1), r, 1e-15 / apart) << apart;
  }
}

}  // namespace
}  // namespace freestand::dynamics::tested
