#include "study/import.hpp"

#include <fmt/format.h>

#include <memory>

#include "app/command.hpp"
#include "io/output_folder.hpp"
#include "io/own_files.hpp"

namespace freestand::app {
namespace {

struct ImportOptions {
  std::string laboratory, output;
  bool overwrite = false, quiet = false;
};

Exit import(const Context& context, const ImportOptions& options) {
  const std::filesystem::path folder = options.output;
  context.world.on_root([&] {
    const study::Imported imported = study::import_laboratory(study::read_laboratory(options.laboratory));
    std::vector<std::string> names;
    for (const auto& [name, text] : imported.files) names.push_back(name);
    io::take_output_folder(folder, io::existing(options.overwrite), {.writes = names, .reads = {options.laboratory}});
    for (const auto& [name, text] : imported.files)
      io::write_text(folder / name,
                     io::signed_text(name == "dataset.yaml" ? "# " + context.command_line + "\n" + text : text));
    if (options.quiet) return;
    for (const std::string& sentence : imported.sentences) fmt::print("* {}\n", sentence);
    fmt::print("measurements in {}\n", (folder / "dataset.yaml").string());
  });
  return Exit::done;
}

}  // namespace

void add_import(CLI::App& parser, Work& work) {
  auto options = std::make_shared<ImportOptions>();
  CLI::App* verb =
      parser.add_subcommand("import", "files of a laboratory, in its own names and units, into a measurement set");
  verb->add_option("laboratory", options->laboratory, "LAB.yaml: which columns of which files are what")->required();
  verb->add_option("-o,--output", options->output, "folder for dataset.yaml and a csv per test")->required();
  verb->add_flag("--overwrite", options->overwrite, "replace results that are already in the folder");
  verb->add_flag("--quiet", options->quiet, "do not tell what was changed");
  verb->callback([options, &work] { work = [options](const Context& context) { return import(context, *options); }; });
}

}  // namespace freestand::app
