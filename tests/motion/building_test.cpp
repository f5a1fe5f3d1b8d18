#include "motion/building.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <freestand/error.hpp>
#include <numeric>

#include "base/units.hpp"

namespace freestand::motion {
namespace {

Building alike(int storeys, double period_s) {
  Building building;
  building.storeys.resize(static_cast<std::size_t>(storeys));
  building.period_s = period_s;
  return building;
}

std::string refusal(const Building& building) {
  try {
    modes(building);
  } catch (const Error& error) {
    EXPECT_EQ(error.exit(), Exit::usage);
    return error.what();
  }
  return "";
}

// Equal masses on equal springs (Rayleigh, Theory of Sound, section 120): w_j = 2 sqrt(k/m) sin((2j - 1) pi / (2 (2n + 1))), and
// phi_ij = sin((2j - 1) i pi / (2n + 1)).
TEST(Building, EqualStoreysHaveTheModesOfAChainOfMasses) {
  for (const int n : {1, 2, 5, 12}) {
    const std::vector<Mode> found = modes(alike(n, 0.8));
    ASSERT_EQ(found.size(), static_cast<std::size_t>(n));
    const auto angle = [&](int j) { return (2 * j - 1) * pi / (2.0 * (2 * n + 1)); };
    for (int j = 1; j <= n; ++j) {
      const Mode& mode = found[static_cast<std::size_t>(j) - 1];
      EXPECT_NEAR(mode.period_s(), 0.8 * std::sin(angle(1)) / std::sin(angle(j)), 1e-12) << n << " " << j;
      double sum = 0, squares = 0;
      for (int i = 1; i <= n; ++i)
        sum += std::sin(2 * i * angle(j)), squares += std::pow(std::sin(2 * i * angle(j)), 2);
      for (int i = 0; i <= n; ++i)
        EXPECT_NEAR(mode.floors[static_cast<std::size_t>(i)], sum / squares * std::sin(2 * i * angle(j)), 1e-11);
      EXPECT_NEAR(mode.mass_share, sum * sum / squares / n, 1e-12);
      EXPECT_EQ(mode.damping, 0.05);
    }
  }
}

TEST(Building, MassesAndStiffnessesGiveThePeriods) {
  Building building;
  building.storeys = {{.mass_kg = 2e5, .height_m = {}, .stiffness_npm = 3e8}};
  EXPECT_NEAR(modes(building).front().period_s(), 2 * pi * std::sqrt(2e5 / 3e8), 1e-14);
  // Two storeys: w^4 m1 m2 - w^2 (m1 k2 + m2 k1 + m2 k2) + k1 k2 = 0.
  const double m1 = 2e5, m2 = 1e5, k1 = 3e8, k2 = 1.7e8;
  building.storeys = {{m1, {}, k1}, {m2, {}, k2}};
  const double b = m1 * k2 + m2 * k1 + m2 * k2, root = std::sqrt(b * b - 4 * m1 * m2 * k1 * k2);
  EXPECT_NEAR(modes(building)[0].w_radps, std::sqrt((b - root) / (2 * m1 * m2)), 1e-11);
  EXPECT_NEAR(modes(building)[1].w_radps, std::sqrt((b + root) / (2 * m1 * m2)), 1e-11);
}

// Equal masses at equal heights on k_i ~ n (n + 1) - i (i - 1): K acts on H as Legendre's operator does, so that w_j^2 / w_1^2 = j (2j - 1).
TEST(Building, AStraightFirstModeOverEqualStoreysHasLegendresPeriods) {
  Building building = alike(6, 1.2);
  for (Storey& storey : building.storeys) storey.height_m = 3.2;
  building.stiffness = Building::Stiffness::straight_first_mode;
  const std::vector<Mode> found = modes(building);
  for (int j = 1; j <= 6; ++j)
    EXPECT_NEAR(found[static_cast<std::size_t>(j) - 1].period_s(), 1.2 / std::sqrt(j * (2 * j - 1.0)), 1e-11) << j;
}

TEST(Building, AStraightFirstModeIsStraightWhateverTheStoreys) {
  Building building = alike(4, 0.7);
  const double height[] = {5.0, 3.6, 3.0, 4.1}, mass[] = {4e5, 3.1e5, 3.3e5, 1e5};
  for (std::size_t i = 0; i < 4; ++i) building.storeys[i] = {mass[i], height[i], {}};
  building.stiffness = Building::Stiffness::straight_first_mode;
  const std::vector<Mode> found = modes(building);
  EXPECT_NEAR(found.front().period_s(), 0.7, 1e-13);
  for (int i = 1; i <= 4; ++i)
    EXPECT_NEAR(found.front().floors[static_cast<std::size_t>(i)] / found.front().floors[4],
                *building.height_m(i) / *building.height_m(4), 1e-12);
  EXPECT_NEAR(*building.height_m(3), 11.6, 1e-12);
}

// sum_m G_m phi_m = 1 and sum_m of the modal masses = all of the mass: the modes are complete.
TEST(Building, ModesAreComplete) {
  Building building;
  for (int i = 0; i < 15; ++i) building.storeys.push_back({1e5 * (1 + i % 4), {}, 1e8 * (1 + (7 * i) % 5)});
  double mass = 0;
  std::vector<double> sum(16, 0.0);
  for (const Mode& mode : modes(building)) {
    mass += mode.mass_share;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += mode.floors[i];
  }
  EXPECT_NEAR(mass, 1, 1e-12);
  EXPECT_EQ(sum[0], 0);
  for (std::size_t i = 1; i < sum.size(); ++i) EXPECT_NEAR(sum[i], 1, 1e-12);
}

TEST(Building, RayleighDampingIsThatOfTheTwoModes) {
  Building building = alike(8, 1.5);
  building.damping = 0.03;
  building.rayleigh_modes = {1, 3};
  const std::vector<Mode> found = modes(building);
  EXPECT_NEAR(found[0].damping, 0.03, 1e-14);
  EXPECT_NEAR(found[2].damping, 0.03, 1e-14);
  EXPECT_LT(found[1].damping, 0.03);
  EXPECT_GT(found[7].damping, 0.03);
  // z w = (alpha + beta w^2) / 2 is linear in w^2.
  const auto square = [&](std::size_t m) { return found[m].w_radps * found[m].w_radps; };
  const auto rate = [&](std::size_t m) { return found[m].damping * found[m].w_radps; };
  const double slope = (rate(2) - rate(0)) / (square(2) - square(0));
  for (std::size_t m = 0; m < 8; ++m) EXPECT_NEAR(rate(m), rate(0) + slope * (square(m) - square(0)), 1e-11) << m;
}

TEST(Building, WhatIsNoneIsRefused) {
  EXPECT_NE(refusal({}).find("no storeys"), std::string::npos);
  const auto changed = [](const auto& change) {
    Building building;
    building.storeys = {{2e5, 3.0, 3e8}, {2e5, 3.0, 3e8}};
    change(building);
    return refusal(building);
  };
  EXPECT_EQ(changed([](Building&) {}), "");
  EXPECT_NE(changed([](Building& b) { b.storeys[1].mass_kg = 0; }).find("mass_kg of storey 2 is 0"), std::string::npos);
  EXPECT_NE(changed([](Building& b) { b.storeys[0].stiffness_npm = -1; }).find("stiffness_npm of storey 1"),
            std::string::npos);
  EXPECT_NE(changed([](Building& b) { b.storeys[1].height_m = std::nan(""); }).find("height_m"), std::string::npos);
  EXPECT_NE(changed([](Building& b) { b.storeys[1].mass_kg.reset(); }).find("1 of 2 storeys"), std::string::npos);
  EXPECT_NE(changed([](Building& b) { b.storeys[1].stiffness_npm.reset(); }).find("1 of 2 storeys"), std::string::npos);
  EXPECT_NE(changed([](Building& b) { b.period_s = 1; }).find("both given"), std::string::npos);
  for (const double damping : {0.0, -0.05, 1.0, std::nan("")})
    EXPECT_NE(changed([&](Building& b) { b.damping = damping; }).find("damping is"), std::string::npos) << damping;
  EXPECT_NE(changed([](Building& b) {
              b.rayleigh_modes = {1, 3};
            }).find("rayleigh_modes is [1, 3]"),
            std::string::npos);
  EXPECT_NE(changed([](Building& b) { b.rayleigh_modes = {2, 1}; }).find("rayleigh_modes"), std::string::npos);
  EXPECT_NE(changed([](Building& b) { b.stiffness = Building::Stiffness::straight_first_mode; }).find("both given"),
            std::string::npos);
  EXPECT_NE(changed([](Building& b) {
              for (Storey& storey : b.storeys) storey = {{}, 3.0, 3e8};
            }).find("no mass_kg"),
            std::string::npos);
  EXPECT_NE(changed([](Building& b) { b.storeys.assign(2, {}); }).find("neither period_s"), std::string::npos);
  EXPECT_NE(refusal(alike(3, 0)).find("period_s is 0"), std::string::npos);
  Building straight = alike(3, 0.5);
  straight.stiffness = Building::Stiffness::straight_first_mode;
  EXPECT_NE(refusal(straight).find("needs the height_m"), std::string::npos);
  Building damped = alike(12, 1);
  damped.damping = 0.3;
  damped.rayleigh_modes = {1, 2};
  EXPECT_NE(refusal(damped).find("by Rayleigh's rule"), std::string::npos);
}

}  // namespace
}  // namespace freestand::motion
