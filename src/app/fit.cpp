#include "study/fit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "app/command.hpp"
#include "app/times.hpp"
#include "base/folder.hpp"

namespace freestand::app {
namespace {

struct FitOptions {
  std::string folder, into;
  study::FragilityChanges changes;
  bool overwrite = false, quiet = false, rank = false;
};

// "by fragility.im as the command line says and by fragility.bins as study.yaml says since the sweep"
std::string origin(const study::FitSummary& summary, const FitOptions& options) {
  const std::vector<std::string> asked = options.changes.keys();
  std::vector<std::string> edited = summary.changed, parts;
  std::erase_if(edited,
                [&](const std::string& key) { return std::find(asked.begin(), asked.end(), key) != asked.end(); });
  // Demands and intensities take their capacities, thresholds and bins along.
  if (!options.changes.edp.empty() || !options.changes.capacities.empty())
    std::erase_if(edited,
                  [](const std::string& key) { return key == "fragility.capacities" || key == "fragility.still"; });
  if (!options.changes.im.empty()) std::erase(edited, "fragility.bins");
  if (!asked.empty()) parts.push_back(fmt::format("by {} as the command line says", fmt::join(asked, ", ")));
  if (!edited.empty())
    parts.push_back(fmt::format("by {} of {}, which was edited after the sweep", fmt::join(edited, ", "),
                                study::study_path(options.folder).string()));
  return parts.empty() ? "by the study as it was swept" : fmt::format("{}", fmt::join(parts, " and "));
}

void tell(const study::FitSummary& summary, const FitOptions& options) {
  for (const std::string& note : summary.notes) fmt::print("{}\n", note);
  fmt::print("{}{}", summary.ranking, warnings_text(summary, options.into.empty() ? options.folder : options.into));
  const bool here = options.into.empty();
  fmt::print("{} samples fitted over {} in {}, {}; results in {}{}\n", summary.samples, summary.intensity,
             short_duration(summary.wall_s), origin(summary, options), here ? options.folder : options.into,
             here ? ", in place of the fit that was there (-o DIR2 keeps it)" : "");
}

// Else a folder would be made for nothing.
void check(const FitOptions& options) {
  const std::string& folder = options.folder;
  const auto samples = study::samples_path(folder);
  if (!is_there(samples) && is_there(std::filesystem::path(folder) / "fragility.h5"))
    throw Error(fmt::format("{} holds a fit, and no samples (its summary.json says samples_in): name the folder of the "
                            "sweep",
                            folder),
                Exit::data);
  study::check_fit({.from = folder, .changes = options.changes});
}

Exit run(const Context& context, const FitOptions& options) {
  context.world.on_root([&] { check(options); });
  const bool here = options.into.empty();
  study::RunFolder into(context.world, here ? options.folder : options.into, io::existing(options.overwrite, here),
                        here ? "start again" : "start again with --overwrite",
                        {.writes = here ? std::vector<std::string>{} : std::vector{study::study_path("").string()},
                         .reads = {study::samples_path(options.folder), study::study_path(options.folder)}});
  const study::FitSummary summary = study::fit(context.world, into,
                                               {.from = options.folder,
                                                .changes = options.changes,
                                                .command = context.command_line,
                                                .quiet = options.quiet,
                                                .whole_ranking = options.rank});
  if (context.world.is_root() && !options.quiet) tell(summary, options);
  return Exit::done;
}

}  // namespace

void add_fit(CLI::App& parser, Work& work) {
  auto options = std::make_shared<FitOptions>();
  CLI::App* verb = parser.add_subcommand(
      "fit", "the second half of run: samples.h5 -> fragility.h5, tables, summary; over any intensity");
  verb->add_option("folder", options->folder, "folder of a sweep")->required();
  verb->add_option("--im", options->changes.im, "another intensity: pgv_mps, sa_g:0.5 (period in s); see freestand im");
  verb->add_option("--bins", options->changes.bins,
                   "other bins: 12 (as many samples in each), 0.1,0.2,0.5 (edges), \"{count: 12, spacing: log}\"");
  verb->add_option("--edp", options->changes.edp, "other demands: peak_slip_m,overturned; see freestand edp")
      ->delimiter(',');
  verb->add_option("--capacities", options->changes.capacities,
                   "other capacities: peak_slip_m=0.05,0.1; once a demand, or as a study has them, \"{peak_slip_m: "
                   "[0.05, 0.1]}\"")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  verb->add_option(
          "--target", options->changes.target,
          "other distributions of what was swept: \"friction.mu_k={lognormal: {median: 0.3, dispersion: 0.2}}\"")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  verb->add_option("--confidence", options->changes.confidence, "of every band, as 0.9; risk and exports take it over");
  auto* output = verb->add_option("-o,--output", options->into,
                                  "folder for the results; else that of the sweep, whose fit they replace");
  verb->add_flag("--overwrite", options->overwrite, "replace results that are already in the folder of -o")
      ->needs(output);
  verb->add_flag("--rank", options->rank, "print the whole ranking of the intensities, as ranking.csv holds it");
  verb->add_flag("--quiet", options->quiet, "no progress, no summary, no warnings");
  verb->callback([options, &work] { work = [options](const Context& context) { return run(context, *options); }; });
}

}  // namespace freestand::app
