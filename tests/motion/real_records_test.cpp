// Real records, where they are there: what the readers give against the index that came with the records.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "base/units.hpp"
#include "motion/component.hpp"
#include "motion/identify.hpp"
#include "motion/offset.hpp"
#include "motion/peaks.hpp"
#include "motion/record.hpp"
#include "support/data.hpp"

namespace freestand::motion {
namespace {

struct Indexed {
  std::string suite, file, component;
  double dt_s, pga_g;
  std::size_t points;
  std::filesystem::path path() const { return test::records_dir() / suite / file; }
};

// Fields of one csv line; quoted ones may hold commas.
std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> all{""};
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      all.emplace_back();
    else if (c != '\r')
      all.back() += c;
  }
  return all;
}

std::vector<Indexed> index_of_records() {
  std::ifstream file(test::records_dir() / "INDEX.csv");
  std::string line;
  std::getline(file, line);
  std::vector<Indexed> records;
  while (std::getline(file, line)) {
    const auto f = fields(line);
    records.push_back({f.at(0), f.at(1), f.at(4), std::stod(f.at(5)), std::stod(f.at(7)), std::stoul(f.at(6))});
  }
  return records;
}

void expect_as_indexed(const Indexed& record, const ReadOptions& options) {
  SCOPED_TRACE(record.suite + "/" + record.file + " " + options.channel);
  const FloorMotion motion = read_record(record.path(), options);
  EXPECT_EQ(motion.knot_s.size(), record.points);
  EXPECT_NEAR(motion.knot_s[1], record.dt_s, 1e-12);
  EXPECT_NEAR(peaks(motion).pga_mps2 / standard_gravity_mps2, record.pga_g, 5.1e-5);
}

TEST(RealRecords, EveryPeerFileReadsWithThePeakOfTheIndex) {
  FREESTAND_NEEDS_RECORDS();
  std::size_t read = 0;
  for (const Indexed& record : index_of_records()) {
    if (record.path().extension() != ".AT2") continue;
    expect_as_indexed(record, {});
    ++read;
  }
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(test::records_dir()))
    files += entry.path().extension() == ".AT2";
  EXPECT_EQ(read, files);
  EXPECT_GT(read, 0u);
}

TEST(RealRecords, PlainSuitesReadWithStepAndUnitGiven) {
  FREESTAND_NEEDS_RECORDS();
  std::size_t read = 0;
  for (const Indexed& record : index_of_records()) {
    const bool metric = record.suite == "vertical_gm_urm";
    if (!metric && record.suite != "slammer" && record.suite != "fema_p695_farfield" &&
        record.suite != "openseesrt_tcu065")
      continue;
    expect_as_indexed(record, {.dt_s = record.dt_s, .unit = metric ? "m/s2" : "g"});
    ++read;
  }
  EXPECT_GT(read, 300u);
}

// The index lists the channels of the CSMIP file in the order of the file, but names the second H2 and the third UP;
// the file itself says Up and H2. So they are taken by their numbers.
TEST(RealRecords, AgencyFormatsReadWithThePeakOfTheIndex) {
  FREESTAND_NEEDS_RECORDS();
  int channel = 0;
  for (const Indexed& record : index_of_records()) {
    if (record.suite != "usgs_gmprocess" || record.path().extension() == ".AT2") continue;
    const bool several = record.path().extension() == ".V2";
    expect_as_indexed(record, {.channel = several ? std::to_string(++channel) : ""});
  }
  EXPECT_EQ(channel, 3);
}

// The header of the CSMIP file gives peaks of the processed velocity and displacement, integrated by the agency.
TEST(RealRecords, IntegrationAgreesWithTheAgencys) {
  FREESTAND_NEEDS_RECORDS();
  const FloorMotion motion = read_record(test::records_dir() / "usgs_gmprocess" / "CE58667.V2");
  const MotionPeaks p = peaks(motion);
  EXPECT_NEAR(peaks(motion, Channel::vertical).pga_mps2, 0.11244, 1e-5);  // channel 2, "Up"
  EXPECT_NEAR(p.pga_mps2, 0.27114, 1e-5);
  EXPECT_NEAR(p.pgv_mps, 0.02890, 2e-4);
}

// Near-fault records whose pulse the report or the literature names.
TEST(RealRecords, KnownPulsesAreIdentified) {
  FREESTAND_NEEDS_RECORDS();
  const IdentifiedPulse corralitos =
      identify_pulse(read_record(test::records_dir() / "peer_ngawest2_corralitos" / "RSN753_LOMAP_CLS000.AT2"));
  EXPECT_EQ(corralitos.type, "B");  // table 8.1 of the report: B, 0.6 s
  EXPECT_NEAR(corralitos.period_s, 0.6, 0.1);
  const IdentifiedPulse rinaldi =
      identify_pulse(read_record(test::records_dir() / "simcenter_eeuq" / "Rinaldi228.AT2"));
  EXPECT_EQ(rinaldi.type, "B");
  EXPECT_NEAR(rinaldi.period_s, 1.1, 0.2);
  EXPECT_GT(rinaldi.explained, 0.5);
  for (const char* file : {"RSN763_LOMAP_GIL067.AT2", "RSN763_LOMAP_GIL337.AT2"})
    EXPECT_EQ(identify_pulse(read_record(test::records_dir() / "usgs_gmprocess" / file)).type, "A")
        << file;  // table 5.1
}

TEST(RealRecords, VerticalOnesAreKnownForThatAndNoOthers) {
  FREESTAND_NEEDS_RECORDS();
  std::size_t vertical = 0;
  for (const Indexed& record : index_of_records()) {
    if (record.path().extension() == ".V2") continue;  // three channels
    const std::string sign = vertical_sign(record.path());
    vertical += !sign.empty();
    EXPECT_EQ(!sign.empty(), is_vertical_word(record.component) || record.component == "HNZ")
        << record.file << ", " << record.component << ": " << sign;
  }
  EXPECT_EQ(vertical, 38u);
}

TEST(RealRecords, NoneHasAnOffsetThatIsDoubted) {
  FREESTAND_NEEDS_RECORDS();
  for (const Indexed& record : index_of_records()) {
    const bool metric = record.suite == "vertical_gm_urm";
    ReadOptions options;
    if (metric || record.suite == "slammer" || record.suite == "fema_p695_farfield" ||
        record.suite == "openseesrt_tcu065")
      options = {.dt_s = record.dt_s, .unit = metric ? "m/s2" : "g"};
    const Offset found = offset(read_record(record.path(), options));
    EXPECT_FALSE(found.doubtful()) << record.path() << ": " << found.acceleration_mps2 << " m/s2, " << found.leaving_mps
                                   << " against " << found.shaking_mps << " m/s";
  }
}

TEST(RealRecords, PairOfHorizontalAndVerticalReads) {
  FREESTAND_NEEDS_RECORDS();
  const auto folder = test::records_dir() / "peer_ngawest2_triples";
  const FloorMotion motion = read_record(folder / "RSN1633_MANJIL_ABBAR--L.AT2",
                                         {.vertical_file = (folder / "RSN1633_MANJIL_ABBAR--V.AT2").string()});
  EXPECT_EQ(motion.knot_s.size(), 2676u);  // five points longer than the vertical
  EXPECT_NEAR(peaks(motion).pga_mps2 / standard_gravity_mps2, 0.5146, 5.1e-5);
  EXPECT_NEAR(peaks(motion, Channel::vertical).pga_mps2 / standard_gravity_mps2, 0.5380, 5.1e-5);
}

}  // namespace
}  // namespace freestand::motion
