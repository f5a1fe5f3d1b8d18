#include "study/export.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "app/command.hpp"

namespace freestand::app {
namespace {

struct ExportOptions {
  study::ExportRequest request;
  std::string form = "auto";
};

std::string formats_text() {
  std::string text;
  for (const auto& format : exports::all()) text += fmt::format("\n  {}: {}", format.name, format.summary);
  return text;
}

void tell(const study::ExportSummary& summary, const std::string& format) {
  const exports::Model& model = summary.model;
  fmt::print("{} over {}:\n", model.id, model.im.name);
  for (const exports::LimitState& state : model.states)
    fmt::print("  {}: {}, {}\n", state.name, exports::name(state.curve.form), state.why);
  std::vector<std::string> files;
  for (const auto& file : summary.files) files.push_back(file.string());
  fmt::print("{} read back as {} reads it: probabilities within {:.1e} of freestand's{}\n", files.front(), format,
             summary.difference, summary.rounding == "none" ? "" : ", as wanted: " + summary.rounding);
  for (const std::string& note : model.notes) fmt::print("* {}\n", note);
  fmt::print("written: {}\n", fmt::join(files, ", "));
}

void tell(const study::DatabaseExport& done, const study::ExportRequest& request) {
  double difference = 0;
  std::vector<std::string> left_out;  // of all of them alike
  for (const auto& [id, summary] : done.entries) {
    std::vector<std::string> states;
    for (const exports::LimitState& state : summary.model.states)
      states.push_back(fmt::format("{} {}", state.name, exports::name(state.curve.form)));
    fmt::print("{}: {}\n", id, fmt::join(states, ", "));
    for (const std::string& note : summary.model.notes) {
      const bool once = note.starts_with("left out:") && note.find("never happened") == std::string::npos;
      if (once && std::find(left_out.begin(), left_out.end(), note) == left_out.end()) left_out.push_back(note);
      if (note.find("never happened") != std::string::npos) fmt::print("  * {}\n", note);
    }
    difference = std::max(difference, summary.difference);
  }
  for (const std::string& note : left_out) fmt::print("* {}\n", note);
  if (!done.other_ims.empty())
    fmt::print("over {}, one of {} intensities (--im takes {} too)\n", done.im, done.other_ims.size() + 1,
               fmt::join(done.other_ims, ", "));
  if (!done.entries.empty())
    fmt::print("{} entries in {}, read back as {} reads them: probabilities within {:.1e} of freestand's\n",
               done.entries.size(), done.files.empty() ? request.output.string() : done.files.front().string(),
               request.format, difference);
  if (!done.refused.empty())
    throw Error(fmt::format("{} of {} entries are not exported:\n{}", done.refused.size(),
                            done.refused.size() + done.entries.size(), fmt::join(study::told_once(done.refused), "\n")),
                Exit::data);
}

Exit export_now(ExportOptions options, const Context& context) {
  exports::Request& what = options.request.what;
  what.counted = options.form == "counted";
  if (options.form == "lognormal") what.form = exports::Form::lognormal;
  if (options.form == "discrete" || what.counted) what.form = exports::Form::discrete;
  if (options.form == "parts") what.form = exports::Form::parts;
  context.world.on_root([&] {
    if (study::is_database(options.request.folder))
      tell(study::export_database(options.request), options.request);
    else
      tell(study::export_fragility(options.request), options.request.format);
  });
  return Exit::done;
}

}  // namespace

void add_export(CLI::App& parser, Work& work) {
  auto options = std::make_shared<ExportOptions>();
  study::ExportRequest& request = options->request;
  CLI::App* verb = parser.add_subcommand("export", "fragility in a format that others load, with certificate.json");
  verb->add_option("folder", request.folder,
                   "folder of results (with fragility.h5), or a database of a catalogue: all its entries, in one file "
                   "where the format "
                   "has that")
      ->required();
  verb->add_option("--format,--to", request.format, "one of:" + formats_text())->required();
  verb->add_option("-o,--output", request.output, "file, or folder")->required();
  verb->add_option(
          "--limit-state,--demand", request.what.states,
          "DEMAND:CAPACITY, or DEMAND for all its capacities, each with =NAME behind it if wanted; least severe "
          "first; repeat it (usual: the first demand with capacities, then overturned; wall_hit or the like alone "
          "where the study names it first; all in csv)")
      ->allow_extra_args(false);
  verb->add_option(
          "--form", options->form,
          "auto | lognormal (the fitted function) | discrete (the surface, bin by bin) | counted (shares of samples) "
          "| parts (the three parts, where a target takes formulas)")
      ->check(CLI::IsMember({"auto", "lognormal", "discrete", "counted", "parts"}));
  auto* id =
      verb->add_option("--id", request.what.id,
                       "identifier of the file, also of one with all entries of a database (usual: the name of the "
                       "study, or of the database)");
  verb->add_option("--description", request.what.description, "what it is, in words");
  verb->add_option("--asset-category", request.what.asset_category,
                   "OpenQuake's assetCategory, IN-CORE's inventory type");
  verb->add_option("--loss-category", request.what.loss_category, "OpenQuake's lossCategory (usual: contents)");
  verb->add_option("--mu", request.mu, "turns the intensity of the report into PTA, where all samples have this mu");
  verb->add_option("--period", request.period_s,
                   "period in s of record.sa_g, which the table of records does not tell");
  verb->add_option("--im", request.im, "intensity of a database that has several, as sa_g:0.5 (usual: its first one)");
  verb->add_flag("--each", request.each, "of a database: a file of its own for each entry, named by its id")
      ->excludes(id);
  verb->add_flag("--skip-empty", request.what.skip_empty, "leave out bins with too few samples");
  verb->add_flag("--overwrite", request.overwrite, "replace files that freestand exported before");
  verb->callback(
      [options, &work] { work = [options](const Context& context) { return export_now(*options, context); }; });
}

}  // namespace freestand::app
