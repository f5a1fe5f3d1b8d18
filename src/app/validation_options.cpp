#include "app/command.hpp"
#include "base/digits.hpp"
#include "study/posterior_tables.hpp"

namespace freestand::app {

study::ValidationRun ValidationOptions::run(const Context& context) const {
  return {.study = study, .measurements = measurements, .command = context.command_line, .quiet = quiet};
}

std::vector<std::filesystem::path> ValidationOptions::reads() const {
  std::vector<std::filesystem::path> files = study::files_of_study(study);
  files.emplace_back(measurements);
  return files;
}

void add_options(CLI::App& verb, ValidationOptions& options, const std::string& output, const std::string& overwrite) {
  verb.add_option("study", options.study, "study of a validation")->required();
  verb.add_option("--measurements", options.measurements, "data set in place of the study's");
  verb.add_option("-o,--output", options.output, output)->required();
  verb.add_flag("--overwrite", options.overwrite, overwrite);
  verb.add_flag("--quiet", options.quiet, "no progress, no summary");
}

std::string three_digits(const nlohmann::ordered_json& number) {
  return number.is_null() ? "-" : freestand::three_digits(number.get<double>());
}

}  // namespace freestand::app
