// Table 9.2: peak equipment acceleration (PEA) of the Kelvinator on its chains against the free one. Two tests survive of it.
// The report's slack and stiffness of the chains are not among its tables, so both are varied here, each test under the pulse
// that table 5.1 gives for its motion, in both signs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <freestand/simulate.hpp>

#include "base/units.hpp"
#include "dynamics/chain.hpp"
#include "report/pounds.hpp"
#include "report/printed_table.hpp"
#include "report/table_pulses.hpp"

namespace freestand::report {
namespace {

constexpr double slacks_m[] = {0, 0.005, 0.01, 0.02, 0.04}, frequencies_hz[] = {3, 5, 8, 12, 20};

struct ChainTest {
  const char *motion, *pulse;
  double period_s, velocity_in_per_s, chained_g, free_g, printed_ratio;
};
constexpr ChainTest tests[] = {{"Aigion OTE FP", "B", 0.53, 24, 1.57, 0.47, 3.3}, {"Coyote Lake Gilroy #6 FN", "C1", 0.7, 20, 3.22, 0.43, 7.5}};

Specimen kelvinator(const Sources& sources) {
  const PrintedTable dimensions(sources, "table_3_1.csv"), friction(sources, "table_3_2.csv");
  for (std::size_t i = 0; i < dimensions.rows(); ++i)
    if (dimensions.texts("specimen")[i] == "Kelvinator")
      return {Block::rectangular(dimensions.numbers("width_in")[i] * inch_m, dimensions.numbers("height_in")[i] * inch_m, dimensions.numbers("weight_lb")[i] * pound_kg),
              {friction.numbers("mu_s_coulomb_fit")[i], friction.numbers("mu_k_coulomb_fit")[i]},
              {}};
  return {};
}

double pea_g(const Specimen& specimen, const Shaking& shaking) { return respond(specimen, shaking).peak_acceleration_mps2 / standard_gravity_mps2; }

// Chain at the top edge, cross-chained connection; stiffness by the frequency of the block on it.
Specimen chained(Specimen specimen, double slack_m, double frequency_hz) {
  const dynamics::Chain chain{.slack_m = slack_m,
                              .stiffness_npm = specimen.block.mass_kg * std::pow(2 * pi * frequency_hz, 2),
                              .strength_n = 705 * pound_n,
                              .height_m = 2 * specimen.block.height_m};
  specimen.effects = {dynamics::use(chain, specimen.block)};
  return specimen;
}

Item table_9_2(const Sources& sources) {
  const Specimen free = kelvinator(sources);
  TablePulses pulses;
  Item item;
  Sheet sheet{"table_9_2", {"sign", "slack_m", "frequency_hz", "pea_chained_g", "pea_free_g", "ratio"}, {}};
  for (const ChainTest& test : tests) {
    double least = 1e300, most = 0;
    for (const double sign : {1.0, -1.0})
      for (const double slack : slacks_m)
        for (const double frequency : frequencies_hz) {
          const Shaking shaking = pulses.shaking(test.pulse, test.period_s, sign * test.velocity_in_per_s);
          const double held = pea_g(chained(free, slack, frequency), shaking), loose = pea_g(free, shaking);
          least = std::min(least, held / loose);
          most = std::max(most, held / loose);
          sheet.rows.push_back({std::string(test.motion), sign, slack, frequency, held, loose, held / loose});
        }
    const std::string id = std::string("table_9_2.") + test.pulse, name = test.motion;
    item.numbers.push_back(compared({.id = id + ".measured_ratio", .what = name + ": measured PEA on chains over free", .ours = test.chained_g / test.free_g,
                                     .print = test.printed_ratio, .print_unit = 0.1},
                                    Verdict::print_disagrees_with_itself, "does not follow from the two printed accelerations"));
    item.numbers.push_back({.id = id + ".free", .what = name + ": PEA of the free block under the pulse (measured: " + fmt::format("{:.2f} g)", test.free_g), .unit = "g",
                            .ours = pea_g(free, pulses.shaking(test.pulse, test.period_s, test.velocity_in_per_s))});
    const bool within = test.printed_ratio > least && test.printed_ratio < most;
    item.statements.push_back({id + ".ratio", name + ": chains raise the peak acceleration", fmt::format("{:.1f} to {:.1f} times, as slack and stiffness go", least, most),
                               fmt::format("{:.1f} times", test.printed_ratio), within ? Verdict::agrees : Verdict::disagrees,
                               within ? "" : "slack and stiffness of the chains, the angle of crossed ones and the recorded motion are not printed"});
  }
  item.sheets = {sheet};
  item.left_out = {"the other tests of table 9.2, and the histories of chapter 9, are not among the tables"};
  return item;
}

const RegisteredItem table_9_2_here{{.name = "table_9_2",
                                     .order = 920,
                                     .chapter = 9,
                                     .place = "Table 9.2",
                                     .what = "peak acceleration on chains against the free equipment",
                                     .compute = table_9_2}};

}  // namespace
}  // namespace freestand::report
