#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "app/command.hpp"
#include "base/digits.hpp"
#include "base/folder.hpp"
#include "io/output_folder.hpp"
#include "io/own_files.hpp"

namespace freestand::app {
namespace {

struct AddOptions : ValidationOptions {
  std::string effect;
};

std::string text(double error) { return std::isfinite(error) ? freestand::three_digits(error) : "-"; }

// Where it makes a difference.
void tell_allowed(const std::vector<study::LadderStep>& ladder, const char* tests, double study::LadderStep::*error,
                  double study::LadderStep::*explained) {
  if (!(ladder.back().*explained < 0.8 * ladder.back().*error)) return;
  std::vector<std::string> steps;
  for (const study::LadderStep& step : ladder)
    steps.push_back(fmt::format("{}{} {}", step.step == "base" ? "" : "+ ", step.step, text(step.*explained)));
  fmt::print("{}, allowing for the floor's noise and for friction that differs from test to test: {}\n", tests,
             fmt::join(steps, ", "));
}

void tell_added(const std::string& file, const std::string& content) {
  const study::Validation v = study::parse_validation(content, file);
  fmt::print("{:<28} {:>12} {:>12} {:>12}\n", "model", "calibration", "held out", "noise floor");
  for (const auto& step : v.ladder)
    fmt::print("{:<28} {:>12} {:>12} {:>12}\n", (step.step == "base" ? "" : "+ ") + step.step,
               text(step.error_calibration), text(step.error_holdout), text(step.noise_floor));
  tell_allowed(v.ladder, "calibration", &study::LadderStep::error_calibration,
               &study::LadderStep::explained_calibration);
  tell_allowed(v.ladder, "held out", &study::LadderStep::error_holdout, &study::LadderStep::explained_holdout);
  for (const auto& c : v.calibrated)
    if (c.value) fmt::print("{} = {:.5g}\n", c.name, *c.value);
  fmt::print("study in {}\n", file);
}

void check_target(const std::filesystem::path& target, const AddOptions& options) {
  if (is_there(target) && !options.overwrite)
    throw Error(
        fmt::format("{} exists already (it would be lost): choose another name, or give --overwrite", options.output));
  io::refuse_others(target.parent_path(), {target.filename().string()});
}

Exit add(const Context& context, const AddOptions& options) {
  const std::filesystem::path target = options.output;
  context.world.on_root([&] { check_target(target, options); });
  const std::string text = study::add(context.world, options.run(context), options.effect, target.parent_path());
  context.world.on_root([&] {
    io::write_text(target, io::signed_text("# " + context.command_line + "\n" + text));
    if (!options.quiet) tell_added(options.output, text);
  });
  return Exit::done;
}

}  // namespace

void add_add(CLI::App& parser, Work& work) {
  auto options = std::make_shared<AddOptions>();
  CLI::App* verb =
      parser.add_subcommand("add", "the study with one more effect in it, fitted, and the ladder of errors");
  add_options(*verb, *options, "study to be written", "replace the file if freestand wrote it");
  verb->add_option("effect", options->effect, "name of the catalogue; or a formula, as YAML text or in a file")
      ->required();
  verb->callback([options, &work] { work = [options](const Context& context) { return add(context, *options); }; });
}

}  // namespace freestand::app
