#include <fmt/format.h>

#include <memory>

#include "app/command.hpp"
#include "io/output_folder.hpp"
#include "io/text_files.hpp"

namespace freestand::app {
namespace {

using Json = nlohmann::ordered_json;

std::string number(const Json& value, const char* format) {
  return value.is_null() ? std::string("-") : fmt::format(fmt::runtime(format), value.get<double>());
}

void tell_row(const Json& c, const std::string& name) {
  fmt::print("{:<42} {:>11} {:>11} +- {:<9} {:>9} {}\n", name, number(c["error_calibration"], "{:.3g}"),
             number(c["error_left_out"], "{:.3g}"), number(c["error_left_out_se"], "{:.2g}"),
             number(c["error_explained"], "{:.3f}"), c["rival"].get<bool>() ? "<" : "");
}

void tell(const Json& json, const std::string& file) {
  fmt::print("{:<42} {:>11} {:>11}    {:<9} {:>9}\n", "", "calibration", "left out", "", "explained");
  tell_row(json["base"], "as it is");
  int shown = 0;
  for (const auto& c : json["candidates"])
    if (c["visible"].get<bool>() && shown++ < 10) tell_row(c, "with " + c["effect"].get<std::string>());
  std::string effects;
  for (const auto& effect : json["effects"]) effects += " " + effect.get<std::string>();
  fmt::print("verdict: {}{}\n", json["verdict"].get<std::string>(), effects);
  for (const char* list : {"sentences", "findings"})
    for (const auto& sentence : json[list]) fmt::print("* {}\n", sentence.get<std::string>());
  if (!json["suggested_motion"].is_null())
    fmt::print("* {}\n", json["suggested_motion"]["sentence"].get<std::string>());
  fmt::print("results in {}\n", file);
}

Exit diagnose(const Context& context, const ValidationOptions& options) {
  const std::filesystem::path folder = options.output;
  context.world.on_root(
      [&] { io::prepare_output_folder(folder, options.overwrite ? io::Existing::overwrite : io::Existing::refuse); });
  const Json json = study::diagnose(context.world, options.run(context));
  context.world.on_root([&] {
    io::write_text(folder / "diagnosis.json", io::json_text(json));
    if (!options.quiet) tell(json, (folder / "diagnosis.json").string());
  });
  return Exit::done;
}

}  // namespace

void add_diagnose(CLI::App& parser, Work& work) {
  auto options = std::make_shared<ValidationOptions>();
  CLI::App* verb = parser.add_subcommand("diagnose", "which physical effect does the model lack: diagnosis.json");
  add_options(*verb, *options, "folder for the results", "replace results that are already in the folder");
  verb->callback(
      [options, &work] { work = [options](const Context& context) { return diagnose(context, *options); }; });
}

}  // namespace freestand::app
