#include "study/fit.hpp"

#include <nlohmann/json.hpp>

#include "io/fragility_file.hpp"
#include "io/output_folder.hpp"
#include "io/samples_file.hpp"
#include "io/text_files.hpp"
#include "study/accuracy.hpp"
#include "study/analysis.hpp"
#include "study/doubts.hpp"

namespace freestand::study {
namespace {

constexpr std::int64_t rows_at_once = 8192;

nlohmann::ordered_json timing_json(const SweepSummary& sweep, int ranks) {
  return {{"wall_s", sweep.wall_s},
          {"samples_per_s", sweep.samples_per_s},
          {"samples_computed", sweep.computed},
          {"ranks", ranks}};
}

}  // namespace

void fit(const parallel::Communicator& world, const std::filesystem::path& folder, const std::string& command,
         const SweepSummary* sweep) {
  const io::SampleReader reader(samples_path(folder));
  const Study study = parse_stored(reader.provenance().study, folder);
  const io::BlockLayout layout{reader.rows(), rows_at_once};
  const fragility::Result result =
      analyse(world, study, reader.motion_is_record(), layout.blocks(), rows_at_once,
              [&](std::int64_t block) { return reader.read(block * rows_at_once, layout.rows(block)); });
  world.on_root([&] {
    io::Provenance provenance = io::provenance_here(command, world.size());
    provenance.study = reader.provenance().study;
    provenance.effects = reader.provenance().effects;
    provenance.accuracy = reader.provenance().accuracy;
    provenance.study_name = reader.provenance().study_name;
    provenance.seed = reader.provenance().seed;
    provenance.samples = reader.provenance().samples;
    io::write_fragility(folder / "fragility.h5", provenance, result);
    io::write_text(folder / "bins.csv", io::bins_csv(result));
    io::write_text(folder / "surface.csv", io::surface_csv(result));
    nlohmann::ordered_json summary = io::fragility_summary(provenance, result);
    summary["accuracy"] = nlohmann::ordered_json::parse(provenance.accuracy);
    for (const auto& doubt : doubts(study)) summary["warnings"].push_back(doubt);
    for (const auto& warning : accuracy_warnings(summary["accuracy"])) summary["warnings"].push_back(warning);
    if (sweep) summary["timing"] = timing_json(*sweep, world.size());
    summary["files"] = {"samples.h5", "fragility.h5", "bins.csv", "surface.csv", "study.yaml"};
    io::write_text(folder / "summary.json", io::json_text(summary));
  });
}

}  // namespace freestand::study
