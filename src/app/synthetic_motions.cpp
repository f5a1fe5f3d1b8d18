#include "app/synthetic_motions.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <freestand/error.hpp>
#include <vector>

#include "base/folder.hpp"
#include "io/output_folder.hpp"
#include "motion/record_figures.hpp"
#include "study/read_synthetic.hpp"
#include "study/synthetic_set.hpp"

namespace freestand::app {
namespace {

namespace fs = std::filesystem;

void check(const SyntheticOptions& options, const study::SyntheticPart& part) {
  if (options.number >= part.count)
    throw Error(fmt::format("--number {} is none of {} (it has {} motions, the first is 0): name one of these",
                            options.number, options.file, part.count));
  if (const std::string why = refusal(part, options.seed); !why.empty())
    throw Error(fmt::format("{}: {}", options.file, why));
  if (!options.csv.empty() && (options.convert.empty() || options.number >= 0))
    throw Error(
        "--csv is a table of files (there are none of the motions of a set): add --convert FOLDER, without --number");
  if (options.number < 0 && fs::exists(options.convert) && !fs::is_empty(options.convert))
    throw Error(
        options.convert +
        " exists already (all motions of a set go to a new folder): choose another name, or one motion by --number");
}

std::string parameters_text(const study::SyntheticPart& part, const motion::SyntheticParameters& parameters) {
  const std::vector<double> values = study::synthetic_values(parameters);
  std::string text = "  drawn:";
  std::size_t i = 0;
  for (const motion::RecordNumber& number : study::synthetic_numbers(part))
    text += fmt::format("  {} {:.4g}", number.name, values[i++]);
  if (parameters.pulse)
    text += fmt::format("  pulse {} of {:.4g} s", parameters.pulse->type, parameters.pulse->period_s);
  return text + "\n";
}

}  // namespace

void show_synthetic(const SyntheticOptions& options) {
  const study::SyntheticPart part = study::read_synthetic_file(options.file);
  check(options, part);
  const bool one = options.number >= 0;
  if (!one && !options.convert.empty()) make_folder(options.convert);
  std::vector<motion::ToldRecord> told;
  for (int n = one ? options.number : 0; n < (one ? options.number + 1 : part.count); ++n) {
    const auto number = static_cast<std::uint64_t>(n);
    const FloorMotion motion = study::realisation(part, options.seed, number);
    const fs::path file = one ? fs::path(options.convert) : fs::path(options.convert) / (motion.name + ".csv");
    told.push_back({file, "", "", motion::record_figures(motion)});
    fmt::print("{}\n{}{}", motion.name, parameters_text(part, study::synthetic_parameters(part, options.seed, number)),
               motion::figures_text(told.back().figures));
    if (!options.convert.empty()) io::write_text(file, motion::floor_csv(motion));
  }
  const fs::path csv = options.csv;
  if (!csv.empty()) io::write_text(csv, motion::figures_csv(told, csv.has_parent_path() ? csv.parent_path() : "."));
}

}  // namespace freestand::app
