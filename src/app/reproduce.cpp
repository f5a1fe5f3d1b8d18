#include "study/reproduce.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/command.hpp"

namespace freestand::app {
namespace {

using report::Verdict;

constexpr const char* report_row = "  {:<64} {:>10} {:>10}  {}\n";

std::string four_digits(double value) { return fmt::format("{:.4g}", value); }

// What does not agree, and of a user's own peaks everything.
void tell_items(const study::Reproduced& found) {
  for (const auto& [entry, item] : found.items) {
    const auto counted =
        std::count_if(item.numbers.begin(), item.numbers.end(), [](const auto& n) { return n.print.has_value(); });
    const auto agree = std::count_if(item.numbers.begin(), item.numbers.end(),
                                     [](const auto& n) { return n.verdict == Verdict::agrees; });
    fmt::print("{}: {}{}\n", entry.place, entry.what,
               counted ? fmt::format("; {} of {} numbers agree", agree, counted) : "");
    for (const report::Number& n : item.numbers)
      if (found.own_peaks || n.verdict == Verdict::disagrees || n.verdict == Verdict::print_disagrees_with_itself)
        fmt::print(report_row, n.what, four_digits(n.ours), n.print ? four_digits(*n.print) : "",
                   found.own_peaks ? "" : name(n.verdict));
    for (const report::Statement& s : item.statements)
      if (found.own_peaks || s.verdict != Verdict::agrees)
        fmt::print("  {} ours: {}{}\n", s.what, s.ours, s.print.empty() ? "" : fmt::format("; print: {}", s.print));
  }
}

void tell(const study::Reproduced& found, const study::ReproduceOptions& options) {
  tell_items(found);
  const study::Agreement counts = study::agreement(found);
  if (!found.own_peaks)
    fmt::print(
        "{} of {} numbers of the report agree within rounding; in {} the print disagrees with itself, {} disagree "
        "otherwise\n",
        counts.agree, counts.printed, counts.with_itself, counts.disagree);
  if (!found.own_peaks && !options.records)
    fmt::print("without --records DIR table 7.1 is computed under the report's pulses alone\n");
  fmt::print("reproduce.json and the tables behind the pictures in {0}; postprocess/report {0} makes the page\n",
             options.output.string());
}

Exit reproduce(const Context& context, study::ReproduceOptions options) {
  options.command = context.command_line;
  context.world.on_root([&] { study::prepare(options); });
  const study::Reproduced found = study::reproduce(context.world, options);
  context.world.on_root([&] {
    study::write(found, options, context.world.size());
    if (!options.quiet) tell(found, options);
  });
  return Exit::done;
}

}  // namespace

void add_reproduce(CLI::App& parser, Work& work) {
  auto options = std::make_shared<study::ReproduceOptions>();
  options->tables = study::tables_of_the_source();
  CLI::App* verb = parser.add_subcommand(
      "reproduce",
      "the tables and figures of the report [KM05], ours beside the printed ones; or your own peaks, treated alike");
  verb->add_option("-o,--output", options->output, "folder for reproduce.json and a csv for each picture")->required();
  verb->add_option("--records", options->records,
                   "folder of earthquake records: table 7.1 under the motions of its tests");
  verb->add_option("--peaks", options->peaks,
                   "csv with measured peaks of your own (pta_g, mu or im, pulse_period_s, peak_slip_m): their line, "
                   "bins, fit and surface");
  verb->add_option("--tables", options->tables,
                   "folder of the report's printed tables (default: configs/report of the source)");
  verb->add_flag("--overwrite", options->overwrite, "replace results that are already in the folder");
  verb->add_flag("--quiet", options->quiet, "no table and no progress");
  verb->callback(
      [options, &work] { work = [options](const Context& context) { return reproduce(context, *options); }; });
}

}  // namespace freestand::app
