#include <fmt/format.h>

#include <memory>
#include <set>
#include <string>

#include "app/command.hpp"
#include "app/times.hpp"
#include "io/output_folder.hpp"
#include "parallel/progress.hpp"
#include "study/doubts.hpp"
#include "study/fit.hpp"
#include "study/known.hpp"
#include "study/motion_bytes.hpp"
#include "study/motion_summaries.hpp"
#include "study/posterior_tables.hpp"
#include "study/realise.hpp"
#include "study/sweep.hpp"
#include "study/sweep_size.hpp"

namespace freestand::app {
namespace {

struct RunOptions {
  std::string study;
  std::string folder;
  bool check = false, overwrite = false, resume = false, quiet = false, best = false;
};

// Every rank reads the study; what is wrong with it is found on all of them alike and told once.
study::Study read(const Context& context, const RunOptions& options) {
  const auto read_it = [&] {
    return study::read_study(options.study, study::registries(),
                             options.best ? study::FittedAs::best : study::FittedAs::draws);
  };
  context.world.on_root(read_it);
  return read_it();
}

// What is doubtful, records that cannot be read, and bins that cannot be laid, are told as the sweep would tell them.
Exit check(const Context& context, const RunOptions& options) {
  const study::Study study = read(context, options);
  const study::MotionSet motions = study::load_motions_together(context.world, study);
  const study::Evaluator evaluator(study, motions, study::summarize_together(context.world, study, motions, nullptr));
  const parallel::NodeSize node = parallel::narrowest_node(context.world);
  std::string size;
  std::set<std::string> told;
  context.world.on_root([&] {
    study::tell_doubts(study, motions, told);
    const study::SweepSize found = study::size_of(study, study::Target(study), evaluator);
    study::refuse_too_large(found, node);
    size = study::told(found);
  });
  if (context.world.is_root()) fmt::print("{}# {}\n", study::expanded(study, ""), size);
  return Exit::done;
}

constexpr const char* go_on = "go on with --resume";

// A full disk, or what else has to be cured, costs nothing that was written before.
study::SweepSummary sweep(const Context& context, const study::Study& study, const study::SweepOptions& options,
                          study::RunFolder& folder) {
  try {
    return study::sweep(context.world, study, options, folder);
  } catch (const Error& error) {
    if (error.exit() != Exit::cure) throw;
    std::string text = error.what();
    if (!text.ends_with(go_on)) text += fmt::format("; {}", go_on);
    if (dynamic_cast<const parallel::SharedError*>(&error)) throw parallel::SharedError(text, Exit::cure);
    throw Error(text, Exit::cure);
  }
}

Exit sweep_and_fit(const Context& context, const RunOptions& options, bool with_fit) {
  if (options.check) return check(context, options);
  if (options.folder.empty()) throw Error("no output folder (-o is missing): give -o DIR");
  const study::Study study = read(context, options);
  study::RunFolder folder(context.world, options.folder, io::existing(options.overwrite, options.resume), go_on,
                          {.writes = {study::study_path("").string()}, .reads = study::files_of_study(options.study)});
  const study::SweepSummary summary = sweep(context, study, {options.quiet, context.command_line, with_fit}, folder);
  study::FitSummary fitted;
  if (with_fit)
    fitted = study::fit(
        context.world, folder,
        {.from = options.folder, .command = context.command_line, .quiet = options.quiet, .sweep = &summary});
  if (context.world.is_root() && !options.quiet)
    parallel::tell(fmt::format("{}{}{}; results in {}\n", fitted.ranking, warnings_text(fitted, options.folder),
                               times_text(summary, fitted.wall_s, context.world.size()), options.folder),
                   stdout);
  return Exit::done;
}

void add(CLI::App& parser, Work& work, const std::string& name, const std::string& what, bool with_fit) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* verb = parser.add_subcommand(name, what);
  verb->add_option("study", options->study, "study file")->required();
  verb->add_option("-o,--output", options->folder, "folder for the results");
  verb->add_flag("--check", options->check,
                 "check the study and the records that it names, print it with all defaults written out, and stop");
  verb->add_flag(
      "--best", options->best,
      "numbers that were fitted to measurements at their best values, not as the joint draws of fitted.yaml");
  auto* overwrite = verb->add_flag("--overwrite", options->overwrite, "replace results that are already in the folder");
  verb->add_flag("--resume", options->resume, "go on with a sweep that was stopped or killed")->excludes(overwrite);
  verb->add_flag("--quiet", options->quiet, "no progress, no summary, no warnings");
  verb->callback([options, with_fit, &work] {
    work = [options, with_fit](const Context& context) { return sweep_and_fit(context, *options, with_fit); };
  });
}

}  // namespace

void add_run(CLI::App& parser, Work& work) {
  add(parser, work, "run",
      "sweep a study on all ranks, fit it, write samples.h5, fragility.h5, bins.csv, surface.csv, summary.json", true);
}

void add_sweep(CLI::App& parser, Work& work) { add(parser, work, "sweep", "the first half of run: samples.h5", false); }

}  // namespace freestand::app
