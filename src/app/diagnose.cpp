#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "app/command.hpp"
#include "io/output_folder.hpp"
#include "io/own_files.hpp"
#include "io/text_files.hpp"
#include "io/written_files.hpp"
#include "parallel/finished_blocks.hpp"
#include "study/sweep.hpp"

namespace freestand::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t rows = 10;  // of the table, beside the base

// Only where tests were left out of fits is there an error of tests left out.
void tell_row(const Json& c, const std::string& name) {
  const bool left_out = c["left_out_refitted"].get<bool>();
  const std::string se = left_out && !c["error_left_out_se"].is_null()
                             ? fmt::format("+- {:.2g}", c["error_left_out_se"].get<double>())
                             : "";
  const std::string remark = left_out && c["remark"].is_string() ? " " + c["remark"].get<std::string>() : "";
  fmt::print("{:<42} {:>11} {:>11} {:<9} {:>11} {}{}\n", name, three_digits(c["error_calibration"]),
             left_out ? three_digits(c["error_left_out"]) : "-", se,
             three_digits(c["error_left_out_floor_noise_allowed"]), c["as_good_as_best"].get<bool>() ? "<" : "",
             remark);
}

// Why the verdict names no effect, or more than one.
std::string why(const Json& json) {
  if (json["verdict"] == "ambiguous") return " (these tests cannot tell them apart)";
  const std::string reason = json.contains("reason") && json["reason"].is_string() ? json["reason"] : "";
  if (reason == "data") return " (no effect can be named: the measurements look wrong)";
  if (reason == "none_helps") return " (no effect of the catalogue predicts the tests left out better, beyond chance)";
  if (reason == "none_suffices") return " (effects help, and the best of them leaves more than noise makes)";
  if (reason == "one_law")
    return " (several effects would do together, and one law of no catalogue does with fewer numbers)";
  return "";
}

// " floor_tilt", " floor_tilt or directional_friction", " a+b or a+c".
std::string named(const Json& json) {
  std::vector<std::string> effects, rivals;
  for (const auto& effect : json["effects"]) effects.push_back(effect);
  for (const auto& c : json["candidates"])
    if (c["as_good_as_best"].get<bool>()) rivals.push_back(c["effect"]);
  if (effects.empty()) return "";
  return json["verdict"] == "ambiguous" ? fmt::format(" {}", fmt::join(rivals, " or "))
                                        : fmt::format(" {}", fmt::join(effects, " "));
}

void tell_diagnosis(const Json& json, const std::string& file) {
  const bool histories = json["error_unit"] == "noise units";
  fmt::print("{:<42} {:>11} {:>11} {:<9} {:>11}\n", "error (" + json["error_unit"].get<std::string>() + ")",
             "calibration", "left out", "", histories ? "floor noise" : "");
  if (histories) fmt::print("{:>88}\n", "allowed for");
  const bool own_frictions =
      json["friction_scatter"].is_object() && json["friction_scatter"]["beside"] == "the best effect, and allowed for";
  tell_row(json["base"], own_frictions ? "as it is, with each test's friction" : "as it is");
  std::size_t seen = 0;
  for (const auto& c : json["candidates"])
    if (c["visible"].get<bool>() && seen++ < rows) tell_row(c, "with " + c["effect"].get<std::string>());
  if (seen > rows) fmt::print("and {} more\n", seen - rows);
  fmt::print("verdict: {}{}{}\n", json["verdict"].get<std::string>(), named(json), why(json));
  for (const auto& c : json["tests_of_chance"])
    fmt::print(
        "{:<26} {:<52} p {}{:.4f} ({} sets{})\n", c["question"].get<std::string>(), c["about"].get<std::string>(),
        c["p"].get<double>() * c["simulations"].get<double>() < c["tries"].get<double>() ? "< " : "",
        c["p"].get<double>(), c["simulations"].get<int>(),
        c["told_apart"].is_null() ? "" : fmt::format(", told apart in {:.0f} %", 100 * c["told_apart"].get<double>()));
  for (const char* list : {"sentences", "findings"})
    for (const auto& sentence : json[list]) fmt::print("* {}\n", sentence.get<std::string>());
  if (!json["suggested_motion"].is_null())
    fmt::print("* {}\n", json["suggested_motion"]["sentence"].get<std::string>());
  fmt::print("results in {}\n", file);
}

struct DiagnoseOptions : ValidationOptions {
  bool resume = false;
};

Exit diagnose(const Context& context, const DiagnoseOptions& options) {
  study::RunFolder folder(context.world, options.output, io::existing(options.overwrite, options.resume),
                          "go on with --resume", {.writes = {"proposed_law.yaml"}, .reads = options.reads()});
  const Json json = study::diagnose(context.world, options.run(context), folder);
  folder.confirm();
  context.world.on_root([&] {
    const std::filesystem::path file = folder.path() / "diagnosis.json";
    if (!json["proposed_law"].is_null())
      io::write_text(folder.path() / "proposed_law.yaml",
                     io::signed_text(json["proposed_law"]["entry"].get<std::string>()));
    io::write_result(file, io::json_text(json));
    parallel::remove_finished_blocks(study::blocks_path(folder.path()));
    if (!options.quiet) tell_diagnosis(json, file.string());
  });
  folder.end();
  return Exit::done;
}

}  // namespace

void add_diagnose(CLI::App& parser, Work& work) {
  auto options = std::make_shared<DiagnoseOptions>();
  CLI::App* verb = parser.add_subcommand("diagnose", "which physical effect does the model lack: diagnosis.json");
  add_options(*verb, *options, "folder for the results", "replace results that are already in the folder");
  verb->add_flag("--resume", options->resume, "go on with a diagnosis that was stopped or killed")
      ->excludes(verb->get_option("--overwrite"));
  verb->callback(
      [options, &work] { work = [options](const Context& context) { return diagnose(context, *options); }; });
}

}  // namespace freestand::app
