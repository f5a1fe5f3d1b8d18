// Motions scaled to any intensity: the scaled floor motion itself is measured again, by what knows nothing of scales.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/units.hpp"
#include "motion/peaks.hpp"
#include "motion/spectrum.hpp"
#include "study/realise.hpp"
#include "study_text.hpp"
#include "support/scratch.hpp"

namespace freestand::study::scale_to_test {
namespace {

using namespace test;

class ScaleTo : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_ / "records");
    for (const auto& [name, rate] : {std::pair("a.csv", 3.0), std::pair("b.csv", 11.0)}) {
      std::ofstream file(folder_ / "records" / name);
      file << "time_s,floor_acceleration_mps2\n";
      for (int i = 0; i < 200; ++i)
        file << 0.02 * i << ',' << rate * std::sin(rate * 0.02 * i) * std::exp(-0.02 * i) << '\n';
    }
  }
  Study study(const std::string& motion) const {
    return parse_study(block + friction + samples + fragility + "motions: [" + motion + "]\n", folder_ / "s.yaml",
                       known());
  }
  // The floor as it moves: scaled, and for pulses stretched.
  static FloorMotion moved(const Shaking& shaking) {
    FloorMotion motion = *shaking.motion;
    motion.horizontal_run_mps2.clear();
    motion.table.reset();
    for (double& knot : motion.knot_s) knot *= shaking.stretch;
    double* values = motion.horizontal_mps2.data();
    const auto terms = static_cast<std::size_t>(motion.degree) + 1;
    for (std::size_t i = 0; i < motion.horizontal_mps2.size(); ++i)
      values[i] *= shaking.scale / std::pow(shaking.stretch, static_cast<double>(i % terms));
    return motion;
  }
  template <class Measure>
  void expect_of_each(const std::string& source, const std::string& target, double wanted, const Measure& measured,
                      double accuracy = 1e-6) {
    const Study swept = study("{" + source + ", scale_to: {" + target + "}}");
    const Realiser realise(swept, load_motions(swept));
    for (std::uint64_t i = 0; i < 8; ++i) {
      const Realisation r = realise(i);
      EXPECT_NEAR(measured(moved(r.shaking), r.specimen), wanted, accuracy * wanted) << source << " to " << target;
      EXPECT_GT(r.shaking.scale, 0);
    }
    EXPECT_EQ(expanded(parse_study(expanded(swept), folder_ / "s.yaml", known())), expanded(swept));
  }
  freestand::test::Scratch folder_{"scale_to"};
};

// 1e-6: the peaks of a pulse are found on its polynomials, and these are its cosine to some 1e-8.
TEST_F(ScaleTo, EveryProportionalIntensityIsReached) {
  const auto peaks = [](const FloorMotion& floor) { return motion::peaks(floor); };
  for (const std::string source :
       {"records: \"records/*.csv\"", "pulse: [B, ricker], period_s: {uniform: [0.3, 1.2]}"}) {
    expect_of_each(source, "pga_g: 0.4", 0.4, [&](const FloorMotion& floor, const Specimen&) {
      return peaks(floor).pga_mps2 / standard_gravity_mps2;
    });
    expect_of_each(source, "pgv_mps: 0.3", 0.3,
                   [&](const FloorMotion& floor, const Specimen&) { return peaks(floor).pgv_mps; });
    expect_of_each(source, "pgd_m: 0.2", 0.2,
                   [&](const FloorMotion& floor, const Specimen&) { return peaks(floor).pgd_m; });
    expect_of_each(source, "sa_g: 0.7, period_s: 0.8", 0.7, [&](const FloorMotion& floor, const Specimen&) {
      return motion::spectral_acceleration_mps2(floor, 0.8) / standard_gravity_mps2;
    });
    expect_of_each(
        source, "housner_m: 1.1", 1.1,
        [&](const FloorMotion& floor, const Specimen&) { return motion::housner_intensity_m(floor); },
        1e-4);  // of pulses from a table: tests/motion/spectrum_test.cpp
    expect_of_each(source, "pga_over_g_tan_alpha: 1.5", 1.5, [&](const FloorMotion& floor, const Specimen& specimen) {
      return peaks(floor).pga_mps2 / (standard_gravity_mps2 * std::tan(specimen.block.alpha_rad()));
    });
  }
}

// Draws are those of an amplitude: the same uniforms, whatever it is measured by.
TEST_F(ScaleTo, DrawsAreThoseOfAnAmplitude) {
  const auto scales = [&](const std::string& text) {
    const Study swept = study("{records: records/a.csv, " + text + "}");
    const Realiser realise(swept, load_motions(swept));
    std::vector<double> found;
    for (std::uint64_t i = 0; i < 16; ++i) found.push_back(realise(i).shaking.scale / realise(0).shaking.scale);
    return found;
  };
  const std::vector<double> by_peak = scales("scale_to: {pta_g: {uniform: [0.1, 1]}}");
  EXPECT_THAT(scales("scale_to: {sa_g: {uniform: [0.2, 2]}, period_s: 0.5}"),
              testing::Pointwise(testing::DoubleNear(1e-12), by_peak));
}

// As with peaks and factors.
TEST_F(ScaleTo, ANegativeIntensityMirrorsTheMotion) {
  const auto scale = [&](const std::string& target) {
    const Study swept = study("{records: records/a.csv, scale_to: {pgv_mps: " + target + "}}");
    return Realiser(swept, load_motions(swept))(0).shaking.scale;
  };
  EXPECT_GT(scale("0.3"), 0);
  EXPECT_EQ(scale("-0.3"), -scale("0.3"));
}

}  // namespace
}  // namespace freestand::study::scale_to_test
