// The study file and the case file as a whole.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <tuple>

#include "dynamics/effect.hpp"
#include "fragility/options.hpp"
#include "intensity/intensity.hpp"
#include "study/accuracy.hpp"
#include "study/block_size.hpp"
#include "study/calibrate_keys.hpp"
#include "study/known.hpp"
#include "study/paths.hpp"
#include "study/posterior_tables.hpp"
#include "study/read_parts.hpp"
#include "study/read_synthetic.hpp"
#include "study/target.hpp"

namespace freestand::study {
namespace {

void read_common(Section& file, const std::filesystem::path& path, Study& study, Files look = Files::look) {
  study.name = file.text("name", path.stem().string());
  study.folder = read_paths_from(file, path, look);
  study.tolerance =
      file.number("tolerance", study.tolerance,
                  {.lower = least_tolerance,
                   .upper = 1e-2,
                   .lower_open = false,
                   .upper_open = false,
                   .why = "it must lie between 1e-12, below which round-off is the greater error, and 0.01"});
  study.free_vibration_s = file.number("free_vibration_s", study.free_vibration_s, range::not_negative);
  study.acceleration_height_m = file.optional_number("acceleration_height_m", range::not_negative);
  study.contact_forces = file.flag("contact_forces", false);
  study.model = read_model(file);
  if (study.contact_forces && study.model.model == Model::bouc_wen)
    file.problem("contact_forces",
                 "contact_forces does not go with model bouc_wen (the forces of its contact are not followed): remove "
                 "it, or set another model");
  const BlockPart& block = study.model.block;
  const double top = block.height ? support(block.height->value).lower : std::numeric_limits<double>::infinity();
  if (study.acceleration_height_m && *study.acceleration_height_m > top)
    file.problem("acceleration_height_m",
                 fmt::format("acceleration_height_m is {:g}, and the block as low as {:g} m (nothing is there to be "
                             "accelerated): lower it",
                             *study.acceleration_height_m, top));
}

constexpr std::uint64_t most_samples = 1ULL << 50;

void read_until(Section& file, Study& study) {
  const YAML::Node* node = file.find("until");
  if (!node) return;
  Section section(*node, "until", file.line("until"), file.problems());
  UntilPart until;
  until.half_width = section.number(
      "half_width", until.half_width,
      {.lower = 0, .upper = 0.5, .upper_open = false, .why = "a half width of a probability lies between 0 and 0.5"});
  until.relative_error = section.optional_number(
      "relative_error", {.lower = 0, .upper = 1, .why = "a standard error lies between 0 and 1 of the probability"});
  until.down_to = section.number(
      "down_to", until.down_to,
      {.lower = 1e-9, .upper = 1, .lower_open = false, .why = "it is a probability, the least that is wanted"});
  until.everywhere = section.flag("everywhere", false);
  until.at_most = section.integer("at_most", 10000000, 1, most_samples);
  if (node->IsMap() && !section.has("half_width") && !section.has("relative_error"))
    section.problem("half_width",
                    "until.half_width is missing (how well must the surface be known?): add half_width: 0.02, or "
                    "relative_error: 0.2");
  if (section.has("down_to") && !section.has("relative_error"))
    section.problem("down_to",
                    "until.down_to is given without relative_error (of which it is the least probability): "
                    "add relative_error: 0.2");
  section.finish();
  if (file.has("samples"))
    file.problem("until",
                 "samples and until are both given (the one fixes the number, the other finds it): remove one");
  study.until = until;
  study.samples = until.at_most;
}

// More samples than this are not kept unless the study says so: their file would have tens of gigabytes.
constexpr std::uint64_t most_kept_unasked = 100'000'000;

void read_keep(Section& file, Study& study) {
  const YAML::Node* node = file.find("keep");
  if (node && node->IsMap()) {
    Section section(*node, "keep", file.line("keep"), file.problems());
    study.keep.one_in = section.integer("thin", 1, 1, most_samples);
    section.finish();
    return;
  }
  const int fallback = study.samples > most_kept_unasked ? 1 : 0;
  study.keep.one_in = file.choice("keep", {"all", "none"}, fallback) == 0 ? 1 : 0;
}

void read_design(Section& file, Study& study) {
  study.seed = file.integer("seed", 1, 0);
  study.design = static_cast<sampling::Design>(file.choice("design", {"monte_carlo", "latin_hypercube", "sobol"}, 2));
  study.scrambles = static_cast<int>(file.integer("scrambles", 1, 1, fragility::most_scrambles));
  if (study.scrambles > 1 && study.design == sampling::Design::monte_carlo)
    file.problem("scrambles",
                 "scrambles are of a design (samples of monte_carlo are independent as they are): remove them, or take "
                 "sobol or latin_hypercube");
  study.samples = file.integer("samples", 0, 1, most_samples);
  study.slip_by_side = file.flag("slip_by_side", false);
  read_until(file, study);
  if (!file.has("samples") && !file.has("until"))
    file.problem("samples",
                 "samples is missing (how many are wanted?): add samples: 20000 or until: {half_width: 0.02}");
  if (study.until && study.design == sampling::Design::latin_hypercube)
    file.problem("design",
                 "latin_hypercube does not go with until (its strata depend on the number of samples): give "
                 "samples, or use sobol");
  read_keep(file, study);
  study.block_size = file.integer(
      "block_size", static_cast<std::uint64_t>(default_block_size(static_cast<std::int64_t>(study.samples))), 1,
      1U << 20);
  if (!few_enough_blocks(study, static_cast<std::int64_t>(study.block_size)))
    file.problem(study.until ? "until" : "samples",
                 fmt::format("{} samples in blocks of {} are too many blocks ({} at most, {} of samples that are kept: "
                             "of each every rank "
                             "knows whether it is finished): lower {}, or raise block_size",
                             study.samples, study.block_size, most_blocks, most_kept_blocks,
                             study.until ? "at_most" : "samples"));
}

// A case is one sample: no distribution anywhere.
void refuse_distributions(const Study& study, Problems& problems) {
  const auto check = [&](const std::optional<Quantity>& q) {
    if (q && !is_fixed(q->value))
      problems.add(q->line, fmt::format("{} is a distribution (a case is one sample): give a number", q->name));
  };
  for (const Quantity& q : quantities(study.model)) check(q);
  for (const auto& source : study.motions) {
    check(source.amplitude);
    check(source.period);
    check(source.storey);
    if (source.building) check(source.building->drawn_period);
    if (source.building) check(source.building->drawn_damping);
  }
}

// A case given for a study, or the other way round, is told as that, and not by what it lacks.
void refuse_other_kind(Section& file, const char* wanted, const char* other, const char* problem, Problems& problems) {
  if (file.has(wanted) || !file.has(other)) return;
  file.problem(other, problem);
  problems.throw_if_any();
}

// Why a study has no values of a demand; "" where it has.
std::string refusal(const KnownEdp& edp, const Study& study) {
  const auto& [effects, chain] = std::tie(study.model.effects, study.model.chain);
  const bool wall =
      study.model.neighbour || (chain && chain->wall_gap) ||
      std::any_of(effects.begin(), effects.end(), [](const auto& part) { return bool(part.effect->wall); });
  if (edp.wants == edp::Wants::sides && !study.slip_by_side)
    return edp.name +
           " is followed only where the study says so (it takes several times as long): add slip_by_side: true, and "
           "sweep with it";
  if (edp.wants == edp::Wants::height && !study.acceleration_height_m)
    return edp.name +
           " is followed only where the study says at which height (it takes several times as long): add "
           "acceleration_height_m: 1.5, and sweep with it";
  const bool forces = edp.wants == edp::Wants::forces || edp.wants == edp::Wants::chain_force ||
                      edp.wants == edp::Wants::contents || edp.wants == edp::Wants::legs;
  if (forces && !study.contact_forces)
    return edp.name +
           " is followed only where the study says so (it takes several times as long): add contact_forces: true, and "
           "sweep with it";
  if (edp.wants == edp::Wants::wall && !wall)
    return edp.name +
           " would be 0 for every sample (no wall stands in this study): remove it, or add the effect "
           "wall_impact, a chain or a neighbour, and sweep with it";
  if ((edp.wants == edp::Wants::chain || edp.wants == edp::Wants::chain_force) && !chain)
    return edp.name +
           " would be 0 for every sample (no chain holds the block of this study): remove it, or add chain, "
           "and sweep with it";
  if (edp.wants == edp::Wants::contents &&
      std::none_of(effects.begin(), effects.end(), [](const auto& part) { return bool(part.effect->contents); }))
    return edp.name +
           " would be 0 for every sample (nothing moves inside the block of this study): remove it, or add effect "
           "moving_contents, and sweep with it";
  if (edp.wants == edp::Wants::legs &&
      std::none_of(effects.begin(), effects.end(), [](const auto& part) { return bool(part.effect->legs); }))
    return edp.name +
           " would be 0 for every sample (the block of this study stands on no legs that flex): remove it, or add "
           "effect "
           "flexible_legs, and sweep with it";
  return "";
}

// What a study may name: its demands, and also what the tables of records bring (record.pga_g).
Known known_of(const Study& study, Known known, Files look) {
  known.any_record = look == Files::ignore;
  for (KnownEdp& edp : known.edps) edp.refusal = refusal(edp, study);
  for (const MotionSource& source : study.motions)
    for (const motion::RecordNumber& number : source.numbers)
      known.intensities.push_back({"record." + number.name, "", 0});
  if (in_a_building(study))
    for (const intensity::Measure* measure : intensity::of_the_ground())
      known.intensities.push_back(known_intensity(*measure));
  return known;
}

}  // namespace

Study read_sweep(const YAML::Node& root, const std::filesystem::path& path, const Known& known, Files look,
                 Problems& problems, int line, FittedAs fitted) {
  Study study;
  sweep_model(root, problems, fitted);
  study.doubtful_draws = read_posterior_tables(root, path.parent_path(), problems);
  Section file(root, "", line, problems);
  problems.throw_if_any();
  refuse_other_kind(
      file, "motions", "motion",
      "motion is what a case has (a study has motions): write motions, or give a case to `freestand simulate`",
      problems);
  read_common(file, path, study, look);
  read_design(file, study);
  study.motions = read_motions(file, study.folder, look, shakes_vertically(study.model));
  check_cross(file, study, look);
  check_neighbour(file, study);
  if (problems.empty()) check_synthetic(file, study);
  // What the study draws is known only when its parts are sound.
  const auto choices = problems.empty() ? axis_choices(study.model, study.motions) : std::vector<AxisChoice>{};
  study.fragility = read_fragility(file, known_of(study, known, look), choices);
  if (problems.empty()) check_target(study, problems);
  file.finish();
  problems.throw_if_any();
  return study;
}

Study parse_study(const std::string& text, const std::filesystem::path& path, const Known& known, Files look,
                  FittedAs fitted) {
  Problems problems(path.string());
  const auto root = parse_yaml(text, problems);
  problems.throw_if_any();
  return read_sweep(*root, path, known, look, problems, 1, fitted);
}

Case parse_case(const std::string& text, const std::filesystem::path& path) {
  Problems problems(path.string());
  Case one;
  if (const auto root = parse_yaml(text, problems)) {
    Section file(*root, "", 1, problems);
    problems.throw_if_any();
    refuse_other_kind(
        file, "motion", "motions",
        "motions is what a study has (a case has motion): write motion, or give a study to `freestand run`", problems);
    read_common(file, path, one.study);
    one.study.samples = one.study.block_size = 1;
    one.study.motions = {read_motion(file, one.study.folder)};
    check_cross(file, one.study, Files::look);
    check_neighbour(file, one.study);
    one.output_step_s = file.number("output_step_s", one.output_step_s, range::positive);
    refuse_distributions(one.study, problems);
    if (one.study.model.slip_discrepancy)
      file.problem("discrepancy", "discrepancy is of a study (a case is the model's own answer): remove it");
    file.finish();
  }
  problems.throw_if_any();
  return one;
}

Study read_study(const std::filesystem::path& file, const Known& known, FittedAs fitted) {
  return parse_study(read_text(file), file, known, Files::look, fitted);
}

Case read_case(const std::filesystem::path& file) { return parse_case(read_text(file), file); }

}  // namespace freestand::study
