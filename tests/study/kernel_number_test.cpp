#include "study/kernel_number.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <fstream>
#include <set>

#include "base/random.hpp"
#include "study/evaluator.hpp"
#include "study/known.hpp"
#include "support/scratch.hpp"

namespace freestand::study::kernel_number_test {
namespace {

const std::string block = "block: {width_m: {uniform: [0.45, 0.7]}, height_m: {uniform: [1.5, 2.2]}, mass_kg: 200}\n";
const std::string friction = "friction: {mu_k: {uniform: [0.15, 0.5]}, static_ratio: 1.2}\n";
const std::string pulses =
    "motions: [{pulse: [A, B, C1, C2], period_s: {uniform: [0.4, 1.2]}, peak_acceleration_g: {uniform: [0.2, 1.2]}}]\n";
const std::string records = "motions: [{records: \"*.csv\", scale_to: {pta_g: {uniform: [0.3, 1]}}}]\n";

// The whole of the kernel once: models, impact laws, motions, and every effect beside both kinds of motions.
std::vector<std::string> studies() {
  std::vector<std::string> texts;
  for (const std::string& motions : {pulses, records}) {
    for (const char* model :
         {"slide", "rock", "slide_rock", "bouc_wen\nbouc_wen: {yield_displacement_m: 0.00254, exponent: 2}"})
      texts.push_back(block + friction + fmt::format("model: {}\n", model) + motions);
    texts.push_back(block + friction + "impact: {law: coulomb}\n" + motions);
    texts.push_back(block + friction + "chain: {slack_m: 0.02, stiffness_npm: 4e5, strength_n: 2736}\n" + motions);
    texts.push_back(block +
                    "friction: {mu: {uniform: [0.15, 0.5]}}\n"
                    "effects: [{name: static_friction, ratio: {uniform: [1.1, 1.5]}}]\n" +
                    motions);
    for (const char* effect :
         {"rate_weakening, drop: 0.4, speed_mps: 0.1", "rate_strengthening, rise: 0.4, speed_mps: 0.1",
          "friction_wear, ratio: 0.6, path_m: 0.1", "directional_friction, asymmetry: 0.2",
          "pressure_friction, exponent: 0.9", "viscous_drag, rate_per_s: 0.5", "floor_tilt, angle_rad: 0.01",
          "flexible_legs, frequency_hz: 8, damping: 0.05",
          "slack_tether, slack_m: 0.03, frequency_hz: 5, rate_per_s: 2", "centering_spring, frequency_hz: 0.8",
          "wall_impact, gap_m: 0.05, restitution: 0.4",
          "moving_contents, mass_ratio: 0.2, frequency_hz: 2, damping: 0.05", "impact_loss, factor: 0.9",
          "reduced_base, ratio: 0.9", "offset_mass, eccentricity: 0.1",
          "x, friction: \"mu*(1 + a*sin(u))\", parameters: {a: 0.3}"})
      texts.push_back(block + friction + fmt::format("effects: [{{name: {}}}]\n", effect) + motions);
  }
  texts.push_back(block + friction + "effects: [{name: vertical_shaking, scale: 0.7}]\n" + records);
  // Thrown up, with what acts in flight, and several laws together.
  for (const char* more : {"", ", {name: centering_spring, frequency_hz: 0.8}", ", {name: floor_tilt, angle_rad: 0.05}",
                           ", {name: wall_impact, gap_m: 0.02, restitution: 0.4}",
                           ", {name: viscous_drag, rate_per_s: 0.5}, {name: friction_wear, ratio: 0.6, path_m: 0.1}, "
                           "{name: slack_tether, slack_m: 0.01, frequency_hz: 3, rate_per_s: 2}"})
    texts.push_back(block + friction + fmt::format("effects: [{{name: vertical_shaking, scale: 6}}{}]\n", more) +
                    records);
  // On a slope a contact with a loose yield rings on; a foot under legs slips while its block tips.
  texts.push_back(block + friction +
                  "model: bouc_wen\nbouc_wen: {yield_displacement_m: 0.005, exponent: 1.6}\neffects: " +
                  "[{name: floor_tilt, angle_rad: 0.1}]\n" + records);
  texts.push_back(
      "block: {width_m: 0.5, height_m: 1, mass_kg: 100}\nfriction: {mu_k: {uniform: [0.35, 0.45]}, static_ratio: 1.2}\n"
      "effects: [{name: flexible_legs, frequency_hz: 3, damping: 0.01}, {name: friction_wear, ratio: 1.5, path_m: "
      "0.2}]\n"
      "motions: [{pulse: [A, B], period_s: {uniform: [2, 4]}, peak_acceleration_g: {uniform: [0.6, 1]}}]\n");
  // On legs a row of hops ends.
  texts.push_back(
      "block: {width_m: 0.7, height_m: 1, mass_kg: 100}\nfriction: {mu_k: {uniform: [0.6, 0.9]}}\n"
      "effects: [{name: flexible_legs, frequency_hz: 4, damping: 0.03}]\n" +
      records);
  // Conditions on what is zero for long, and on conditions.
  texts.push_back(
      block + friction +
      "model: slide\neffects: [{name: x, friction: \"if((path>0)*(abs(theta)<0.1),0.6,0.9)*if(v>0,mu,1.2*mu)\"}]\n" +
      records);
  // A condition that holds for a slip to the one side earlier than for one to the other.
  texts.push_back(block + friction +
                  "model: slide\neffects: [{name: x, friction: \"if(abs(t - 2 - 0.5*sigma) < 0.05, 0.02, mu)\"}]\n" +
                  records);
  // Walls beside a block whose centre of mass is not in the middle of its height.
  texts.push_back(
      "block: {width_m: {uniform: [0.5, 0.7]}, height_m: 1.6, centre_height_m: 0.5}\nfriction: {mu: 2}\n"
      "effects: [{name: wall_impact, gap_m: {uniform: [0.01, 0.05]}, restitution: 0.5}]\n" +
      records);
  // What the floor holds at rest until its motion ends.
  texts.push_back(
      block + friction +
      "model: slide\neffects: [{name: slack_tether, slack_m: 0.02, frequency_hz: 3, rate_per_s: 0}]\nmotions: "
      "[{pulse: rectangular, period_s: 0.7, peak_acceleration_g: {uniform: [-0.6, -0.2]}}]\n");
  // A blow stops the slip within a row of hops, and it goes on.
  texts.push_back(
      "block: {width_m: 0.61, height_m: 1.6, mass_kg: 100}\nfriction: {mu: 0.4}\nimpact: {law: coulomb}\n"
      "effects: [{name: offset_mass, eccentricity: -0.08}]\nmotions: [{records: \"record2.csv\", scale: 1.73}]\n");
  for (const char* design : {"monte_carlo", "latin_hypercube"})
    texts.push_back(block + friction + fmt::format("design: {}\n", design) + pulses);
  // In the plane of the floor: thrown up too, and under friction that differs between directions.
  for (const char* friction_there : {"mu_k: {uniform: [0.1, 0.4]}, static_ratio: 1.2",
                                     "mu: {uniform: [0.1, 0.4]}, ratio_across: 0.7, axis_rad: 0.3"})
    for (const char* shaken : {"", "effects: [{name: vertical_shaking, scale: 6}]\n"})
      texts.push_back(
          block + fmt::format("friction: {{{}}}\nmodel: slide\n{}", friction_there, shaken) +
          "motions: [{records: \"*.csv\", cross_records: \"across/*.csv\", scale_to: {pta_g: {uniform: [0.3, 1]}}}]\n");
  return texts;
}

// What stands under, beside and behind a block, how it begins, and the demands that a study must ask for.
std::vector<std::string> surroundings() {
  std::vector<std::string> texts;
  const std::string sides = "slip_by_side: true\n", height = "acceleration_height_m: 1.2\n",
                    forces = "contact_forces: true\n";
  for (const std::string& motions : {pulses, records}) {
    for (const std::string& more :
         {std::string("legs: {vertical_frequency_hz: {uniform: [3, 6]}, vertical_damping: 0.05}\n"),
          std::string(
              "model: slide\nneighbour: {gap_m: {uniform: [0.01, 0.04]}, mass_kg: 300, mu_k: 0.2, static_ratio: "
              "1.2, restitution: 0.4, side: left}\n"),
          std::string("start: {rotation_rad: {uniform: [-0.1, 0.1]}, rotation_rate_radps: 0.1, slip_m: 0.02, "
                      "slip_velocity_mps: 0.1}\n"),
          forces +
              "chain: {slack_m: 0.01, stiffness_npm: 1e5, strength_n: 2000, elevation_rad: {uniform: [-0.3, 0.6]}, "
              "plan_angle_rad: 0.4, number: 2, damping_nspm: 200, height_m: 1.4, side: left, wall_gap_m: 0.02}\n",
          std::string("effects: [{name: wall_impact, gap_m: {uniform: [0.01, 0.05]}, restitution: 0.4, other_gap_m: "
                      "{uniform: [0.01, 0.05]}}]\n"),
          std::string("effects: [{name: x, friction: \"mu*(1 + a*log(1 + rest/c))\", parameters: {a: 0.2, c_s: "
                      "0.1}}]\n"),
          sides, sides + "model: slide\n", height, height + "effects: [{name: offset_mass, eccentricity: 0.1}]\n",
          forces, forces + "effects: [{name: moving_contents, mass_ratio: 0.2, frequency_hz: 3, damping: 0.05}]\n",
          forces + "effects: [{name: flexible_legs, frequency_hz: 4, damping: 0.03}]\n"})
      texts.push_back(block + friction + more + motions);
  }
  return texts;
}

void write_records(const std::filesystem::path& folder, const std::vector<int>& numbers) {
  std::filesystem::create_directories(folder);
  for (const int number : numbers) {
    std::ofstream file(folder / fmt::format("record{}.csv", number));
    file << "time_s,floor_acceleration_mps2,floor_vertical_acceleration_mps2\n";
    // Triangular waves of growing length: no function of the mathematical library, whose last bits may differ.
    for (int i = 0; i <= 400; ++i) {
      const double saw = std::abs(std::fmod(0.013 * number * i * (1 + 0.001 * i), 1.0) - 0.5) - 0.25;
      file << fmt::format("{:.2f},{:.9f},{:.9f}\n", 0.02 * i, 12 * saw * (400 - i) / 400, 3 * saw);
    }
  }
}

// The first twelve samples of each study.
struct Rows {
  std::vector<Column> columns;
  std::vector<double> values;
};
std::vector<Rows> all_rows() {
  const freestand::test::Scratch scratch("kernel_number");
  write_records(scratch.folder(), {1, 2});
  write_records(scratch / "across", {3, 5});
  std::vector<Rows> all;
  std::vector<std::string> texts = studies();
  for (const std::string& text : surroundings()) texts.push_back(text);
  for (const std::string& text : texts) {
    const Study study = parse_study("seed: 3\nsamples: 12\nfragility: {im: pta_g, edp: [peak_slip_m]}\n" + text,
                                    scratch / "study.yaml", registries());
    const Evaluator evaluator(study, load_motions(study));
    all.push_back({evaluator.columns(), {}});
    evaluator.append(0, 12, all.back().values);
  }
  return all;
}

// Of the bits of all columns; every nan is one.
TEST(KernelNumber, IsThatOfTheNumbersThisProgramGives) {
  std::uint64_t hash = 0;
  for (const Rows& rows : all_rows())
    for (const double value : rows.values) {
      const auto bits = std::isnan(value) ? ~std::uint64_t{0} : std::bit_cast<std::uint64_t>(value);
      hash = random::mix(hash ^ bits);
    }
  EXPECT_EQ(kernel_number, static_cast<std::uint32_t>(hash))
      << fmt::format("samples have other bits than before: in src/study/kernel_number.hpp write 0x{:08x}",
                     static_cast<std::uint32_t>(hash));
}

TEST(KernelNumber, SeesEveryDemand) {
  std::set<std::string> seen;
  for (const Rows& rows : all_rows())
    for (std::size_t i = 0; i < rows.values.size(); ++i)
      if (std::isfinite(rows.values[i]) && rows.values[i] != 0) seen.insert(rows.columns[i % rows.columns.size()].name);
  for (const auto& demand : registries().edps) EXPECT_TRUE(seen.contains("edp_" + demand.name)) << demand.name;
}

}  // namespace
}  // namespace freestand::study::kernel_number_test
