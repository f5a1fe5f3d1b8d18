#include "motion/identify.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "motion/peaks.hpp"
#include "motion/pulse.hpp"
#include "motion/summary.hpp"
#include "support/data.hpp"

namespace freestand::motion {
namespace {

struct Hidden {
  const char* type;
  double period_s, velocity_mps, start_s;
};

// A record of `duration` with one pulse in it, and a ripple of the given velocity.
FloorMotion record_with(const Hidden& hidden, double ripple_mps = 0, double duration = 20) {
  const Pulse pulse = find_pulse(hidden.type);
  const double scale = acceleration_of_velocity_amplitude(pulse, hidden.velocity_mps, hidden.period_s), dt = 0.005;
  std::vector<double> a;
  for (int i = 0; i * dt <= duration; ++i) {
    const double t = (i * dt - hidden.start_s) / hidden.period_s, w = 31;
    const double inside = t >= 0 && t <= pulse.duration ? scale * pulse.at(t).acceleration : 0;
    a.push_back(inside + ripple_mps * w * std::cos(w * i * dt));
  }
  return piecewise_linear("hidden", dt, a);
}

class HiddenPulse : public testing::TestWithParam<Hidden> {};
INSTANTIATE_TEST_SUITE_P(Identify, HiddenPulse,
                         testing::Values(Hidden{"A", 1.3, 0.9, 4.0}, Hidden{"B", 0.53, -0.61, 7.2},
                                         Hidden{"C1", 0.7, 0.5, 3.3}, Hidden{"C2", 2.1, -0.76, 5.0},
                                         Hidden{"B", 4.2, 1.1, 1.0}, Hidden{"C1", 0.3, 0.2, 11.7}),
                         [](const auto& hidden) { return hidden.param.type + std::to_string(hidden.index); });

TEST_P(HiddenPulse, IsFoundAlone) {
  const Hidden& hidden = GetParam();
  const IdentifiedPulse found = identify_pulse(record_with(hidden));
  EXPECT_EQ(found.type, hidden.type);
  EXPECT_NEAR(found.period_s, hidden.period_s, 0.01 * hidden.period_s);
  EXPECT_NEAR(found.velocity_mps, hidden.velocity_mps, 0.02 * std::abs(hidden.velocity_mps));
  EXPECT_NEAR(found.start_s, hidden.start_s, 0.02 * hidden.period_s);
  // Jumps that fall between samples leave the record a small velocity afterwards, which no pulse explains.
  EXPECT_GT(found.explained, hidden.period_s > 0.5 ? 0.99 : 0.75);
}

TEST_P(HiddenPulse, IsFoundUnderARipple) {
  const Hidden& hidden = GetParam();
  const IdentifiedPulse found = identify_pulse(record_with(hidden, 0.05 * std::abs(hidden.velocity_mps)));
  EXPECT_EQ(found.type, hidden.type);
  EXPECT_NEAR(found.period_s, hidden.period_s, 0.05 * hidden.period_s);
  EXPECT_NEAR(found.velocity_mps, hidden.velocity_mps, 0.1 * std::abs(hidden.velocity_mps));
  EXPECT_LT(found.explained, 1);
}

TEST_P(HiddenPulse, OfTheMirroredRecordIsTheMirroredPulseToTheBit) {
  FloorMotion motion = record_with(GetParam(), 0.03);
  const IdentifiedPulse one = identify_pulse(motion);
  for (double& c : motion.horizontal_mps2) c = -c;
  const IdentifiedPulse other = identify_pulse(motion);
  EXPECT_EQ(one.type, other.type);
  EXPECT_EQ(one.period_s, other.period_s);
  EXPECT_EQ(one.velocity_mps, -other.velocity_mps);
  EXPECT_EQ(one.start_s, other.start_s);
  EXPECT_EQ(one.explained, other.explained);
}

// What the user says is taken, and amplitude and start are the best for it.
TEST_P(HiddenPulse, IsFoundWhereItIsKnown) {
  const Hidden& hidden = GetParam();
  const FloorMotion record = record_with(hidden, 0.05 * std::abs(hidden.velocity_mps));
  const IdentifiedPulse found = identify_pulse(record, {hidden.type, hidden.period_s});
  EXPECT_EQ(found.type, hidden.type);
  EXPECT_EQ(found.period_s, hidden.period_s);
  EXPECT_NEAR(found.velocity_mps, hidden.velocity_mps, 0.03 * std::abs(hidden.velocity_mps));
  EXPECT_NEAR(found.start_s, hidden.start_s, 0.01 * hidden.period_s);
  EXPECT_TRUE(found.type_given && found.period_given);
  EXPECT_LE(found.explained, identify_pulse(record).explained + 1e-3);
}

// A wrong type or period is taken too, and explains less.
TEST(Identify, TakesWhatItIsToldAndFindsTheRest) {
  const FloorMotion record = record_with({"B", 0.8, 1, 3});
  const IdentifiedPulse best = identify_pulse(record), as_a = identify_pulse(record, {"A", {}}),
                        long_one = identify_pulse(record, {"", 2.4});
  EXPECT_EQ(as_a.type, "A");
  EXPECT_TRUE(as_a.type_given);
  EXPECT_FALSE(as_a.period_given);
  EXPECT_LT(as_a.explained, best.explained - 0.1);
  EXPECT_EQ(long_one.period_s, 2.4);
  EXPECT_FALSE(long_one.type_given);
  EXPECT_LT(long_one.explained, best.explained - 0.1);
  EXPECT_FALSE(best.type_given || best.period_given);
  const FloorMotion still = piecewise_linear("still", 0.01, std::vector<double>(500, 0.0));
  EXPECT_EQ(identify_pulse(still, {"B", 0.7}).period_s, 0.7);
  EXPECT_EQ(identify_pulse(still, {"B", 0.7}).velocity_mps, 0);
}

TEST(Identify, UnitPulsesThemselvesAreRecognised) {
  for (const char* type : {"A", "B", "C1", "C2"}) {
    const Pulse pulse = find_pulse(type);
    const IdentifiedPulse found = identify_pulse(pulse_motion(pulse));
    EXPECT_EQ(found.type, type);
    EXPECT_NEAR(found.period_s, 1, 1e-6) << type;
    EXPECT_NEAR(found.velocity_mps, pulse.velocity_amplitude, 1e-6) << type;
    EXPECT_NEAR(found.explained, 1, 1e-6) << type;
  }
}

TEST(Identify, StillFloorHasNoPulse) {
  const IdentifiedPulse found = identify_pulse(piecewise_linear("still", 0.01, std::vector<double>(500, 0.0)));
  EXPECT_TRUE(found.type.empty());
  EXPECT_EQ(found.explained, 0);
}

TEST(PulseFrequency, OfPulsesIsTheirOwnAndOfRecordsThatOfTheFit) {
  const Pulse pulse = find_pulse("C2");
  EXPECT_DOUBLE_EQ(pulse_frequency_radps(summarize(pulse), 0.25), 8 * std::numbers::pi);
  const FloorMotion record = record_with({"B", 0.5, 1, 3});
  EXPECT_NEAR(pulse_frequency_radps(summarize(record, {.pulse = true}), 1), 4 * std::numbers::pi, 0.1);
  EXPECT_TRUE(std::isnan(pulse_frequency_radps(summarize(record), 1)));
  const MotionSummary known = summarize(record, {.pulse = true, .known_pulse = {"C1", 0.25}});
  EXPECT_DOUBLE_EQ(pulse_frequency_radps(known, 1), 8 * std::numbers::pi);
}

}  // namespace
}  // namespace freestand::motion
