// The readers of the measured drops, on drops made by hand: what is planted is found, without a leaning towards either
// law of impact. Noise as in the measurements.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "support/square_drops.hpp"

namespace freestand::test::square_drops_reader_test {
namespace {

constexpr double g = 9.80665, h = drop_half_side_m;

class Noise {
 public:
  explicit Noise(unsigned long long seed) : state_(seed) {}
  Triple operator()() { return {3e-5 * normal(), 6e-5 * normal(), 1e-3 * normal()}; }

 private:
  double uniform() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return (static_cast<double>(state_ >> 11) + 0.5) * 0x1p-53;
  }
  double normal() {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }
  unsigned long long state_;
};

// Frames at times (i - 20 - phase) steps from the event, with noise.
Drop film(int frames, double phase, Noise& noise, const auto& pose_at) {
  Drop drop;
  for (int i = 0; i < frames; ++i) {
    Triple pose = pose_at((i - 20 - phase) * drop_step_s);
    const Triple wrong = noise();
    for (std::size_t k = 0; k < 3; ++k) pose[k] += wrong[k];
    drop.push_back(pose);
  }
  return drop;
}

// Rocking on the right (side = 1) or left corner until flat at t = 0; then on, flat, or back.
Drop rocking(double side, double rate, double ratio, double phase, Noise& noise) {
  return film(45, phase, noise, [&](double t) {
    constexpr double falling = 60;
    const double before = -rate * t - 0.5 * falling * t * t;
    const double theta = t < 0 ? before : -ratio * rate * t;
    const double c = theta > 0 ? h : -h;
    return Triple{side * (c + h * std::sin(theta) - c * std::cos(theta)), c * std::sin(theta) + h * std::cos(theta),
                  side * theta};
  });
}

TEST(SquareDropsReader, FindsPlantedStrikes) {
  Noise noise(1);
  for (const double planted : {0.25, 0.0, -0.25}) {
    Drops made;
    for (int i = 0; i < 200; ++i)
      made.drops.push_back(rocking(i % 2 ? 1 : -1, 5 + 0.04 * i, planted, 0.05 + 0.9 * (i % 7) / 7.0, noise));
    const auto found = strikes(made);
    double mean = 0, deviation = 0;
    for (const Strike& strike : found) {
      mean += strike.rate_after / strike.rate_before / static_cast<double>(found.size());
      deviation += strike.ratio_deviation / static_cast<double>(found.size());
      EXPECT_EQ(strike.pivot, strike.drop % 2 ? 1 : -1);
    }
    EXPECT_GE(found.size(), 150U) << planted;
    EXPECT_LE(found.size(), 200U) << planted;
    EXPECT_NEAR(mean, planted, deviation) << planted;
  }
}

TEST(SquareDropsReader, FindsPlantedBlows) {
  Noise noise(2);
  Drops made;
  std::vector<Triple> before, after;
  for (int i = 0; i < 100; ++i) {
    before.push_back({0.3 - 0.006 * i, -0.5 - 0.02 * i, 20 - 0.4 * i});
    after.push_back({0.2 - 0.003 * i, 0.5 + 0.005 * i, -15 + 0.3 * i});
    const double tilted = 0.15 + 0.005 * i, height = h * (std::sin(tilted) + std::cos(tilted));
    made.drops.push_back(film(36, 0.05 + 0.9 * (i % 9) / 9.0, noise, [&](double t) {
      const Triple& v = t < 0 ? before.back() : after.back();
      return Triple{v[0] * t, height + v[1] * t - 0.5 * g * t * t, tilted + v[2] * t};
    }));
  }
  const auto found = clean_blows(made);
  EXPECT_GE(found.size(), 90U);
  Triple squares{};
  for (const Blow& blow : found)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto drop = static_cast<std::size_t>(blow.drop);
      squares[k] += std::pow((blow.before[k] - before[drop][k]) / blow.before_deviation[k], 2);
      squares[k] += std::pow((blow.after[k] - after[drop][k]) / blow.after_deviation[k], 2);
    }
  // Mean square of a t-variable with 6 degrees of freedom: 1.5; the deviations told are the true ones.
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(squares[k] / (2 * static_cast<double>(found.size())), 1.5, 0.6) << k;
}

TEST(SquareDropsReader, AFlatBlockGivesNothing) {
  Noise noise(3);
  Drops made;
  for (int i = 0; i < 20; ++i) made.drops.push_back(film(200, 0.5, noise, [](double) { return Triple{0.1, h, 0}; }));
  EXPECT_TRUE(clean_blows(made).empty());
  EXPECT_TRUE(strikes(made).empty());
}

}  // namespace
}  // namespace freestand::test::square_drops_reader_test
