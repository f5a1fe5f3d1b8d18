// The motion that is proposed to tell models apart.
#include "measurement/tell/suggest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "measurement/examined.hpp"
#include "measurement/made_tests.hpp"
#include "motion/pulse.hpp"

namespace freestand::measurement {
namespace {

using test::sliding_cabinet;

// Peaks of a block under pulses, of which each has its own strength and length.
Dataset pulse_tests() {
  Dataset data;
  for (const auto& [peak, period] : {std::pair{0.4, 0.5}, {0.6, 0.8}, {0.9, 1.1}, {0.5, 1.4}}) {
    measurement::Test test;
    test.id = std::string("t").append(std::to_string(data.tests.size() + 1));
    test.motion = motion::pulse_motion(motion::find_pulse("B"));
    test.pulse = "B";
    test.scale = peak * standard_gravity_mps2;
    test.stretch = period;
    test.specimen = {0.8, 0.6, 100.0};
    test.peaks.peak_slip_m = respond(sliding_cabinet(0.2), test.shaking()).peak_slip_m;
    data.tests.push_back(std::move(test));
  }
  return data;
}

// It was taken for a pulse as strong, and as long, times those of the first test.
TEST(Suggest, ThePulseIsTheOneThatIsNamedWhicheverTestComesFirst) {
  Dataset data = pulse_tests();
  constexpr double mu[] = {0.2, 0.23}, scatter = 0.1;
  std::vector<ModelFit> models;
  for (const double one : mu) {
    models.push_back({.model = test::free_friction(), .x = {one}, .score = scatter * scatter * 3 / 4});
    models.back().model.model = Model::slide;
  }
  double before = 0;
  for (int turn = 0; turn < 2; ++turn) {
    const Bench bench(data, 0);
    const Suggestion s = suggest(bench, models, nullptr, run_here);
    const FloorMotion pulse = motion::pulse_motion(motion::find_pulse(s.pulse));
    const auto peak = [&](double friction) {
      return respond(sliding_cabinet(friction * s.friction_factor),
                     {.motion = &pulse, .scale = s.peak_acceleration_g * standard_gravity_mps2, .stretch = s.period_s})
          .peak_slip_m;
    };
    EXPECT_NEAR(s.separation, std::log(peak(mu[0]) / peak(mu[1])) / scatter, 0.02 * s.separation) << s.sentence;
    if (turn > 0) {
      EXPECT_EQ(s.separation, before);
    }
    before = s.separation;
    std::ranges::reverse(data.tests);
  }
}

}  // namespace
}  // namespace freestand::measurement
