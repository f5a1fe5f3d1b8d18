#include "study/kernel_number.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <fstream>
#include <map>

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

// The whole of the kernel once: models, impact laws, motions, and every effect beside both kinds of motions. New effects,
// demands and intensities are not asked for: they change no number of old.
std::vector<std::string> studies() {
  std::vector<std::string> texts;
  for (const std::string& motions : {pulses, records}) {
    for (const char* model :
         {"slide", "rock", "slide_rock", "bouc_wen\nbouc_wen: {yield_displacement_m: 0.00254, exponent: 2}"})
      texts.push_back(block + friction + fmt::format("model: {}\n", model) + motions);
    texts.push_back(block + friction + "impact: {law: coulomb}\n" + motions);
    texts.push_back(block + friction + "chain: {slack_m: 0.02, stiffness_npm: 4e5, strength_n: 2736}\n" + motions);
    for (const char* effect :
         {"static_friction, ratio: {uniform: [1.1, 1.5]}", "rate_weakening, drop: 0.4, speed_mps: 0.1",
          "rate_strengthening, rise: 0.4, speed_mps: 0.1", "friction_wear, ratio: 0.6, path_m: 0.1",
          "directional_friction, asymmetry: 0.2", "pressure_friction, exponent: 0.9", "viscous_drag, rate_per_s: 0.5",
          "floor_tilt, angle_rad: 0.01", "flexible_legs, frequency_hz: 8, damping: 0.05",
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

// Hashes the bits of the rows; every nan is one.
std::uint64_t hash_of(const Evaluator& evaluator, std::uint64_t hash) {
  std::vector<double> values;
  evaluator.append(0, 12, values);
  const std::size_t width = evaluator.columns().size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string& column = evaluator.columns()[i % width].name;
    const bool old_demand = column == "edp_peak_slip_m" || column == "edp_residual_slip_m" || column == "edp_delta" ||
                            column == "edp_slid_path_m" || column == "edp_peak_rotation_over_alpha" ||
                            column == "edp_peak_acceleration_g" || column == "edp_impacts" ||
                            column == "edp_overturned" || column == "edp_connection_failed" ||
                            column == "edp_wall_hit" || column == "edp_wall_speed_mps";
    const bool new_parameter = column == "effects_wall_impact_side" || column == "effects_wall_impact_other_gap_m";
    if ((column.starts_with("edp_") && !old_demand) || new_parameter) continue;
    const auto bits = std::isnan(values[i]) ? ~std::uint64_t{0} : std::bit_cast<std::uint64_t>(values[i]);
    hash = random::mix(hash ^ bits);
  }
  return hash;
}

TEST(KernelNumber, IsThatOfTheNumbersThisProgramGives) {
  const freestand::test::Scratch scratch("kernel_number");
  write_records(scratch.folder(), {1, 2});
  write_records(scratch / "across", {3, 5});
  std::uint64_t hash = 0;
  for (const std::string& text : studies()) {
    const Study study = parse_study("seed: 3\nsamples: 12\nfragility: {im: pta_g, edp: [peak_slip_m]}\n" + text,
                                    scratch / "study.yaml", registries());
    hash = hash_of(Evaluator(study, load_motions(study)), hash);
  }
  EXPECT_EQ(kernel_number, static_cast<std::uint32_t>(hash))
      << fmt::format("samples have other bits than before: in src/study/kernel_number.hpp write 0x{:08x}",
                     static_cast<std::uint32_t>(hash));
}

}  // namespace
}  // namespace freestand::study::kernel_number_test
