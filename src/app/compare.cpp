#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "app/command.hpp"
#include "base/folder.hpp"
#include "io/output_folder.hpp"
#include "io/own_files.hpp"
#include "io/text_files.hpp"
#include "io/written_files.hpp"
#include "study/posterior_tables.hpp"

namespace freestand::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr double ln_ratio_limit = 3, error_limit = 1e4;  // as measurement/predict/score.hpp cuts them off

std::string ln_ratio(const Json& ratio) {
  const bool cut_off = !ratio.is_null() && std::abs(ratio.get<double>()) >= ln_ratio_limit;
  return (!cut_off ? "" : ratio.get<double>() < 0 ? "<= " : ">= ") + three_digits(ratio);
}

std::string noise_units(const Json& error) {
  const bool cut_off = !error.is_null() && error.get<double>() >= error_limit;
  return (cut_off ? ">= " : "") + three_digits(error);
}

void tell_tests(const Json& json) {
  const std::string unit = json["error_unit"].get<std::string>();
  constexpr const char* row = "{:<12} {:<12} {:>12} {:>12} {:>10}\n";
  if (unit == "Brier")
    fmt::print(row, "test", "role", "came out", "P(falls)", "Brier");
  else
    fmt::print(row, "test", "role", unit, unit == "noise units" ? "noise alone" : "", "relative");
  for (const auto& test : json["tests"]) {
    if (json["tests"].size() > 40) break;
    const auto id = test["id"].get<std::string>(), role = test["role"].get<std::string>();
    if (test["kind"] == "outcome")
      fmt::print(row, id, role, test["overturned_measured"].get<bool>() ? "overturned" : "stood",
                 fmt::format("{:.2f}", test["overturned_probability"].get<double>()), three_digits(test["score"]));
    else
      fmt::print(
          row, id, role, test["kind"] == "peaks" ? ln_ratio(test["ln_ratio"]) : noise_units(test["error_noise_units"]),
          unit == "noise units" ? three_digits(test["error_expected"]) : "", three_digits(test["error_relative"]));
  }
  for (const char* role : {"calibration", "holdout"}) {
    const Json& pooled = json[role];
    if (pooled.is_null()) continue;
    const std::string expected = three_digits(pooled["error_expected"]);
    if (unit == "Brier")
      fmt::print(row, role, "", "", "", three_digits(pooled["error"]));
    else
      fmt::print(row, role, "", three_digits(pooled[unit == "noise units" ? "error_noise_units" : "error"]),
                 unit == "noise units" ? expected : "", three_digits(pooled["error_relative"]));
  }
}

void tell_comparison(const Json& json, const std::string& folder) {
  tell_tests(json);
  for (const auto& p : json["parameters"])
    fmt::print("{} = {:.5g} {}{}\n", p["name"].get<std::string>(), p["value"].get<double>(),
               p["unit"] == "1" ? "" : p["unit"].get<std::string>(),
               p["interval"].is_null()
                   ? ""
                   : fmt::format(" [{:.5g}, {:.5g}]", p["interval"][0].get<double>(), p["interval"][1].get<double>()));
  for (const auto& finding : json["findings"]) fmt::print("* {}\n", finding.get<std::string>());
  const bool calibrated = std::any_of(json["parameters"].begin(), json["parameters"].end(),
                                      [](const Json& p) { return p["calibrated"].get<bool>(); });
  fmt::print("results in {0}: comparison.json, and the study{1}, {0}/fitted.yaml\n", folder,
             calibrated ? " with the numbers that were fitted" : " as it stands");
}

Exit compare(const Context& context, const ValidationOptions& options) {
  const std::filesystem::path folder = options.output;
  context.world.on_root([&] {
    io::take_output_folder(folder, io::existing(options.overwrite),
                           {.writes = {"fitted.yaml", study::posterior_table}, .reads = options.reads()});
  });
  const study::Compared compared = study::compare(context.world, options.run(context), folder);
  context.world.on_root([&] {
    io::write_result(folder / "comparison.json", io::json_text(compared.json));
    if (compared.draws.empty() && io::is_own(folder / study::posterior_table))
      remove_file(folder / study::posterior_table);
    if (!compared.draws.empty()) io::write_text(folder / study::posterior_table, io::signed_text(compared.draws));
    io::write_text(folder / "fitted.yaml", io::signed_text("# " + context.command_line + "\n" + compared.fitted));
    if (!options.quiet) tell_comparison(compared.json, folder.string());
  });
  return Exit::done;
}

}  // namespace

void add_compare(CLI::App& parser, Work& work) {
  auto options = std::make_shared<ValidationOptions>();
  CLI::App* verb = parser.add_subcommand("compare", "hold the model against measurements: comparison.json");
  add_options(*verb, *options, "folder for the results", "replace results that are already in the folder");
  verb->callback([options, &work] { work = [options](const Context& context) { return compare(context, *options); }; });
}

}  // namespace freestand::app
