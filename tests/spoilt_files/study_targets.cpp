// Files in YAML, and what stands beside them.
#include "spoilt_files/target.hpp"
#include "study/catalogue.hpp"
#include "study/known.hpp"
#include "study/problems.hpp"
#include "study/read_building.hpp"
#include "study/read_laboratory.hpp"
#include "study/read_measurements.hpp"
#include "study/read_validation.hpp"
#include "study/rounds.hpp"
#include "study/specimen_table.hpp"
#include "study/study.hpp"

namespace freestand::spoilt_files {
namespace {

// What is read is written out again in full, and that is the same study.
void study(std::string_view bytes) {
  refuses_or_reads([&] {
    const std::filesystem::path file = written(bytes, "study.yaml");
    const study::Study read = study::read_study(file, study::registries());
    const std::string stored = study::expanded(read, file.parent_path());
    expect(study::expanded(study::parse_stored(stored, file), file.parent_path()) == stored,
           "the expanded study is read as another one");
  });
}

void simulated_case(std::string_view bytes) {
  refuses_or_reads([&] { study::read_case(written(bytes, "case.yaml")); });
}

void measurements(std::string_view bytes) {
  refuses_or_reads([&] { study::read_measurements(written(bytes, "dataset.yaml")); });
}

void validation(std::string_view bytes) {
  refuses_or_reads([&] { study::read_validation(written(bytes, "validation.yaml")); });
}

void catalogue(std::string_view bytes) {
  refuses_or_reads([&] { study::read_catalogue(written(bytes, "catalogue.yaml"), study::registries()); });
}

void laboratory(std::string_view bytes) {
  refuses_or_reads([&] { study::read_laboratory(written(bytes, "lab.yaml")); });
}

void specimens(std::string_view bytes) {
  refuses_or_reads([&] {
    study::Problems problems("specimens.csv");
    study::read_specimen_table(written(bytes, "specimens.csv"), problems);
  });
}

void building(std::string_view bytes) {
  refuses_or_reads([&] {
    const study::BuildingPart read = study::read_building_file(written(bytes, "building.yaml"));
    const std::string text = study::building_text(read);
    expect(study::building_text(study::read_building_file(written(text, "written.yaml"))) == text,
           "the building is read as another one");
  });
}

// What is read is what would be stored again.
void rounds(std::string_view bytes) {
  const std::filesystem::path file = written(bytes, "run-0000.node-000000.rounds");
  const parallel::Communicator alone;
  study::Rounds read(alone, file.parent_path(), "0123456789abcdef");
  read.read();
  for (std::int64_t i = 0; i < read.count(); ++i) read.of(read[i].end);
  std::filesystem::remove(file);
}

}  // namespace

std::vector<Target> study_targets() {
  return {
      {"study", study},           {"case", simulated_case}, {"measurements", measurements},
      {"validation", validation}, {"catalogue", catalogue}, {"laboratory", laboratory},
      {"specimens", specimens},   {"building", building},   {"rounds", rounds},
  };
}

}  // namespace freestand::spoilt_files
