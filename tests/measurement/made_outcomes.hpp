// Sets of tests of which only is known whether the specimen overturned, made by a block whose answer is known.
#pragma once

#include <gsl/gsl_cdf.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "measurement/predict/bench.hpp"

namespace freestand::measurement {

// Slenderness and scatter free, size known.
inline ModelSpec rocking_model(double size_m) {
  ModelSpec model;
  model.model = Model::rock;
  model.mu_k = {.value = 1};
  model.size = Number{.value = size_m};
  model.slenderness = Number{.free = 0};
  model.placement_scatter = Number{.free = 1};
  model.free = {{.name = "block.slenderness_rad",
                 .unit = "rad",
                 .lower = 0.05,
                 .upper = 0.5,
                 .low = 0.05,
                 .high = 0.5,
                 .logarithmic = true},
                {.name = "placement_scatter",
                 .unit = "1",
                 .lower = 0.001,
                 .upper = 0.5,
                 .low = 0.02,
                 .high = 0.3,
                 .logarithmic = true}};
  return model;
}

// One swing of the floor to and fro: a block falls to one side, by the sign.
inline FloorMotion swing(double peak_mps2, double period_s) {
  std::vector<double> a;
  for (int i = 0; i < 401; ++i) {
    const double t = 0.005 * i - 0.1;
    a.push_back(t > 0 && t < period_s ? peak_mps2 * std::sin(2 * std::numbers::pi * t / period_s) : 0);
  }
  return piecewise_linear("swing", 0.005, a, {});
}

inline constexpr double true_slenderness = 0.2, true_size_m = 0.6, true_scatter = 0.1;

// Tests of a block whose slenderness scatters, with the effects of `truth`; motions that make about half overturn.
inline Dataset made_outcomes(std::size_t count, const std::vector<EffectUse>& truth, std::uint64_t seed = 7,
                             double scatters = true_scatter, double slender = true_slenderness) {
  Dataset data;
  data.name = "made";
  for (std::size_t i = 0; i < count; ++i) {
    const auto draw = [&](std::uint64_t stream) { return random::uniform(seed, i, stream); };
    Test test;
    test.id = "t" + std::to_string(i);
    test.motion = swing((draw(1) < 0.5 ? -1 : 1) * (2 + 3 * draw(2)), 0.5 + 0.7 * draw(3));
    const double scatter = scatters * gsl_cdf_ugaussian_Pinv(draw(4));
    const double slenderness = slender * std::exp(scatter);
    Specimen s;
    s.model = Model::rock;
    s.friction = {1, 1};
    s.block = Block::rectangular(2 * true_size_m * std::sin(slenderness), 2 * true_size_m * std::cos(slenderness), 1);
    s.effects = truth;
    test.peaks.overturned = respond(s, test.shaking()).outcome == Outcome::overturned;
    data.tests.push_back(std::move(test));
  }
  return data;
}

}  // namespace freestand::measurement
