// FORMA under the pulses of its tests (table 5.1): how far an edge lifts off, on rigid edges and on legs that give way up and down. The report
// measured 0.489 alpha. How stiff its legs are is not among the tables, so both numbers of them are varied here.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <freestand/simulate.hpp>

#include "base/units.hpp"
#include "report/pounds.hpp"
#include "report/printed_table.hpp"
#include "report/table_pulses.hpp"

namespace freestand::report {
namespace {

// From a little over 1.7 Hz, below which it does not stand, to legs that are all but rigid.
constexpr double leg_frequencies_hz[] = {2, 2.5, 3, 4, 5, 7, 10, 15}, leg_dampings[] = {0.02, 0.05, 0.1};
constexpr double measured_uplift = 0.489;
const std::string tested = "FORMA";

// Shaken along its slender side, its face.
Specimen forma(const Sources& sources, const std::string& friction_kind) {
  const PrintedTable dimensions(sources, "table_3_1.csv"), friction(sources, "table_3_2.csv");
  const auto names = dimensions.texts("specimen");
  const auto i = static_cast<std::size_t>(std::find(names.begin(), names.end(), tested) - names.begin());
  if (i == names.size() || friction.texts("specimen").at(i) != tested)
    throw Error(
        "tables 3.1 and 3.2 have no row for FORMA in one place (a table was changed): give the ones of freestand's "
        "source",
        Exit::data);
  return {Block::rectangular(dimensions.numbers("depth_in")[i] * inch_m, dimensions.numbers("height_in")[i] * inch_m,
                             dimensions.numbers("weight_lb")[i] * pound_kg),
          {friction.numbers("mu_s_" + friction_kind)[i], friction.numbers("mu_k_" + friction_kind)[i]},
          {}};
}

double uplift(const Specimen& specimen, const Shaking& shaking) {
  return respond(specimen, shaking).peak_rotation_rad / specimen.block.alpha_rad();
}

struct Lifts {
  double rigid = 0, least = 1e300, most = 0;
  void on_legs(double uplift) {
    least = std::min(least, uplift);
    most = std::max(most, uplift);
  }
};

Item uplift_on_legs(const Sources& sources) {
  TablePulses pulses;
  const PrintedTable tests(sources, "table_5_1.csv");
  const auto specimens = tests.texts("specimen"), motions = tests.texts("motion"), types = tests.texts("pulse_type");
  const auto periods = tests.numbers("pulse_period_s"), velocities = tests.numbers("pulse_velocity_in_per_s");
  Item item;
  Sheet sheet{"uplift_on_legs", {"friction", "motion", "frequency_hz", "damping", "uplift", "rigid_uplift"}, {}};
  for (const auto& [kind, words] : {std::pair{"coulomb_fit", "friction that fits histories"},
                                    std::pair{"slow_pull", "friction of the slow pulls"}}) {
    Lifts all;
    for (std::size_t i = 0; i < specimens.size(); ++i) {
      if (specimens[i] != tested) continue;
      Specimen specimen = forma(sources, kind);
      const Shaking shaking = pulses.shaking(types[i], periods[i], velocities[i]);
      const double rigid = uplift(specimen, shaking);
      all.rigid = std::max(all.rigid, rigid);
      for (const double frequency : leg_frequencies_hz)
        for (const double damping : leg_dampings) {
          specimen.legs = {frequency, damping};
          const double on_legs = uplift(specimen, shaking);
          all.on_legs(on_legs);
          sheet.rows.push_back({tested, std::string(words), motions[i], frequency, damping, on_legs, rigid});
        }
    }
    const bool within = all.least < measured_uplift && measured_uplift < all.most;
    item.statements.push_back(
        {std::string("uplift_on_legs.") + kind, std::string("largest rotation of FORMA over alpha, ") + words,
         fmt::format("{:.2g} on rigid edges; {:.2g} to {:.2g} on legs of 2 to 15 Hz that bend under its weight",
                     all.rigid, all.least, all.most),
         fmt::format("{}, measured", measured_uplift),
         within ? Verdict::agrees : Verdict::disagrees,
         within ? "" : "neither kind of legs turns it so far under the pulses that stand for its motions"});
  }
  item.sheets = {sheet};
  item.left_out = {"how stiff FORMA's legs are, and the motion under which it lifted, are not among the tables"};
  return item;
}

const RegisteredItem uplift_on_legs_here{
    {.name = "uplift_on_legs",
     .order = 430,
     .chapter = 4,
     .place = "Chapter 4",
     .what = "how far FORMA lifts an edge, on rigid edges and on legs that give way",
     .compute = uplift_on_legs}};

}  // namespace
}  // namespace freestand::report
