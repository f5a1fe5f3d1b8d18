#include "edp/edp.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <freestand/error.hpp>

#include "base/units.hpp"
#include "support/data.hpp"

namespace freestand::edp {
namespace {

double value_of(const std::string& name, const Response& response, double pta = 2.0, double w_p = 3.0) {
  Specimen specimen;
  specimen.block = Block::rectangular(0.6, 1.8, 150);
  return find(name).value({response, specimen, pta, w_p});
}

TEST(Edp, EveryFileOfTheFolderIsRegistered) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_dir() / "src/edp"))
    if (entry.path().extension() == ".cpp" && entry.path().stem() != "edp") ++files;
  EXPECT_EQ(all().size(), files);
  EXPECT_GE(files, 8u);
}

TEST(Edp, DeclarationsAreComplete) {
  for (const Edp& edp : all()) {
    EXPECT_FALSE(edp.unit.empty() || edp.symbol.empty() || edp.summary.empty() || edp.source.empty()) << edp.name;
    EXPECT_NE(edp.value, nullptr) << edp.name;
    EXPECT_EQ(edp.binary, edp.default_capacities.empty()) << edp.name;
  }
}

// A chain that held counts as whole and a wall that was not hit as not hit, whatever became of the block afterwards.
TEST(Edp, FourDemandsKeepTheirValueWhenTheBlockOverturns) {
  std::vector<std::string> kept;
  for (const Edp& edp : all())
    if (!edp.censored) kept.push_back(edp.name);
  EXPECT_THAT(kept, testing::UnorderedElementsAre("overturned", "connection_failed", "wall_hit", "wall_speed_mps"));
}

TEST(Edp, ValuesFollowTheirDefinitions) {
  Response response;
  response.outcome = Outcome::moved;
  response.peak_slip_m = 0.4;
  response.residual_slip_m = -0.1;
  response.slid_path_m = 0.7;
  response.peak_rotation_rad = 0.05;
  response.peak_acceleration_mps2 = 2 * standard_gravity_mps2;
  response.impacts = 3;
  EXPECT_DOUBLE_EQ(value_of("delta", response), 0.4 * 9.0 / 2.0);
  EXPECT_DOUBLE_EQ(value_of("peak_slip_m", response), 0.4);
  EXPECT_DOUBLE_EQ(value_of("residual_slip_m", response), 0.1);
  EXPECT_DOUBLE_EQ(value_of("slid_path_m", response), 0.7);
  EXPECT_DOUBLE_EQ(value_of("peak_rotation_over_alpha", response), 0.05 / std::atan(0.6 / 1.8));
  EXPECT_DOUBLE_EQ(value_of("peak_acceleration_g", response), 2.0);
  EXPECT_DOUBLE_EQ(value_of("impacts", response), 3.0);
  EXPECT_DOUBLE_EQ(value_of("overturned", response), 0.0);
  response.outcome = Outcome::overturned;
  EXPECT_DOUBLE_EQ(value_of("overturned", response), 1.0);
}

TEST(Edp, AnUnknownNameIsToldWithTheNamesThereAre) {
  try {
    find("peak_slip");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("peak_slip_m"));
  }
}

// Of a block of 150 kg.
TEST(Edp, ForcesAreOverTheWeightAndOfAChainInNewton) {
  Response response;
  EXPECT_TRUE(std::isnan(value_of("peak_contact_horizontal_over_weight", response)));
  response.peak_contact_horizontal_mps2 = 0.3 * standard_gravity_mps2;
  response.peak_contact_vertical_mps2 = 1.4 * standard_gravity_mps2;
  response.peak_chain_force_mps2 = 2;
  EXPECT_DOUBLE_EQ(value_of("peak_contact_horizontal_over_weight", response), 0.3);
  EXPECT_DOUBLE_EQ(value_of("peak_contact_vertical_over_weight", response), 1.4);
  EXPECT_DOUBLE_EQ(value_of("peak_chain_force_n", response), 300);
}

TEST(Edp, BlowsOfWallsAreAskedForAsTheyAreTold) {
  Response response;
  EXPECT_EQ(value_of("wall_hit", response), 0);
  response.wall_hits = 3;
  response.wall_speed_mps = 0.45;
  EXPECT_EQ(value_of("wall_hit", response), 1);
  EXPECT_EQ(value_of("wall_speed_mps", response), 0.45);
}

}  // namespace
}  // namespace freestand::edp
