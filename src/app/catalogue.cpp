#include "study/catalogue.hpp"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <set>
#include <string>

#include "app/command.hpp"
#include "app/times.hpp"
#include "io/database_file.hpp"
#include "parallel/progress.hpp"
#include "study/build_catalogue.hpp"
#include "study/doubts.hpp"
#include "study/export.hpp"
#include "study/known.hpp"
#include "study/realise.hpp"

namespace freestand::app {
namespace {

struct CatalogueOptions {
  std::string catalogue, folder;
  bool check = false, redo = false, resume = false, quiet = false;
};

std::string counted(std::int64_t n, const char* what) { return n ? fmt::format(", {} {}", n, what) : ""; }

// What a catalogue is, without computing any of it.
void show(const study::Catalogue& catalogue) {
  fmt::print("{}, revision {}: {} entries\n", catalogue.name, catalogue.revision, catalogue.entries.size());
  for (const study::CatalogueEntry& entry : catalogue.entries)
    fmt::print("{:<32} {:<28} mu {:<6.4g} {:.4g} x {:.4g} m  {} samples  ({})\n", entry.words.id, entry.words.equipment,
               entry.words.mu_k, entry.words.width_m, entry.words.height_m, entry.study.samples, entry.place);
}

// What is doubtful of its entries, as their sweeps would tell it. Records of a floor that several entries stand on are read once.
void tell_doubts(const study::Catalogue& catalogue) {
  std::map<std::string, study::MotionSet> motions;
  std::set<std::string> told;
  for (const study::CatalogueEntry& entry : catalogue.entries) {
    const std::string shaking = entry.words.shaking + entry.study.folder.string();
    if (!motions.contains(shaking)) motions.emplace(shaking, study::load_motions(entry.study));
    study::tell_doubts(entry.study, motions.at(shaking), told);
  }
}

// What cannot be exported stops no database.
void tell(const study::DatabaseExport& done, const CatalogueOptions& options) {
  if (options.quiet) return;
  fmt::print("{} entries over {} in {}\n", done.entries.size(), done.im, done.output.string());
  for (const std::string& refused : study::told_once(done.refused)) fmt::print("  not exported: {}\n", refused);
  if (!done.refused.empty())
    fmt::print("  options named here are those of: freestand export {} --format {} --im {} -o OUT\n", options.folder,
               done.format, done.im);
}

Exit build(const Context& context, const CatalogueOptions& options) {
  const study::Known known = study::registries();
  context.world.on_root([&] { study::read_catalogue(options.catalogue, known); });
  const study::Catalogue catalogue = study::read_catalogue(options.catalogue, known);
  if (options.check) {
    context.world.on_root([&] {
      tell_doubts(catalogue);
      show(catalogue);
    });
    return Exit::done;
  }
  if (options.folder.empty()) throw Error("no output folder (-o is missing): give -o DB");
  const auto summary = study::build_catalogue(context.world, catalogue, options.folder,
                                              {options.redo, options.quiet, context.command_line});
  if (context.world.is_root() && !options.quiet)
    parallel::tell(fmt::format("{} entries: {} computed{}{}{} in {} on {} {}; ask with `freestand query {}`\n",
                               catalogue.entries.size(), summary.computed, counted(summary.refitted, "fitted again"),
                               counted(summary.kept, "kept"), counted(summary.others, "more in the database"),
                               short_duration(summary.wall_s), context.world.size(),
                               context.world.size() == 1 ? "rank" : "ranks", options.folder),
                   stdout);
  context.world.on_root([&] {
    for (const study::DatabaseExport& done : study::export_beside(options.folder, catalogue.exports))
      tell(done, options);
  });
  return Exit::done;
}

}  // namespace

void add_catalogue(CLI::App& parser, Work& work) {
  auto options = std::make_shared<CatalogueOptions>();
  CLI::App* verb =
      parser.add_subcommand("catalogue", "many entries of equipment into one database, which is gone on with");
  verb->add_option("catalogue", options->catalogue, "catalogue file")->required();
  verb->add_option("-o,--output", options->folder, "folder of the database, new or to be extended");
  verb->add_flag("--check", options->check,
                 "check the catalogue and the records that it names, list its entries, and stop");
  verb->add_flag("--redo", options->redo, "compute entries anew whose study is another now");
  verb->add_flag("--resume", options->resume, "go on where a run was stopped; this is done without it too");
  verb->add_flag("--quiet", options->quiet, "no progress, no summary");
  verb->callback([options, &work] { work = [options](const Context& context) { return build(context, *options); }; });
}

}  // namespace freestand::app
