#include "study/fit.hpp"

#include <chrono>
#include <nlohmann/json.hpp>

#include "io/fragility_file.hpp"
#include "io/output_folder.hpp"
#include "io/own_files.hpp"
#include "io/samples_file.hpp"
#include "io/text_files.hpp"
#include "study/accuracy.hpp"
#include "study/analysis.hpp"
#include "study/edited_study.hpp"
#include "study/read_parts.hpp"
#include "study/until.hpp"

namespace freestand::study {
namespace {

constexpr std::int64_t rows_at_once = 8192;

// Seconds of each phase and of all of them; without the sweep's where another run made the samples.
nlohmann::ordered_json timing_json(const SweepSummary* sweep, double fit_s, int ranks) {
  nlohmann::ordered_json json{{"wall_s", fit_s + (sweep ? sweep->wall_s : 0)}};
  if (sweep) {
    json["sweep_s"] = sweep->compute_s;
    json["accuracy_s"] = sweep->accuracy_s;
    json["write_s"] = sweep->write_s;
    json["samples_per_s"] = sweep->samples_per_s;
    json["samples_computed"] = sweep->computed;
  }
  json["fit_s"] = fit_s;
  json["ranks"] = ranks;
  return json;
}

// The study to go by: on the root first, so that what is wrong is told once.
EditedStudy study_of(const parallel::Communicator& world, const std::string& swept,
                     const std::filesystem::path& folder) {
  const std::filesystem::path file = study_path(folder);
  std::string text;
  world.on_root([&] {
    text = std::filesystem::exists(file) ? read_text(file) : swept;
    edited_study(swept, text, file);
  });
  return edited_study(swept, world.broadcast(text), file);
}

}  // namespace

FitSummary fit(const parallel::Communicator& world, RunFolder& run_folder, const std::string& command, bool quiet,
               const SweepSummary* sweep) {
  const std::filesystem::path& folder = run_folder.path();
  const auto start = std::chrono::steady_clock::now();
  const auto so_far = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  const std::vector<std::string> written = {"fragility.h5", "bins.csv", "surface.csv", "summary.json"};
  world.on_root([&] { io::refuse_others(folder, written); });
  const io::SampleReader reader(samples_path(folder));
  const auto [study, changed] = study_of(world, reader.provenance().study, folder);
  const io::BlockLayout layout{reader.rows(), rows_at_once};
  run_folder.begin();
  run_folder.leave_if_asked();
  const std::vector<std::string> columns = analysed_columns(study.fragility);
  parallel::StepDisplay display(quiet || !world.is_root());
  const fragility::Result result = analyse(
      world, study, reader.motion_group(), layout.blocks(), rows_at_once,
      [&](std::int64_t block) { return reader.read(block * rows_at_once, layout.rows(block), columns); }, &display);
  world.on_root([&] {
    io::Provenance provenance = io::provenance_here(command, world.size());
    provenance.study = expanded(study);
    provenance.effects = reader.provenance().effects;
    provenance.accuracy = reader.provenance().accuracy;
    provenance.doubts = reader.provenance().doubts;
    provenance.study_name = study.name;
    provenance.kernel = reader.provenance().kernel;
    provenance.seed = reader.provenance().seed;
    provenance.samples = reader.provenance().samples;
    io::write_fragility(folder / "fragility.h5", provenance, result);
    io::write_text(folder / "bins.csv", io::bins_csv(result));
    io::write_text(folder / "surface.csv", io::surface_csv(result));
    nlohmann::ordered_json summary = io::fragility_summary(provenance, result);
    summary["accuracy"] = nlohmann::ordered_json::parse(provenance.accuracy);
    for (const auto& doubt : nlohmann::json::parse(provenance.doubts))
      summary["warnings"].push_back(doubt.get<std::string>());
    for (const auto& warning : accuracy_warnings(summary["accuracy"])) summary["warnings"].push_back(warning);
    tell_until(study, result, summary);
    summary["motion_entries"] = study.motions.size();
    summary["study_changed"] = changed;
    summary["timing"] = timing_json(sweep, so_far(), world.size());
    summary["files"] = {"samples.h5", "fragility.h5", "bins.csv", "surface.csv", "study.yaml"};
    io::write_text(folder / "summary.json", io::json_text(summary));
  });
  run_folder.end();
  return {reader.rows(), so_far(), changed};
}

}  // namespace freestand::study
