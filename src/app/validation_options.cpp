#include <fmt/format.h>

#include <cmath>

#include "app/command.hpp"

namespace freestand::app {

study::ValidationRun ValidationOptions::run(const Context& context) const {
  return {.study = study, .measurements = measurements, .command = context.command_line, .quiet = quiet};
}

void add_options(CLI::App& verb, ValidationOptions& options, const std::string& output, const std::string& overwrite) {
  verb.add_option("study", options.study, "study of a validation")->required();
  verb.add_option("--measurements", options.measurements, "data set in place of the study's");
  verb.add_option("-o,--output", options.output, output)->required();
  verb.add_flag("--overwrite", options.overwrite, overwrite);
  verb.add_flag("--quiet", options.quiet, "no progress, no summary");
}

std::string three_digits(const nlohmann::ordered_json& number) {
  if (number.is_null()) return "-";
  const auto x = number.get<double>();
  const double size = std::abs(x);
  if (size >= 9995) return fmt::format("{:.2g}", x);
  return size >= 99.95 ? fmt::format("{:.0f}", x) : fmt::format("{:#.3g}", x);
}

}  // namespace freestand::app
