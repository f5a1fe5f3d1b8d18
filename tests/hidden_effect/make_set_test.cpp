// Sets are what their headers promise: the same from the same seed, noise as told, the answer apart.
#include "hidden_effect/make_set.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "support/scratch.hpp"

namespace freestand::test {
namespace {

std::map<std::string, std::string> bytes_of(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ostringstream text;
    text << std::ifstream(entry.path(), std::ios::binary).rdbuf();
    files[entry.path().filename()] = text.str();
  }
  return files;
}

double deviation(const std::vector<double>& measured, const std::vector<double>& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) sum += (measured[i] - truth[i]) * (measured[i] - truth[i]);
  return std::sqrt(sum / static_cast<double>(truth.size()));
}

double largest(const std::vector<double>& values) {
  double peak = 0;
  for (const double value : values) peak = std::max(peak, std::abs(value));
  return peak;
}

TEST(MakeSet, TheSameSeedMakesTheSameBytes) {
  const Scratch scratch("made");
  const SetRequest request{{"flexible_legs"}, 4, 4, 6};
  write_set(make_set(request), scratch / "a");
  write_set(make_set(request), scratch / "b");
  SetRequest other = request;
  other.seed = 5;
  write_set(make_set(other), scratch / "c");
  const auto a = bytes_of(scratch / "a");
  EXPECT_EQ(a.size(), 5u);
  EXPECT_EQ(a, bytes_of(scratch / "b"));
  const auto c = bytes_of(scratch / "c");
  for (const auto& [file, text] : a) EXPECT_NE(text, c.at(file)) << file;
}

TEST(MakeSet, KeepsTheAnswerOutOfTheSet) {
  const Scratch scratch("apart");
  const MadeSet set = make_set({{"rate_weakening"}, 1, 3, 6});
  write_set(set, scratch.folder());
  for (const auto& [file, text] : bytes_of(scratch.folder())) {
    EXPECT_EQ(text.find("drop"), std::string::npos) << file;
    EXPECT_TRUE(file == "dataset.yaml" || file.ends_with(".csv")) << file;
  }
  const auto answer = answer_of(set);
  EXPECT_EQ(answer["effects"].dump(), R"(["rate_weakening"])");
  EXPECT_TRUE(answer["in_catalogue"]);
  EXPECT_TRUE(answer["true_parameters"]["effects"]["rate_weakening"].contains("speed_mps"));
  EXPECT_GE(set.plain_error, 6);
}

TEST(MakeSet, NoiseIsAsLargeAsTold) {
  for (const char* effect : {"vertical_shaking", "offset_mass"})
    for (const std::uint64_t seed : {1, 2}) {
      const MadeSet set = make_set({{effect}, seed, 3, 10});
      for (const MadeTest& t : set.tests) {
        EXPECT_NEAR(deviation(t.slip_m, t.truth.slip_m) / set.slip_noise_m, 1, 0.08);
        EXPECT_NEAR(deviation(t.measured_floor.horizontal_mps2, t.floor.horizontal_mps2) / set.floor_noise_mps2, 1,
                    0.08);
        if (!t.floor.vertical_mps2.empty()) {
          EXPECT_NEAR(deviation(t.measured_floor.vertical_mps2, t.floor.vertical_mps2) / set.floor_noise_mps2, 1, 0.08);
        }
        if (!t.rotation_rad.empty()) {
          EXPECT_NEAR(deviation(t.rotation_rad, t.truth.rotation_rad) / set.rotation_noise_rad, 1, 0.08);
        }
      }
    }
}

// At 50 Hz every fourth of the responses' readings at 200 Hz, to the bit, and of a floor that a recorder filtered; at 1000 Hz other floors.
TEST(MakeSet, SensorsReadAtTheirRate) {
  SetRequest request{{"static_friction"}, 3, 3, 6};
  const MadeSet usual = make_set(request);
  request.rate_hz = 50;
  const MadeSet slow = make_set(request);
  request.fault = "no_filter";
  const MadeSet bare = make_set(request);
  request.fault = "";
  request.rate_hz = 1000;
  const MadeSet fast = make_set(request);
  EXPECT_EQ(slow.name, usual.name + "-50hz");
  for (std::size_t i = 0; i < usual.tests.size(); ++i) {
    const MadeTest &at_200 = usual.tests[i], &at_50 = slow.tests[i], &at_1000 = fast.tests[i];
    EXPECT_DOUBLE_EQ(at_50.measured_floor.dt_s, 0.02);
    EXPECT_DOUBLE_EQ(at_1000.measured_floor.dt_s, 0.001);
    for (std::size_t k = 0; k < at_50.slip_m.size(); ++k) {
      EXPECT_EQ(at_50.slip_m[k], at_200.slip_m[4 * k]);
    }
    EXPECT_NE(at_50.measured_floor.horizontal_mps2[40], at_200.measured_floor.horizontal_mps2[160]);
    EXPECT_EQ(bare.tests[i].measured_floor.horizontal_mps2[40], at_200.measured_floor.horizontal_mps2[160]);
    EXPECT_GE(4 * at_50.slip_m.size(), at_200.slip_m.size());
    EXPECT_NEAR(deviation(at_1000.slip_m, at_1000.truth.slip_m) / fast.slip_noise_m, 1, 0.08);
  }
}

TEST(MakeSet, TestsMoveAsOnShakeTables) {
  for (const char* effect : {"static_friction", "reduced_base", "pressure_friction", "stick_ageing"}) {
    const MadeSet set = make_set({{effect}, 3, 6, 4});
    const double alpha = std::atan(set.drawn.width_m / set.drawn.height_m);
    int held_out = 0;
    for (const MadeTest& t : set.tests) {
      held_out += t.holdout;
      EXPECT_EQ(t.truth.outcome, "moved") << set.name << t.id;
      if (set.drawn.habit == Habit::slides) {
        EXPECT_GE(largest(t.truth.slip_m), 0.0145) << set.name << t.id;
      }
      EXPECT_LE(largest(t.truth.slip_m), 0.6);
      EXPECT_LE(largest(t.truth.rotation_rad), 0.6 * alpha);
      EXPECT_EQ(t.rotation_rad.empty(), set.drawn.habit == Habit::slides);
    }
    EXPECT_EQ(held_out, 2);
  }
}

TEST(MakeSet, WeakEffectsMakeOneToSixNoiseUnits) {
  for (const char* effect : {"static_friction", "wall_impact", "impact_loss"}) {
    SetRequest request{{effect}, 902, 3, 5};
    request.weak = true;
    const MadeSet set = make_set(request);
    EXPECT_GE(set.weakest_error, 1) << set.name;
    EXPECT_LE(set.weakest_error, 6) << set.name;
  }
}

TEST(MakeSet, TwinsAreTold) {
  EXPECT_EQ(answer_of(make_set({{"directional_friction"}, 1, 2, 6}))["twins"].size(), 2u);
  EXPECT_EQ(answer_of(make_set({{"static_friction"}, 1, 2, 6}))["twins"].size(), 0u);
}

TEST(MakeSet, RefusesAnEffectThatDoesNotExist) { EXPECT_THROW(make_set({{"glue"}, 1}), std::invalid_argument); }

}  // namespace
}  // namespace freestand::test
