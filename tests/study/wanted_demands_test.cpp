// Demands that a study has values of only with what makes them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study_text.hpp"

namespace freestand::study::wanted_demands_test {
namespace {

using namespace test;
using testing::HasSubstr;

// Else they would be 0 for every sample, within a narrow band.
TEST(WantedDemands, ComeWithWhatMakesThem) {
  const std::string wall = "effects: [{name: wall_impact, gap_m: 0.1}]\n",
                    chain = "chain: {stiffness_npm: 1e4, strength_n: 2736}\n";
  struct Demand {
    std::string name, condition, says;
    std::vector<std::string> made_by;
  };
  for (const Demand& demand :
       {Demand{"peak_slip_right_m", "peak_slip_right_m > 0.05", "followed only where", {"slip_by_side: true\n"}},
        Demand{"peak_contact_vertical_over_weight",
               "peak_contact_vertical_over_weight > 1.5",
               "add contact_forces: true",
               {"contact_forces: true\n"}},
        Demand{"peak_chain_force_n",
               "peak_chain_force_n > 100",
               "followed only where",
               {"contact_forces: true\n" + chain}},
        Demand{"peak_contents_acceleration_g",
               "peak_contents_acceleration_g > 1",
               "add contact_forces: true",
               {"contact_forces: true\neffects: [{name: moving_contents, mass_ratio: 0.2, frequency_hz: 3}]\n"}},
        Demand{"leg_fatigue_m",
               "leg_fatigue_m > 0.01",
               "add contact_forces: true",
               {"contact_forces: true\neffects: [{name: flexible_legs, frequency_hz: 5}]\n"}},
        Demand{"wall_hit", "wall_hit", "0 for every sample (no wall stands in this study)", {wall, chain}},
        Demand{"connection_failed", "connection_failed", "0 for every sample (no chain holds", {chain}}}) {
    const std::string sound = block + friction + samples + motions + "fragility:\n  im: report\n  edp: [delta";
    const std::string named = sound + ", " + demand.name + "]\n",
                      in_damage = sound + "]\n  damage: {hits: \"" + demand.condition + "\"}\n";
    EXPECT_THAT(problems(named), HasSubstr("some.yaml:7: fragility.edp: " + demand.name + " "));
    EXPECT_THAT(problems(in_damage), HasSubstr("some.yaml:8: damage state hits: " + demand.name + " "));
    for (const std::string& text : {named, in_damage}) {
      EXPECT_THAT(problems(text), HasSubstr(demand.says));
      for (const std::string& made : demand.made_by) EXPECT_EQ(problems(made + text), "");
    }
  }
  EXPECT_THAT(
      problems(block + friction + samples + motions + chain +
               "model: bouc_wen\nbouc_wen: {yield_displacement_m: 0.001, exponent: 2}\nfragility: {edp: [wall_hit]}\n"),
      HasSubstr("no wall stands in this study"));
}
}  // namespace
}  // namespace freestand::study::wanted_demands_test
