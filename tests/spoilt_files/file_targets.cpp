// Records, tables, and files that a run writes and finds again.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

#include "base/lab_table.hpp"
#include "decision/hazard.hpp"
#include "fragility/tally.hpp"
#include "io/database_file.hpp"
#include "io/folder_lock.hpp"
#include "io/fragility_file.hpp"
#include "io/samples_file.hpp"
#include "io/tally_file.hpp"
#include "measurement/data/test_file.hpp"
#include "motion/record.hpp"
#include "motion/record_table.hpp"
#include "parallel/block_log.hpp"
#include "parallel/block_sums.hpp"
#include "parallel/run_files.hpp"
#include "report/own_peaks.hpp"
#include "spoilt_files/target.hpp"

namespace freestand::spoilt_files {
namespace {

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
  refuses_or_reads([&] {
    const fragility::Result result = io::read_fragility(written(bytes, "fragility.h5")).result;
    expect(result.confidence > 0 && result.confidence < 1, "a confidence that is none");
    expect(result.samples >= 0 && result.outside_im >= 0 && result.motions >= 0 && result.resamples >= 0,
           "fewer than none");
    for (const auto* intensities : {&result.im_edge, &result.im, &result.cell_im})
      for (const double im : *intensities) expect(std::isfinite(im), "an intensity that is no number");
    for (const fragility::EdpResult& edp : result.edps)
      for (const double capacity : edp.capacity) expect(std::isfinite(capacity), "a capacity that is no number");
  });
}

void tally_file(std::string_view bytes) {
  refuses_or_reads([&] {
    const io::Provenance from = io::read_tally(written(bytes, "tally.h5")).provenance;
    expect(from.samples >= 0 && from.ranks >= 0, "fewer than none");
    expect(!from.alike || (*from.alike >= 0 && *from.alike <= from.samples), "more samples alike than there are");
  });
}

void database_file(std::string_view bytes) {
  refuses_or_reads([&] {
    const database::Database db = io::read_database(written(bytes, "database.h5"));
    expect(db.confidence > 0 && db.confidence < 1, "a confidence that is none");
    for (const database::Curve& curve : db.curves) {
      expect(curve.entry < db.entries.size(), "a curve of no entry");
      expect(std::isfinite(curve.capacity), "a capacity that is no number");
      for (const database::Point& point : curve.points)
        expect(std::isfinite(point.im), "an intensity that is no number");
    }
  });
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

// Samples with whatever numbers: of eight bytes each an intensity, a slip and a friction, and a byte each that names a motion and an outcome.
void tallied_rows(std::string_view bytes) {
  fragility::Options options;
  options.im_name = "report";
  options.im_edge = {-0.5, 1, 2, 4};
  options.open_ends = true;
  options.edps = {{"peak_slip_m", "m", "", false, 0, {1e-3, 0.5}}, {"overturned", "1", "", true, 0, {}}};
  options.axes = {{"friction_mu_k", "1", {0.1, 0.3, 1e300}}};
  options.motion_group = {0, 1, -1};
  fragility::Tally tally(options);
  constexpr std::size_t row = 3 * sizeof(double) + 2;
  for (; bytes.size() >= row; bytes.remove_prefix(row)) {
    double number[3];
    std::memcpy(number, bytes.data(), sizeof number);
    const auto motion = static_cast<unsigned char>(bytes[row - 2]) % 3U,
               outcome = static_cast<unsigned char>(bytes[row - 1]) % 6U;
    const double edp[] = {number[1], outcome == static_cast<unsigned>(Outcome::overturned) ? 1.0 : 0.0};
    tally.add({static_cast<std::uint64_t>(tally.samples()), number[0], static_cast<int>(motion),
               static_cast<Outcome>(outcome), edp, std::span(&number[2], 1)});
  }
  const auto within = [&](double sum, double most) {
    expect(std::abs(sum) <= most * static_cast<double>(tally.samples()), "a sum that samples cannot have");
  };
  constexpr double largest = 1e12, largest_ln = 750;
  for (std::size_t bin = 0; bin + 1 < options.im_edge.size(); ++bin)
    for (std::size_t group = 0; group < tally.layout().groups; ++group) {
      const fragility::Counts counts = tally.counts(0, bin, group);
      expect(counts.n == counts.still + counts.over + counts.moved, "samples that are nowhere");
      for (const double sum : {counts.sum_ln, counts.sum_ln_im}) within(sum, largest_ln);
      for (const double sum : {counts.sum_ln2, counts.sum_ln_im2, counts.sum_ln_times_ln_im})
        within(sum, largest_ln * largest_ln);
    }
  const fragility::RegressionSums line = tally.regression(0);
  for (const double sum : {line.x, line.y}) within(sum, largest);
  for (const double sum : {line.xx, line.xy, line.yy}) within(sum, largest * largest);
  for (std::size_t cell = 0; cell < tally.layout().im_cell_count(); ++cell) within(tally.im_cell(cell).im_sum, largest);
}

// Whoever finds a lock that tells nothing waits, here a millisecond, and takes it over.
void lock(std::string_view bytes) {
  const std::filesystem::path file = written(bytes, io::lock_name);
  refuses_or_reads([&] { io::FolderLock(file.parent_path(), {.silence_s = 1e-3}); });
  std::filesystem::remove(file);
}

// Read, and not fitted, which takes seconds.
void peaks(std::string_view bytes) {
  const Jobs none = [](const std::string&, std::size_t, const Job&) -> std::vector<std::vector<double>> {
    throw Error("it was read");
  };
  refuses_or_reads([&] { report::own_peaks(written(bytes, "peaks.csv"), none); });
}

// Bytes behind `of`, with the checksum of those before them written over them: no hash keeps spoilt bytes from what lies behind it.
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

}  // namespace

std::vector<Target> file_targets() {
  return {
      {"hazard", hazard},
      {"record", record},
      {"record_table", record_table},
      {"measured_test", measured_test},
      {"laboratory_table", laboratory_table},
      {"fragility_file", fragility_file},
      {"tally_file", tally_file},
      {"database_file", database_file},
      {"samples_file", samples_file},
      {"tallied_rows", tallied_rows},
      {"lock", lock},
      {"peaks", peaks},
      {"block_log", block_log},
      {"block_sums", block_sums},
  };
}

}  // namespace freestand::spoilt_files
