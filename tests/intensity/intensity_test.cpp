#include "intensity/intensity.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <freestand/error.hpp>
#include <freestand/specimen.hpp>

#include "base/units.hpp"
#include "motion/spectrum.hpp"
#include "support/data.hpp"

namespace freestand::intensity {
namespace {

constexpr double g = standard_gravity_mps2;

// A refrigerator of 0.6 x 1.8 m, mu_k = 0.25.
Input refrigerator_on(const motion::MotionSummary& motion, double scale, double stretch) {
  const Block block = Block::rectangular(0.6, 1.8, 150);
  return {motion, scale, stretch, block.alpha_rad(), block.p_radps(), 0.25};
}

double value_of(const Measure& measure, Input input, std::optional<double> parameter = {}) {
  input.parameter = parameter_of(measure, parameter);
  return measure.value(input);
}

// A floor's measures look at the floor, ground.NAME at what lies under the building.
TEST(OfTheGround, MeasuresOfTheMotionAloneLookUnderTheBuilding) {
  motion::MotionSummary ground, floor;
  ground.peaks = {2, 0.3, 0.1};
  floor.peaks = {5, 0.4, 0.15};
  ground.spectrum = {{1.0}, {3.0}};
  floor.spectrum = {{1.0}, {8.0}};
  floor.ground = std::make_shared<const motion::MotionSummary>(ground);
  const auto on = [](const motion::MotionSummary& motion) { return refrigerator_on(motion, -1.5, 1); };
  EXPECT_NEAR(value_of(find("ground.pga_g"), on(floor)), 3 / g, 1e-15);
  EXPECT_NEAR(value_of(find("pga_g"), on(floor)), 7.5 / g, 1e-15);
  EXPECT_NEAR(value_of(find("ground.pgv_mps"), on(floor)), 0.45, 1e-15);
  EXPECT_NEAR(value_of(find("ground.sa_g"), on(floor), 1.0), 4.5 / g, 1e-15);
  EXPECT_NEAR(value_of(find("ground.pga_g"), on(ground)), 3 / g, 1e-15);  // it stands on the ground
  std::vector<std::string> names;
  for (const Measure* measure : of_the_ground()) {
    names.push_back(measure->name);
    EXPECT_EQ(measure->unit, find(measure->name.substr(7)).unit);
    EXPECT_TRUE(measure->of_the_ground);
    EXPECT_FALSE(measure->proportional);
  }
  EXPECT_THAT(names, testing::IsSupersetOf(
                         {"ground.housner_m", "ground.pga_g", "ground.pgd_m", "ground.pgv_mps", "ground.sa_g"}));
  EXPECT_THAT(names, testing::Not(testing::Contains("ground.report")));
  EXPECT_THROW(find("ground.report"), Error);
  for (const Measure* measure : all()) EXPECT_FALSE(measure->of_the_ground) << measure->name;
}

class OfAPulse : public testing::Test {
 protected:
  const motion::Pulse pulse = motion::find_pulse("C1");
  const motion::MotionSummary summary = motion::summarize(pulse);

  // Mirrored, 6 m/s2, period 0.8 s.
  double value_of(const std::string& name, std::optional<double> parameter = {}) const {
    return intensity::value_of(find(name), refrigerator_on(summary, -6, 0.8), parameter);
  }
};

TEST_F(OfAPulse, PeaksScaleWithAmplitudeAndPeriod) {
  const double pgv = 6 * 0.8 * (1 + std::sin(pulse.phase_rad)) / (2 * pi);
  EXPECT_NEAR(value_of("pga_g"), 6 / g, 1e-15);
  EXPECT_EQ(value_of("pta_g"), value_of("pga_g"));
  EXPECT_NEAR(value_of("pgv_mps"), pgv, 1e-14);
  EXPECT_NEAR(value_of("pgd_m"), 6 * 0.64 * pulse.peak_displacement, 1e-14);
}

TEST_F(OfAPulse, DimensionlessMeasuresFollowTheirFormulas) {
  const double tan_alpha = 0.6 / 1.8, p = std::sqrt(3 * g / (4 * std::hypot(0.3, 0.9)));
  EXPECT_NEAR(value_of("report"), 6 / (0.25 * g) - 1, 1e-14);
  EXPECT_NEAR(value_of("pga_over_g_tan_alpha"), 6 / (g * tan_alpha), 1e-14);
  EXPECT_NEAR(value_of("p_pgv_over_g_tan_alpha"), p * value_of("pgv_mps") / (g * tan_alpha), 1e-14);
}

// A floor of which the motion itself is the scaled one: the sums of squares and of absolute values are its own.
TEST_F(OfAPulse, SumsOverTimeScaleWithPowersOfTheAmplitude) {
  FloorMotion floor = motion::pulse_motion(pulse);
  for (double& knot : floor.knot_s) knot *= 0.8;
  const auto terms = static_cast<std::size_t>(floor.degree) + 1;
  for (std::size_t i = 0; i < floor.horizontal_mps2.size(); ++i)
    floor.horizontal_mps2[i] *= -6 / std::pow(0.8, static_cast<double>(i % terms));
  const motion::MotionSummary scaled = motion::summarize(floor);
  EXPECT_NEAR(value_of("arias_mps"), scaled.arias_mps, 1e-9 * scaled.arias_mps);
  EXPECT_NEAR(value_of("cav_mps"), scaled.cav_mps, 1e-9 * scaled.cav_mps);
  EXPECT_GT(scaled.arias_mps, 1);
}

// Whoever says that it is proportional to the scale is, whatever its sign, and whoever is says so.
TEST_F(OfAPulse, ProportionalOnesSaySo) {
  for (const Measure* measure : all()) {
    const double before = intensity::value_of(*measure, refrigerator_on(summary, -6, 0.8)),
                 after = intensity::value_of(*measure, refrigerator_on(summary, 15, 0.8));  // -2.5 times
    EXPECT_EQ(std::abs(after - 2.5 * before) < 1e-12 * std::abs(after), measure->proportional) << measure->name;
  }
}

// The pulse written out as a record of its own period is another way to the same numbers.
TEST_F(OfAPulse, SpectralMeasuresAreThoseOfTheStretchedPulse) {
  std::vector<double> samples;
  const int n = 4000;
  for (int i = 0; i <= n; ++i) samples.push_back(-6 * pulse.at(pulse.duration * i / n).acceleration);
  const FloorMotion record = piecewise_linear("record", 0.8 * pulse.duration / n, samples);
  for (const double period : {0.2, 0.8, 3.0}) {
    const double expected = motion::spectral_acceleration_mps2(record, period) / g;
    EXPECT_NEAR(value_of("sa_g", period), expected, 1e-5 * expected) << period;
  }
  EXPECT_EQ(value_of("sa_g"), value_of("sa_g", 1.0));
  const double housner =
      motion::housner_intensity_m(record);  // of a pulse from a table: tests/motion/spectrum_test.cpp
  EXPECT_NEAR(value_of("housner_m"), housner, 1e-4 * housner);
}

TEST(OfARecord, EverythingFollowsFromWhatIsKept) {
  std::vector<double> samples;
  for (int i = 0; i < 800; ++i) samples.push_back(std::sin(0.05 * i) * std::exp(-0.004 * i));
  const FloorMotion record = piecewise_linear("record", 0.01, samples);
  motion::MotionSummary summary = motion::summarize(record, {.pulse = false, .sa_period_s = {0.25, 0.5}});
  const auto value_of = [&](const char* name, double parameter) {
    return intensity::value_of(find(name), refrigerator_on(summary, 2, 1), parameter);
  };
  EXPECT_EQ(value_of("sa_g", 0.5), 2 * motion::spectral_acceleration_mps2(record, 0.5) / g);
  EXPECT_EQ(value_of("housner_m", 0), 2 * motion::housner_intensity_m(record));
  EXPECT_THROW(value_of("sa_g", 0.7), Error);
  summary.spectrum = {{0.25, 0.5}, {1, 123 * g}};  // read, not computed again
  summary.housner_m = 7;
  EXPECT_NEAR(value_of("sa_g", 0.5), 246, 1e-12);
  EXPECT_EQ(value_of("housner_m", 0), 14);
  const motion::MotionSummary peaks_only = motion::summarize(record);
  EXPECT_THROW(intensity::value_of(find("housner_m"), refrigerator_on(peaks_only, 2, 1)), Error);
}

TEST(EveryMeasure, DoesNotTellAMotionFromItsMirrorImage) {
  const motion::MotionSummary summary = motion::summarize(motion::find_pulse("B"));
  for (const Measure* measure : all())
    EXPECT_EQ(value_of(*measure, refrigerator_on(summary, 3.7, 0.6)),
              value_of(*measure, refrigerator_on(summary, -3.7, 0.6)))
        << measure->name;
}

TEST(EveryMeasure, GrowsWithTheMotionAndSaysWhatItIs) {
  const motion::MotionSummary summary = motion::summarize(motion::find_pulse("A"));
  for (const Measure* measure : all()) {
    EXPECT_LT(value_of(*measure, refrigerator_on(summary, 2, 0.6)),
              value_of(*measure, refrigerator_on(summary, 4, 0.6)))
        << measure->name;
    for (const std::string& text : {measure->unit, measure->symbol, measure->summary, measure->source})
      EXPECT_FALSE(text.empty()) << measure->name;
  }
}

TEST(EveryMeasure, HasAFileOfItsOwnAndANameOfItsOwn) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_dir() / "src" / "intensity"))
    files += entry.path().extension() == ".cpp" && entry.path().stem() != "intensity";
  EXPECT_EQ(all().size(), files);
  for (std::size_t i = 1; i < all().size(); ++i) EXPECT_LT(all()[i - 1]->name, all()[i]->name);
}

TEST(Measures, UnknownNamesAreRefusedWithTheKnownOnes) {
  try {
    find("pgx");
    FAIL() << "pgx was found";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("housner_m, p_pgv_over_g_tan_alpha, pga_g"));
  }
}

TEST(Measures, WithoutFrictionTheReportsMeasureIsInfinite) {
  const motion::MotionSummary summary = motion::summarize(motion::find_pulse("A"));
  Input input = refrigerator_on(summary, 1, 1);
  input.mu_k = 0;
  EXPECT_TRUE(std::isinf(value_of(find("report"), input)));
}

}  // namespace
}  // namespace freestand::intensity
