#include <fmt/format.h>

#include <memory>

#include "app/command.hpp"
#include "io/output_folder.hpp"
#include "io/text_files.hpp"

namespace freestand::app {
namespace {

void tell(const nlohmann::ordered_json& json, const std::string& folder) {
  fmt::print("{:<12} {:<12} {:>12} {:>10} {:>10}\n", "test", "role", json["error_unit"].get<std::string>(), "expected",
             "relative");
  const auto text = [](const nlohmann::ordered_json& value) {
    return value.is_null() ? std::string("-") : fmt::format("{:.3g}", value.get<double>());
  };
  for (const auto& test : json["tests"])
    if (json["tests"].size() <= 40)
      fmt::print("{:<12} {:<12} {:>12} {:>10} {:>10}\n", test["id"].get<std::string>(), test["role"].get<std::string>(),
                 text(test["error_noise_units"]), text(test["error_expected"]), text(test["error_relative"]));
  for (const char* role : {"calibration", "holdout"})
    if (!json[role].is_null())
      fmt::print("{:<25} {:>12} {:>10} {:>10}\n", role,
                 text(json[role][json["error_unit"] == "noise units" ? "error_noise_units" : "error"]),
                 text(json[role]["error_expected"]), text(json[role]["error_relative"]));
  for (const auto& p : json["parameters"])
    fmt::print("{} = {:.5g} {}{}\n", p["name"].get<std::string>(), p["value"].get<double>(),
               p["unit"] == "1" ? "" : p["unit"].get<std::string>(),
               p["interval"].is_null()
                   ? ""
                   : fmt::format(" [{:.5g}, {:.5g}]", p["interval"][0].get<double>(), p["interval"][1].get<double>()));
  for (const auto& finding : json["findings"]) fmt::print("* {}\n", finding.get<std::string>());
  fmt::print("results in {0}: comparison.json, and the study with the numbers that were fitted, {0}/fitted.yaml\n",
             folder);
}

Exit compare(const Context& context, const ValidationOptions& options) {
  const std::filesystem::path folder = options.output;
  context.world.on_root(
      [&] { io::prepare_output_folder(folder, options.overwrite ? io::Existing::overwrite : io::Existing::refuse); });
  const auto [json, fitted] = study::compare(context.world, options.run(context), folder);
  context.world.on_root([&, &json = json, &fitted = fitted] {
    io::write_text(folder / "comparison.json", io::json_text(json));
    io::write_text(folder / "fitted.yaml", "# " + context.command_line + "\n" + fitted);
    if (!options.quiet) tell(json, folder.string());
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
