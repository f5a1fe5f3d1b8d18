#include "study/fit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "app/command.hpp"
#include "app/times.hpp"
#include "io/samples_file.hpp"

namespace freestand::app {

namespace {

void tell(const study::FitSummary& summary, const std::string& folder) {
  const std::string by = summary.changed.empty()
                             ? "by the study as it was swept"
                             : fmt::format("by {} of {}, changed since the sweep", fmt::join(summary.changed, ", "),
                                           study::study_path(folder).string());
  fmt::print("{} samples fitted in {}, {}; results in {}\n", summary.samples, short_duration(summary.wall_s), by,
             folder);
}

}  // namespace

void add_fit(CLI::App& parser, Work& work) {
  auto folder = std::make_shared<std::string>();
  auto quiet = std::make_shared<bool>(false);
  CLI::App* verb = parser.add_subcommand("fit", "the second half of run: samples.h5 -> fragility.h5, tables, summary");
  verb->add_option("folder", *folder, "folder of a sweep")->required();
  verb->add_flag("--quiet", *quiet, "no progress");
  verb->callback([folder, quiet, &work] {
    work = [folder, quiet](const Context& context) {
      context.world.on_root([&] { io::SampleReader{study::samples_path(*folder)}; });  // else no folder is made
      study::RunFolder run_folder(context.world, *folder, io::Existing::resume, "start again");
      const study::FitSummary summary = study::fit(context.world, run_folder, context.command_line, *quiet);
      if (context.world.is_root() && !*quiet) tell(summary, *folder);
      return Exit::done;
    };
  });
}

}  // namespace freestand::app
