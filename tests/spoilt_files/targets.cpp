#include <algorithm>
#include <cmath>
#include <cstring>
#include <freestand/error.hpp>
#include <fstream>
#include <span>
#include <stdexcept>

#include "base/lab_table.hpp"
#include "decision/hazard.hpp"
#include "io/database_file.hpp"
#include "io/fragility_file.hpp"
#include "io/samples_file.hpp"
#include "io/tally_file.hpp"
#include "measurement/test_file.hpp"
#include "motion/record.hpp"
#include "motion/record_table.hpp"
#include "parallel/block_log.hpp"
#include "parallel/block_sums.hpp"
#include "parallel/run_files.hpp"
#include "report/own_peaks.hpp"
#include "spoilt_files/target.hpp"
#include "study/catalogue.hpp"
#include "study/known.hpp"
#include "study/problems.hpp"
#include "study/read_building.hpp"
#include "study/read_laboratory.hpp"
#include "study/read_measurements.hpp"
#include "study/read_validation.hpp"
#include "study/specimen_table.hpp"
#include "study/study.hpp"
#include "support/scratch.hpp"

namespace freestand::spoilt_files {
namespace {

// A reader may refuse a file in words of ours, and in no other way.
template <class Read>
void refuses_or_reads(Read&& read) {
  try {
    read();
  } catch (const Error&) {
  }
}

void expect(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

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

void hazard(std::string_view bytes) {
  refuses_or_reads([&] {
    const auto curve = decision::parse_hazard(std::string(bytes), "hazard.csv", {"pga_g", "pgv_mps", "sa_g"});
    for (const double factor : {0.1, 1.0, 10.0})
      expect(std::isfinite(curve.rate(factor * curve.first())), "a rate that is no number");
  });
}

void record(std::string_view bytes) {
  const std::filesystem::path file = written(bytes, "record.txt");
  for (const motion::Component component : {motion::Component::any, motion::Component::vertical})
    for (const char* unit : {"", "g"})
      refuses_or_reads([&] {
        motion::ReadOptions options;
        options.unit = unit;
        options.component = component;
        if (*unit) options.dt_s = 0.01;
        const FloorMotion read = motion::read_record(file, options);
        for (const double a : read.horizontal_mps2) expect(std::isfinite(a), "an acceleration that is no number");
      });
}

void record_table(std::string_view bytes) {
  refuses_or_reads([&] { motion::read_record_table(written(bytes, "INDEX.csv")); });
}

void measured_test(std::string_view bytes) {
  refuses_or_reads([&] {
    measurement::Test test;
    measurement::read_test_file(written(bytes, "t01.csv"), 0, test);
  });
}

void laboratory_table(std::string_view bytes) {
  refuses_or_reads([&] { read_lab_table(written(bytes, "table.txt")); });
}

void fragility_file(std::string_view bytes) {
  refuses_or_reads([&] { io::read_fragility(written(bytes, "fragility.h5")); });
}

void tally_file(std::string_view bytes) {
  refuses_or_reads([&] { io::read_tally(written(bytes, "tally.h5")); });
}

// All of its rows, some at a time, as a fit reads them.
void samples_file(std::string_view bytes) {
  refuses_or_reads([&] {
    const io::SampleReader reader(written(bytes, "samples.h5"));
    constexpr std::int64_t at_once = 4096, most = 1 << 20;
    for (std::int64_t first = 0; first < std::min(reader.rows(), most); first += at_once)
      reader.read(first, std::min(at_once, reader.rows() - first));
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

void peaks(std::string_view bytes) {
  refuses_or_reads([&] { report::own_peaks(written(bytes, "peaks.csv"), run_here); });
}

// Bytes behind `of`, with the checksum of those before them written over them: no hash keeps a fuzzer from what lies behind it.
void seal(std::string& bytes, std::size_t at, std::size_t from, std::size_t to) {
  if (bytes.size() < at + 8 || from > bytes.size()) return;
  const auto all = std::as_bytes(std::span(bytes));
  const std::uint64_t sum = parallel::fnv1a(all.subspan(from, std::min(to, all.size()) - from));
  std::memcpy(bytes.data() + at, &sum, sizeof sum);
}

// The layouts are those of block_log.hpp and block_sums.hpp.
void block_log(std::string_view bytes) {
  std::string sealed(bytes);
  seal(sealed, 104, 120, sealed.size());
  seal(sealed, 112, 0, 112);
  const std::filesystem::path log = written(sealed, "run-0001.node-000000.log");
  refuses_or_reads([&] {
    parallel::BlockLog blocks(log.parent_path(), "0123456789abcdef");
    blocks.find();
    blocks.begin({});
  });
  parallel::count_blocks(log.parent_path());
  std::filesystem::remove(log);
}

void block_sums(std::string_view bytes) {
  std::string sealed(bytes);
  seal(sealed, 96, 112, sealed.size());
  seal(sealed, 104, 0, 104);
  const std::filesystem::path file = written(sealed, "run-0001.node-000000.sums");
  refuses_or_reads([&] {
    parallel::BlockSums sums(file.parent_path(), "0123456789abcdef", 0, 100, 3);
    sums.find();
  });
  parallel::count_summed_blocks(file.parent_path());
  std::filesystem::remove(file);
}

void database_file(std::string_view bytes) {
  refuses_or_reads([&] { io::read_database(written(bytes, "database.h5")); });
}

}  // namespace

const std::vector<Target>& targets() {
  static const std::vector<Target> all{
      {"study", study},
      {"case", simulated_case},
      {"measurements", measurements},
      {"validation", validation},
      {"catalogue", catalogue},
      {"laboratory", laboratory},
      {"specimens", specimens},
      {"hazard", hazard},
      {"record", record},
      {"record_table", record_table},
      {"measured_test", measured_test},
      {"laboratory_table", laboratory_table},
      {"fragility_file", fragility_file},
      {"tally_file", tally_file},
      {"database_file", database_file},
      {"samples_file", samples_file},
      {"building", building},
      {"peaks", peaks},
      {"block_log", block_log},
      {"block_sums", block_sums},
  };
  return all;
}

const Target& target(const std::string& name) {
  std::string names;
  for (const Target& each : targets()) {
    if (each.name == name) return each;
    names += (names.empty() ? "" : ", ") + each.name;
  }
  throw std::invalid_argument("no target is called \"" + name + "\": " + names);
}

std::filesystem::path written(std::string_view bytes, const std::string& name) {
  static const test::Scratch folder("spoilt_files");
  const std::filesystem::path file = folder / name;
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return file;
}

}  // namespace freestand::spoilt_files
