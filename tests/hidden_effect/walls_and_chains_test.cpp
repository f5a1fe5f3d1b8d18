// The generator's walls and chains against what can be written down.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "hidden_effect/generator.hpp"

namespace freestand::test::walls_and_chains_test {
namespace {

constexpr double g = standard_gravity_mps2, dt_s = 0.005;

// a(t) over `samples` steps, down to zero in the next.
FloorSamples pushed(double a_mps2, int samples, double end_s) {
  FloorSamples floor{dt_s, std::vector<double>(static_cast<std::size_t>(std::lround(end_s / dt_s)) + 1, 0.0), {}};
  std::fill_n(floor.horizontal_mps2.begin(), samples + 1, a_mps2);
  return floor;
}

TruthEffect wall(double gap_m, double restitution) {
  return {"wall_impact", {{"gap_m", gap_m}, {"restitution", restitution}}};
}

// From rest to the wall at -d in the time sqrt(2 d/k), k = a - mu g; back at e sqrt(2 d k), against a + mu g.
TEST(Walls, TheUprightBlockComesBackAtTheRestitutionTimesItsSpeed) {
  const double mu = 0.2, a = 4, d = 0.05, e = 0.6, k = a - mu * g;
  const Truth truth = rectangular_truth(1, 0.8, mu, {wall(-d, e)});
  const TruthHistory h = simulate(truth, pushed(a, 200, 1));
  const double strike_s = std::sqrt(2 * d / k), back = e * std::sqrt(2 * d * k);
  const std::size_t i = static_cast<std::size_t>(std::ceil(strike_s / dt_s)) + 1;
  const double since_s = static_cast<double>(i) * dt_s - strike_s;
  ASSERT_LT(since_s, back / (a + mu * g));
  EXPECT_NEAR(h.slip_m[i], -d + back * since_s - 0.5 * (a + mu * g) * since_s * since_s, 1e-7);
  for (const double slip : h.slip_m) EXPECT_GE(slip, -d - 1e-12);
  for (const double turned : h.rotation_rad) EXPECT_EQ(turned, 0);
}

// The upper edge reaches the wall, 2 h sin(theta) = d with the corner where it stood. Turned back about its corner the block
// would pull at the floor: the impulse at the edge, y over the centre of mass, is alone, and the block hops.
//   v = x' + y q -> -e v,  so q+ = q - (1 + e) v y/(k^2 + y^2), and theta goes on at that rate in the air.
TEST(Walls, TheUpperEdgeOfABlockThatRocksThrowsItBack) {
  const double width = 0.4, height = 1.6, d = 0.05, e = 0.5, b = 0.5 * width, h = 0.5 * height, a = -3.2;
  const Truth truth = rectangular_truth(width, height, 1.2, {wall(d, e)});
  const TruthHistory history = simulate(truth, pushed(a, 200, 1), 2.5e-6);
  const double theta = std::asin(d / height), c = std::cos(theta), s = std::sin(theta), k2 = truth.gyration2_m2;
  // Rate there, from the energy of rocking about the corner: (k^2 + b^2 + h^2) q^2/2 = -a x - g y.
  const double x = h * s - b * (c - 1), y_rise = b * s + h * (c - 1);
  const double q = std::sqrt(2 * (-a * x - g * y_rise) / (k2 + b * b + h * h));
  const double y = h * c - b * s, v = 2 * h * c * q, after = q - (1 + e) * v * y / (k2 + y * y);
  std::size_t i = 1;
  while (i + 3 < history.deeds.size() && !(history.deeds[i] & struck_by_upper_edge)) ++i;
  ASSERT_TRUE(history.deeds[i + 2] & flew);
  EXPECT_NEAR((history.rotation_rad[i + 2] - history.rotation_rad[i]) / (2 * dt_s), after, 1e-5);
}

// Tipping needs a > g b/h; friction holds the base. Where it has come to rest, xi + 2 h sin(theta) = d, it stays to the last bit.
TEST(Walls, ABlockThatLeansDoesNotCreep) {
  const double d = 0.04, width = 0.4, height = 1.6;
  const Truth truth = rectangular_truth(width, height, 0.8, {wall(d, 0)});
  const TruthHistory h = simulate(truth, pushed(-5, 600, 3));
  const double theta = h.rotation_rad[300], xi = h.slip_m[300] - 0.5 * width * (1 - std::cos(theta));
  EXPECT_GT(theta, 0.01);
  EXPECT_NEAR(xi + height * std::sin(theta), d, 1e-9);
  for (std::size_t i = 301; i <= 600; ++i) {
    ASSERT_TRUE(h.deeds[i] & leaned);
    ASSERT_EQ(h.rotation_rad[i], theta);
    ASSERT_EQ(h.slip_m[i], h.slip_m[300]);
  }
}

// A ladder, but pushed: what it has of energy in the frame of the floor, a x being the potential of the floor's
// acceleration, goes into the friction of its base, mu(t) N |d xi| with N = g + y''.
TEST(Walls, ABlockThatSlidesAlongTheWallKeepsItsEnergy) {
  const double width = 0.3, height = 1.6, d = 0.5, a = -3, mu = 0.9, fades_s = 0.3, b = 0.5 * width,
               half = 0.5 * height;
  const Truth truth =
      rectangular_truth(width, height, mu, {wall(d, 0), {"friction_heating", {{"rise", -1}, {"time_s", fades_s}}}});
  const TruthHistory h = simulate(truth, pushed(a, 800, 4), 5e-6);
  const auto theta = [&](std::size_t i) { return h.rotation_rad[i]; };
  const auto y = [&](std::size_t i) { return b * std::sin(theta(i)) + half * std::cos(theta(i)); };
  const auto x = [&](std::size_t i) {
    return b * (1 - std::cos(theta(i))) - half * std::sin(theta(i));
  };  // the edge stays
  const auto energy = [&](std::size_t i) {
    const double q = (theta(i + 1) - theta(i - 1)) / (2 * dt_s), vx = (x(i + 1) - x(i - 1)) / (2 * dt_s),
                 vy = (y(i + 1) - y(i - 1)) / (2 * dt_s);
    return 0.5 * (vx * vx + vy * vy + truth.gyration2_m2 * q * q) + g * y(i) + a * x(i);
  };
  const auto friction = [&](std::size_t i) {
    const double t = static_cast<double>(i) * dt_s, press = g + (y(i + 1) - 2 * y(i) + y(i - 1)) / (dt_s * dt_s);
    return mu * std::exp(-t / fades_s) * press * height * (std::sin(theta(i - 1)) - std::sin(theta(i + 1))) / 2;
  };
  constexpr std::size_t from = 140, to = 195;  // it leans from 0.68 to 0.98 s
  double lost = 0, least = energy(from), most = least;
  for (std::size_t i = from + 1; i < to; ++i) {
    ASSERT_TRUE(h.deeds[i] & leaned);
    lost += friction(i);
    EXPECT_NEAR(energy(i) + lost, energy(from), 1e-3) << i;
    least = std::min(least, energy(i) - g * y(i)), most = std::max(most, energy(i) - g * y(i));
  }
  EXPECT_GT(most - least, 0.3);  // what went from one kind into the other
}

TEST(Walls, ABlockThatIsPressedOnATouchingWallNeitherMovesNorTips) {
  const Truth truth = rectangular_truth(0.4, 1.6, 0.5, {wall(0, 0.4)});
  const TruthHistory h = simulate(truth, pushed(-9, 200, 2));
  EXPECT_EQ(h.peak_slip_m, 0);
  EXPECT_EQ(h.peak_rotation_rad, 0);
  EXPECT_GT(simulate(truth, pushed(4, 200, 2)).peak_rotation_rad, 0.01);  // away from the wall it tips
}

// The floor falls away under it (v = -2 g) while it goes to the wall with the speed w: back with e w, and nothing turns.
TEST(Walls, AFlatBlockComesBackInFlightToo) {
  const double a = 6, mu = 0.1, e = 0.7, d = 0.1;
  const Truth truth = rectangular_truth(1, 0.8, mu, {wall(-d, e), {"vertical_shaking", {}}});
  FloorSamples floor = pushed(a, 20, 0.3);
  floor.vertical_mps2.assign(floor.horizontal_mps2.size(), 0.0);
  std::fill(floor.vertical_mps2.begin() + 21, floor.vertical_mps2.end(), -2 * g);
  const TruthHistory h = simulate(truth, floor);
  // In flight from the half of the step in which g' falls from g to -g on.
  const std::size_t from = 25, to = 59;
  ASSERT_TRUE(h.deeds[from] & flew);
  const double w = (h.slip_m[from] - h.slip_m[from - 1]) / dt_s;
  const double strike_s = static_cast<double>(from) * dt_s + (-d - h.slip_m[from]) / w;
  EXPECT_NEAR(h.slip_m[to], -d - e * w * (static_cast<double>(to) * dt_s - strike_s), 1e-7);
  EXPECT_EQ(h.rotation_rad[to], 0);
}

// u'' = -(k_0 - W^2 (|u| - slack)) beyond the slack, k_0 = a - mu g: a cosine about slack + k_0/W^2.
TEST(Chains, HoldASlidingBlockAsASpringDoesUntilTheyBreak) {
  const double mu = 0.1, a = 3, slack = 0.02, stiffness = 400, strength = 3, k = a - mu * g, W = std::sqrt(stiffness);
  const auto chained = [&](double strength_mps2) {
    return rectangular_truth(4, 0.5, mu,
                             {{"chain",
                               {{"side", -1},
                                {"height_m", 0.3},
                                {"slack_m", slack},
                                {"stiffness_per_s2", stiffness},
                                {"strength_mps2", strength_mps2}}}});
  };
  const FloorSamples floor = pushed(a, 200, 1);
  const double taut_s = std::sqrt(2 * slack / k), v = k * taut_s;
  const auto stretch = [&](double t) { return v / W * std::sin(W * t) + k / stiffness * (1 - std::cos(W * t)); };
  const TruthHistory whole = simulate(chained(1e3), floor);
  const std::size_t i = static_cast<std::size_t>(taut_s / dt_s) + 12;
  EXPECT_NEAR(whole.slip_m[i], -slack - stretch(static_cast<double>(i) * dt_s - taut_s), 1e-7);

  double low = 0, high = 0.05;  // when it breaks after it is taut, by bisection
  for (int round = 0; round < 60; ++round)
    (stiffness * stretch(0.5 * (low + high)) < strength ? low : high) = 0.5 * (low + high);
  const double broken_s = taut_s + low, at = slack + strength / stiffness;
  const double speed = v * std::cos(W * low) + k / W * std::sin(W * low),
               since = static_cast<double>(i) * dt_s - broken_s;
  ASSERT_GT(since, 0);
  const TruthHistory broken = simulate(chained(strength), floor);
  EXPECT_NEAR(broken.slip_m[i], -at - speed * since - 0.5 * k * since * since, 2e-7);
  EXPECT_TRUE(broken.deeds[i] & broke_the_chain);
}

}  // namespace
}  // namespace freestand::test::walls_and_chains_test
