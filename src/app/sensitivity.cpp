#include "study/sensitivity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numeric>

#include "app/checks.hpp"
#include "app/command.hpp"

namespace freestand::app {
namespace {

// "motion.pta_g 0.41 +-0.02, friction.mu_k 0.12 +-0.01; together 0.55 +-0.03", the largest first; what rounds to nothing is left out.
std::string line(const study::Sensitivity& found, std::size_t a) {
  if (!found.why_empty[a].empty()) return found.why_empty[a];
  const decision::ShareRow& row = found.rows[a];
  std::vector<std::size_t> order(row.share.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return row.share[i].value > row.share[j].value; });
  std::string text;
  for (const std::size_t p : order) {
    const bool total = !found.totals[a].empty();
    if (row.share[p].value < 0.005 && !(total && found.totals[a][p].share.value >= 0.005)) continue;
    text += fmt::format("{} {:.2f} +-{:.2f}", found.parameters[p].name, row.share[p].value, row.share[p].se);
    if (total)
      text += fmt::format(" (total {:.2f} +-{:.2f})", found.totals[a][p].share.value, found.totals[a][p].share.se);
    text += ", ";
  }
  text += fmt::format("together {:.2f} +-{:.2f}", row.together.value, row.together.se);
  return found.why_no_total[a].empty() ? text : text + " (" + found.why_no_total[a] + ")";
}

void tell(const study::Sensitivity& found, const study::SensitivityOptions& options) {
  std::size_t width = 0;
  for (const auto& answer : found.answers) width = std::max(width, study::title(answer).size());
  fmt::print("share of the variance that would go if the parameter were known, +- standard error\n");
  for (std::size_t a = 0; a < found.answers.size(); ++a)
    fmt::print("  {:<{}}  {}\n", study::title(found.answers[a]), width, line(found, a));
  if (!found.note.empty()) fmt::print("{}\n", found.note);
  fmt::print("sensitivity.csv and sensitivity.json in {}\n",
             (options.output.empty() ? options.folder : options.output).string());
}

}  // namespace

void add_sensitivity(CLI::App& parser, Work& work) {
  auto options = std::make_shared<study::SensitivityOptions>();
  CLI::App* verb = parser.add_subcommand(
      "sensitivity", "shares of the variance of demands and of P(EDP > C) by sampled parameter, with errors");
  verb->add_option("folder", options->folder, "folder of a sweep")->required();
  verb->add_option("-o,--output", options->output, "where to write (default: the same folder)");
  verb->add_option(
          "--total", options->pairs,
          "total shares too: this many samples are computed again for each parameter, with that one drawn again")
      ->check(above_zero("number of samples"));
  verb->add_option("--confidence", options->confidence, "of the intervals (default: that of the study)")
      ->check(within(0.5, 0.999, "confidence"));
  verb->add_flag("--quiet", options->quiet, "no progress, no table");
  verb->callback([options, &work] {
    work = [options](const Context& context) {
      options->command = context.command_line;
      const study::Sensitivity found = study::sensitivity(context.world, *options);
      context.world.on_root([&] {
        study::write_sensitivity(found, *options);
        if (!options->quiet) tell(found, *options);
      });
      return Exit::done;
    };
  });
}

}  // namespace freestand::app
