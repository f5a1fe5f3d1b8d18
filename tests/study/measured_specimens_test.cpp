// What a data set says of its specimens and of how a test begins.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "measurement/predict/model.hpp"
#include "study/read_measurements.hpp"
#include "study/read_validation.hpp"
#include "support/error_text.hpp"
#include "support/scratch.hpp"

namespace freestand::study::measured_specimens_test {
namespace {

using freestand::test::error_text;
using testing::HasSubstr;

class MeasuredSpecimens : public testing::Test {
 protected:
  std::filesystem::path dataset(const std::string& specimen, const std::string& test) const {
    const auto file = folder_ / "dataset.yaml";
    std::ofstream(file) << "format: freestand-measurements/1\nname: one\nspecimen: {" << specimen
                        << "}\nnoise: {slip_m: 0.001}\ntests:\n  - {id: a, role: calibration, " << test << "}\n";
    return file;
  }
  static constexpr const char* pulse = "pulse: A, period_s: 0.5, peak_acceleration_g: 0.6, peak_slip_m: 0.1";
  freestand::test::Scratch folder_{"measured_specimens"};
};

TEST_F(MeasuredSpecimens, SayWhereTheirMassIsAndHowTheyBegin) {
  const auto data = read_measurements(
      dataset("width_m: 0.6, height_m: 1.8, mass_kg: 90, centre_height_m: 0.7, gyration_radius_m: 0.5",
              std::string(pulse) + ", start: {rotation_rad: -0.05, slip_m: 0.01}"));
  measurement::ModelSpec model;
  model.mu_k.value = 0.3;
  const Specimen s = measurement::specimen(model, data.tests.at(0), {});
  EXPECT_EQ(s.block.height_m, 0.7);
  EXPECT_EQ(s.block.full_height_m(), 1.8);
  EXPECT_EQ(s.block.gyration2_m2, 0.25);
  EXPECT_EQ(s.start.rotation_rad, -0.05);
  EXPECT_EQ(s.start.slip_m, 0.01);
  EXPECT_THAT(error_text(Exit::data, [&] { read_measurements(dataset("height_m: 1.8, centre_height_m: 1.8", pulse)); }),
              HasSubstr("the centre of mass lies within the block"));
}

TEST_F(MeasuredSpecimens, APulseAndTheBlocksOwnPeakAreTwoAccelerations) {
  const auto data = read_measurements(
      dataset("width_m: 0.6, height_m: 1.8", std::string(pulse) + ", block_peak_acceleration_g: 0.41"));
  EXPECT_EQ(data.tests.at(0).peaks.peak_acceleration_g, 0.41);
}

TEST_F(MeasuredSpecimens, AModelMayHaveChainsAndFitThem) {
  const Validation v = parse_validation(
      "measurements: dataset.yaml\nmodel:\n  friction: {mu: 0.3}\n"
      "  block: {mass_kg: 90, centre_height_m: {calibrate: [0.5, 0.9]}}\n"
      "  chain: {stiffness_npm: {calibrate: [1e4, 1e6]}, strength_n: 2736, slack_m: 0.02, number: 2, wall_gap_m: "
      "0.05}\n",
      folder_ / "v.yaml");
  const measurement::ModelSpec model = model_spec(v, false);
  ASSERT_EQ(model.free.size(), 2U);
  const std::vector<double> x =
      model.free[0].name == "chain.stiffness_npm" ? std::vector{4e5, 0.6} : std::vector{0.6, 4e5};
  const Specimen s = measurement::specimen(model, {.width_m = 0.6, .height_m = 1.8, .mass_kg = {}}, x);
  EXPECT_EQ(s.block.height_m, 0.6);
  ASSERT_EQ(s.effects.size(), 1U);
  EXPECT_EQ(s.effects[0].effect->name, "chain");
  EXPECT_EQ(s.effects[0].parameters[0], 4e5 / 90);
  measurement::ModelSpec unknown = model;
  unknown.mass = {};
  measurement::Test test;
  test.specimen.width_m = 0.6, test.specimen.height_m = 1.8;
  EXPECT_EQ(measurement::missing_dimension(unknown, test), "mass_kg");
}

}  // namespace
}  // namespace freestand::study::measured_specimens_test
