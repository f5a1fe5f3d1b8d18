#include "study/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/folder.hpp"
#include "io/fragility_file.hpp"
#include "io/output_folder.hpp"
#include "io/own_files.hpp"
#include "io/samples_file.hpp"
#include "io/tally_file.hpp"
#include "io/text_files.hpp"
#include "io/written_files.hpp"
#include "study/accuracy.hpp"
#include "study/analysis.hpp"
#include "study/edited_study.hpp"
#include "study/intensities.hpp"
#include "study/paths.hpp"
#include "study/ranking.hpp"
#include "study/read_parts.hpp"
#include "study/sample_counts.hpp"
#include "study/spread_jobs.hpp"
#include "study/swept_study.hpp"
#include "study/target.hpp"
#include "study/until.hpp"

namespace freestand::study {
namespace {

constexpr std::int64_t rows_at_once = 8192;

// Seconds of each phase and of all of them; without the sweep's where another run made the samples.
nlohmann::ordered_json timing_json(const SweepSummary* sweep, double fit_s, int ranks) {
  nlohmann::ordered_json json{{"wall_s", fit_s + (sweep ? sweep->wall_s : 0)}};
  if (sweep) {
    json["motions_s"] = sweep->motions_s;
    json["sweep_s"] = sweep->compute_s;
    json["accuracy_s"] = sweep->accuracy_s;
    json["write_s"] = sweep->write_s;
    json["samples_per_s"] = sweep->samples_per_s;
    json["samples_computed"] = sweep->computed;
    json["samples_passed_over"] = sweep->passed_over;
  }
  json["fit_s"] = fit_s;
  json["ranks"] = ranks;
  return json;
}

EditedStudy changed_study(const std::string& swept, const std::string& text, const std::filesystem::path& file,
                          const FragilityChanges& changes) {
  const EditedStudy edited = edited_study(swept, text, file);
  if (!changes.any()) return edited;
  Study study = with_changes(edited.study, changes);
  return {study, edited_study(swept, expanded(study), file).changed};
}

// The study to go by: on the root first, so that what is wrong is told once.
EditedStudy study_of(const parallel::Communicator& world, const std::string& swept, const FitOptions& options) {
  const std::filesystem::path file = study_path(options.from);
  std::string text;
  world.on_root([&] {
    text = is_there(file) ? read_text(file) : swept;
    changed_study(swept, text, file, options.changes);
  });
  return changed_study(swept, world.broadcast(text), file, options.changes);
}

// What was counted of all samples, where the sweep has not kept all and this study asks for no other counts.
std::optional<parallel::Words> counted_words(const parallel::Communicator& world, const Study& study,
                                             const io::SampleReader& reader, const std::filesystem::path& folder) {
  if (reader.rows() == swept_samples(reader)) return {};
  parallel::Words words;
  world.on_root([&] {
    const io::TallyContent tally = io::read_tally(tally_path(folder));
    if (tally.provenance.created_utc != reader.provenance().created_utc)
      throw Error(fmt::format("{} and {} are of two sweeps: sweep again", tally_path(folder).string(),
                              samples_path(folder).string()),
                  Exit::data);
    if (tally.fingerprint == counts_fingerprint(study)) words = tally.words;
  });
  words = world.broadcast(words);
  if (words.empty()) return {};
  return words;
}

// Does each of these bins lie within one that the sweep had? Laid by the same rule they are the same; given ones have all its edges.
bool lie_within(const BinsPart& bins, const BinsPart& swept) {
  if (bins.edges.empty() || swept.edges.empty())
    return bins.edges == swept.edges && bins.width == swept.width && bins.count == swept.count &&
           bins.spacing == swept.spacing;
  return std::includes(bins.edges.begin(), bins.edges.end(), swept.edges.begin(), swept.edges.end());
}

// How many of the first samples the fit of this study is of: of a sweep that passed samples over for the intensity and the bins of its
// `until`, those before them where the fit is over another intensity, or where a bin joins what was taken differently.
std::int64_t rows_for(const Study& study, const io::SampleReader& reader) {
  const FragilityPart swept = parse_stored(reader.provenance().study, "samples.h5").fragility, &now = study.fragility;
  const bool same = now.im.name == swept.im.name && now.im.period_s == swept.im.period_s;
  return same && lie_within(now.bins, swept.bins) ? reader.rows() : rows_alike(reader);
}

io::Provenance provenance_of(const io::SampleReader& reader, const Study& study, const FitOptions& options, int ranks) {
  io::Provenance provenance = io::provenance_here(options.command, ranks);
  provenance.study = expanded(study);
  provenance.effects = reader.provenance().effects;
  provenance.accuracy = reader.provenance().accuracy;
  provenance.doubts = reader.provenance().doubts;
  provenance.study_name = study.name;
  provenance.kernel = reader.provenance().kernel;
  provenance.seed = reader.provenance().seed;
  provenance.samples = reader.provenance().samples;
  provenance.alike = reader.provenance().alike;
  return provenance;
}

nlohmann::ordered_json summary_of(const Study& study, const io::Provenance& provenance, const fragility::Result& result,
                                  const FitSummary& told, const Drawn& drawn) {
  nlohmann::ordered_json summary = io::fragility_summary(provenance, result);
  if (study.fragility.im.period_s) summary["im_" + study.fragility.im.parameter] = *study.fragility.im.period_s;
  summary["accuracy"] = nlohmann::ordered_json::parse(provenance.accuracy);
  summary["warnings"] = told.warnings;
  for (const auto& doubt : nlohmann::json::parse(provenance.doubts))
    summary["warnings"].push_back(doubt.get<std::string>());
  for (const std::string& note : told.notes) summary["warnings"].push_back(note);
  tell_until(study, result, drawn, summary);
  summary["motion_entries"] = study.motions.size();
  summary["study_changed"] = told.changed;
  return summary;
}

}  // namespace

void check_fit(const FitOptions& options) {
  const io::SampleReader reader(samples_path(options.from));
  const std::filesystem::path file = study_path(options.from);
  const std::string& swept = reader.provenance().study;
  const EditedStudy edited =
      changed_study(swept, is_there(file) ? read_text(file) : swept, file, options.changes);
  SampleIntensity(edited.study.fragility.im, motion_summaries(reader.motions()));
  const Target target(edited.study);
  const double stay = target.kept_share() * static_cast<double>(reader.rows());
  if (!target.empty() && stay < edited.study.fragility.minimum_samples)
    throw Error(
        fmt::format("the target leaves some {:.0f} of {} samples (a bin alone wants minimum_samples, {}): widen "
                    "it, or sweep more",
                    stay, reader.rows(), edited.study.fragility.minimum_samples));
}

FitSummary fit(const parallel::Communicator& world, RunFolder& into, const FitOptions& options) {
  const std::filesystem::path& folder = into.path();
  const bool elsewhere = !std::filesystem::equivalent(folder, options.from);
  const auto start = std::chrono::steady_clock::now();
  const auto so_far = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  std::vector<std::string> written = {"fragility.h5", "bins.csv", "surface.csv", "ranking.csv", "summary.json"};
  if (elsewhere) written.push_back(study_path("").string());
  world.on_root([&] {
    io::refuse_others(folder, written);
    io::check_closing_line(samples_path(options.from));
  });
  const io::SampleReader reader(samples_path(options.from), io::Closing::checked);
  const EditedStudy edited = study_of(world, reader.provenance().study, options);
  const Study& study = edited.study;
  const MotionSummaries motions = motion_summaries(reader.motions());
  const SampleIntensity intensity(study.fragility.im, motions);
  FitSummary told{.samples = reader.rows(), .intensity = described(study.fragility.im), .changed = edited.changed};
  if (!intensity.interpolation().empty()) told.notes.push_back(intensity.interpolation());
  const Target target(study);
  if (!target.empty()) told.notes.push_back(target.told());
  into.begin();
  into.leave_if_asked();
  const auto jobs = spread_jobs(world, options.quiet, [&] { into.leave(); });
  fragility::Result result;
  Ranking ranking;
  if (const auto words = counted_words(world, study, reader, options.from)) {
    const SampleCounts counts(study, target, reader.motions().group, motions, reader.read(0, bin_layout_samples));
    result = counts.result(*words, jobs);
    if (world.is_root()) ranking = counts.ranking(*words, samples_alike(reader), swept_samples(reader));
    told.samples = swept_samples(reader);
  } else {
    told.samples = rows_for(study, reader);
    if (const std::string note = kept_told(reader, told.samples); !note.empty()) told.notes.push_back(note);
    const io::BlockLayout layout{told.samples, rows_at_once};
    const std::vector<std::string> columns = analysed_columns(study.fragility);
    const auto rows_of = [&](std::int64_t block) {
      return intensity.beside(reader.read(block * rows_at_once, layout.rows(block), columns));
    };
    parallel::StepDisplay display(options.quiet || !world.is_root());
    result =
        analyse(world, study, target, reader.motions().group, layout.blocks(), rows_at_once, rows_of, jobs, &display);
    ranking = rank_intensities(world, study, target, reader);
  }
  told.warnings = result.warnings;
  const Drawn drawn{told.samples, std::min(told.samples, samples_alike(reader))};
  if (const std::string note = passed_over_told(drawn); !note.empty()) {
    told.notes.push_back(note);
    if (world.is_root() && target.empty()) told.samples = result.samples;
  }
  world.on_root([&] {
    const io::Provenance provenance = provenance_of(reader, study, options, world.size());
    for (const auto& warning : accuracy_warnings(nlohmann::json::parse(provenance.accuracy)))
      told.warnings.push_back(warning);
    io::write_fragility(folder / "fragility.h5", provenance, result);
    io::write_result(folder / "bins.csv", io::bins_csv(result));
    io::write_result(folder / "surface.csv", io::surface_csv(result));
    io::write_result(folder / "ranking.csv", ranking_csv(ranking));
    if (elsewhere) io::write_text(study_path(folder), io::signed_text(expanded(study, folder)));
    nlohmann::ordered_json summary = summary_of(study, provenance, result, told, drawn);
    summary["record_pulses"] = record_pulses_json(motions);
    summary["ranking"] = ranking_json(ranking);
    summary["timing"] = timing_json(options.sweep, so_far(), world.size());
    if (elsewhere) summary["samples_in"] = way_between(folder, options.from);
    summary["files"] = {"fragility.h5", "bins.csv", "surface.csv", "ranking.csv", "study.yaml"};
    if (!elsewhere) summary["files"].push_back("samples.h5");
    if (!elsewhere && reader.rows() < swept_samples(reader)) summary["files"].push_back("tally.h5");
    io::write_result(folder / "summary.json", io::json_text(summary));
  });
  into.end();
  told.wall_s = so_far();
  told.ranking = ranking_text(ranking, study, options.whole_ranking);
  return told;
}

}  // namespace freestand::study
