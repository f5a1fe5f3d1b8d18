#include "study/risk.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "app/command.hpp"
#include "decision/annual_rate.hpp"

namespace freestand::app {
namespace {

std::string percent(double probability) {
  if (std::isnan(probability)) return "-";
  return probability < 0.995 ? fmt::format("{:.2g} %", 100 * probability) : fmt::format("{:.4g} %", 100 * probability);
}

// Why rows go by counts, each reason with its rows.
std::vector<std::pair<std::string, std::vector<std::string>>> reasons(const decision::Risk& risk) {
  std::vector<std::pair<std::string, std::vector<std::string>>> found;
  for (const decision::RiskRow& row : risk.rows) {
    if (!row.refused.empty() || row.recommended == decision::By::function) continue;
    auto at = std::find_if(found.begin(), found.end(), [&](const auto& one) { return one.first == row.why; });
    if (at == found.end()) at = found.insert(at, {row.why, {}});
    at->second.push_back(title(row));
  }
  return found;
}

// The intensity from which on half of the rate comes.
std::string half_from_above(const decision::RiskRow& row, const decision::Risk& risk) {
  if (std::isnan(row.median_im)) return "-";
  const bool beyond = std::isinf(row.median_im);
  return fmt::format("{}{:.2g} {}", beyond ? "> " : "", beyond ? risk.edge.back() : row.median_im, risk.im_unit);
}

void tell(const study::RiskAnswer& answer, const study::RiskOptions& options) {
  const decision::Risk& risk = answer.risk;
  std::size_t width = 0;
  for (const auto& row : risk.rows) width = std::max(width, title(row).size());
  fmt::print("{}, bands of {:g} %; hazard over {}\n", answer.study_name, 100 * risk.confidence, risk.im);
  if (!answer.target.empty()) fmt::print("{}\n", answer.target);
  std::string in_years;
  for (const double years : options.years) in_years += fmt::format("{:<30}", fmt::format("in {:g} years", years));
  fmt::print("  {:<{}}  {:<32}  {}{:<17}  by\n", "", width, "annual rate", in_years, "half from above");
  for (const decision::RiskRow& row : risk.rows) {
    if (!row.refused.empty()) {
      fmt::print("  {:<{}}  not told: {}\n", title(row), width, row.refused);
      continue;
    }
    const decision::Rate& rate = row.rate();
    std::string chances;
    for (const double years : options.years) {
      const auto chance = [&](double r) { return percent(decision::probability_in_years(r, years)); };
      chances +=
          fmt::format("{:<30}", fmt::format("{} [{}, {}]", chance(rate.value), chance(rate.lower), chance(rate.upper)));
    }
    fmt::print("  {:<{}}  {:<32}  {}{:<17}  {}\n", title(row), width,
               fmt::format("{:.2g} [{:.2g}, {:.2g}]", rate.value, rate.lower, rate.upper), chances,
               half_from_above(row, risk),
               row.recommended != decision::By::function ? "counts"
               : std::isfinite(row.by_counts.value)      ? "fitted curve"
                                                         : "fitted curve, with no bin to check it");
  }
  for (const auto& [why, titles] : reasons(risk)) fmt::print("* by counts, {}: {}\n", why, fmt::join(titles, ", "));
  for (const std::string& warning : risk.warnings) fmt::print("warning: {}\n", warning);
  fmt::print("risk.csv and risk.json in {}\n", options.output.string());
}

}  // namespace

void add_risk(CLI::App& parser, Work& work) {
  auto options = std::make_shared<study::RiskOptions>();
  auto quiet = std::make_shared<bool>(false);
  CLI::App* verb = parser.add_subcommand(
      "risk", "annual rate and probability in N years of each demand and capacity, from a hazard curve");
  verb->add_option("folder", options->folder, "folder of a fitted sweep")->required();
  verb->add_option("--hazard", options->hazard,
                   "csv file: an intensity with its unit (pga_g, pgv_mps, sa_g ...) and annual_rate")
      ->required();
  verb->add_option("-o,--output", options->output, "folder for risk.json and risk.csv")->required();
  verb->add_option("--years", options->years, "one or several (default 50)");
  verb->add_flag("--overwrite", options->overwrite, "replace results that are already in the folder");
  verb->add_flag("--quiet", *quiet, "no table");
  verb->callback([options, quiet, &work] {
    work = [options, quiet](const Context& context) {
      options->command = context.command_line;
      context.world.on_root([&] {
        const study::RiskAnswer answer = study::risk(*options);
        study::write_risk(answer, *options);
        if (!*quiet) tell(answer, *options);
      });
      return Exit::done;
    };
  });
}

}  // namespace freestand::app
