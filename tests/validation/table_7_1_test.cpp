// Table 7.1: quarter-scale wooden blocks on the shake table, overturned or not. The 18 rows of the two sound blocks,
// 16 of them under motions whose records are there; the motion of a 6th floor is not.
//
// The motions of the table itself are not published, so an ensemble stands for what the print does not tell:
//   motion     the record, its times halved, scaled to the printed peak table acceleration (PTA) within 3 %
//   component  printed for one motion only (FP): fault-normal or fault-parallel with equal chance; or, "after the
//              others", with the chance that the other rows under the same motion leave to either
//   friction   0.68 within 10 %;  impact: 0.9 to 1 of Housner's rate
//   block      a uniform box of the prototype's size / 4, turning about its narrower side
// A peak says little of what overturns a block, and a table does not follow a record's high frequencies. So the same
// records are also taken smoothed (half power at 20 Hz and 10 Hz of the table's time), then scaled to the same PTA. The
// band of the table is not known: the three answers stand side by side, none of them is fitted.
//
//   half power       as recorded    20 Hz   10 Hz
//   Brier score        0.55          0.18    0.18      mean of (probability - outcome)^2; a coin gets 0.25
//   after the others   0.47          0.11    0.07
//   agree, of 16       2, 6          8, 14   8, 14     the report's own model, under the table's motions: 12
//
// Were the two files of Los Gatos added as if they began together, the Brier scores would be 0.43, 0.32 and 0.22.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <freestand/simulate.hpp>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "base/units.hpp"
#include "motion/record.hpp"
#include "support/data.hpp"
#include "support/keyed_random.hpp"

namespace freestand::test::table_7_1_test {
namespace {

constexpr double inch = 0.0254, length_scale = 1.0 / 4, time_scale = 1.0 / 2;
constexpr double record_dt_s = 0.005, table_dt_s = record_dt_s * time_scale;
constexpr double fault_normal = 38, fault_parallel = 128;  // azimuths, Loma Prieta 1989 (strike 128) [deg]
constexpr std::size_t members = 200;                       // under each component
const std::string folder = "slammer/Loma_Prieta_1989";

std::vector<std::vector<std::string>> read_table(const std::string& name) {
  std::ifstream file(source_dir() / "configs/report" / name);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(file, line);) {
    std::stringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  rows.erase(rows.begin());
  return rows;
}

struct Row {
  std::string block, motion;
  double pta_g, mu;
  bool overturned, working_model_overturned;
};

std::vector<Row> sound_rows() {
  std::vector<Row> rows;
  for (const auto& cells : read_table("table_7_1.csv"))
    if (cells.at(6) == "1")
      rows.push_back({cells[0], cells[1], std::stod(cells[2]), std::stod(cells[3]), cells[4] == "1", cells[5] == "1"});
  return rows;
}

struct Sides {
  double height_m, narrow_m, wide_m;
};

std::map<std::string, Sides> quarter_scale_blocks() {
  std::map<std::string, Sides> blocks;
  for (const auto& cells : read_table("table_3_1.csv")) {
    const double width = std::stod(cells.at(3)), depth = std::stod(cells.at(5)), unit = inch * length_scale;
    blocks[cells[0]] = {std::stod(cells[2]) * unit, std::min(width, depth) * unit, std::max(width, depth) * unit};
  }
  return blocks;
}

std::vector<double> read_component(const std::string& file) {
  const FloorMotion motion = motion::read_record(records_dir() / folder / file, {.dt_s = record_dt_s, .unit = "g"});
  std::vector<double> samples;
  for (std::size_t i = 0; i < motion.segments(); ++i) samples.push_back(motion.horizontal_mps2[2 * i]);
  return samples;
}

// The heads of these files were cut, each for itself. When one begins follows from what they hold: the two of Corralitos
// agree sample by sample with the pair of NGA-West2, which begins at one instant; those of Los Gatos differ by 497 samples in
// length, and the shaking comes 500 samples sooner in the shorter one, so that it has lost its head and both end together; in
// those of Gilroy the shaking comes at one time as they stand.
struct Station {
  const char* named;  // how the table's motions begin
  const char* files[2];
  double azimuths[2];
  std::size_t begins[2];  // samples after the first of the two
};
constexpr Station stations[] = {{"Loma Prieta Los Gatos PC", {"LGP-000", "LGP-090"}, {0, 90}, {0, 497}},
                                {"Loma Prieta Corralitos", {"CLS-000", "CLS-090"}, {0, 90}, {0, 0}},
                                {"Loma Prieta Gilroy Hist. Bldg.", {"GOF-160", "GOF-250"}, {160, 250}, {0, 0}}};

// Zeros where one of the files has nothing.
std::vector<double> component(const Station& station, double azimuth) {
  std::vector<double> sum;
  for (int i = 0; i < 2; ++i) {
    const std::vector<double> part = read_component(station.files[i]);
    sum.resize(std::max(sum.size(), station.begins[i] + part.size()), 0.0);
    for (std::size_t k = 0; k < part.size(); ++k)
      sum[station.begins[i] + k] += part[k] * std::cos((azimuth - station.azimuths[i]) * pi / 180);
  }
  return sum;
}

// Sample in which the first hundredth of the integral of acceleration^2 has come.
std::size_t arrival(const std::vector<double>& samples) {
  double total = 0, so_far = 0;
  for (const double a : samples) total += a * a;
  std::size_t k = 0;
  for (; so_far < 0.01 * total; ++k) so_far += samples[k] * samples[k];
  return k;
}

// Gaussian smoothing with half power at the frequency.
std::vector<double> smoothed(const std::vector<double>& samples, double half_power_hz) {
  const double width = std::sqrt(std::log(2.0)) / (2 * pi * half_power_hz) / table_dt_s;
  const auto count = static_cast<std::ptrdiff_t>(samples.size()), reach = static_cast<std::ptrdiff_t>(5 * width) + 1;
  std::vector<double> weights, out(samples.size(), 0.0);
  double total = 0;
  for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
    const double x = static_cast<double>(k) / width;
    weights.push_back(std::exp(-0.5 * x * x));
    total += weights.back();
  }
  for (std::ptrdiff_t i = 0; i < count; ++i)
    for (std::ptrdiff_t k = std::max(-reach, -i); k <= std::min(reach, count - 1 - i); ++k)
      out[static_cast<std::size_t>(i)] +=
          weights[static_cast<std::size_t>(k + reach)] / total * samples[static_cast<std::size_t>(i + k)];
  return out;
}

// Unit peak; half_power_hz 0: as recorded.
FloorMotion table_motion(const Station& station, double azimuth, double half_power_hz) {
  std::vector<double> samples = component(station, azimuth);
  if (half_power_hz > 0) samples = smoothed(samples, half_power_hz);
  double peak = 0;
  for (const double a : samples) peak = std::max(peak, std::abs(a));
  for (double& a : samples) a /= peak;
  return piecewise_linear(station.named, table_dt_s, samples);
}

const Station* station_of(const Row& row) {
  for (const Station& station : stations)
    if (row.motion.starts_with(station.named) && row.motion.ends_with("ground")) return &station;
  return nullptr;
}

// Share of the ensemble that overturns.
double probability(const Row& row, double width_m, double height_m, const FloorMotion& motion) {
  std::vector<Specimen> specimens;
  std::vector<Shaking> shakings;
  for (std::size_t i = 0; i < members; ++i) {
    KeyedRandom random(71, i);
    const double mu = row.mu * random.uniform(0.9, 1.1), factor = random.uniform(0.9, 1);
    specimens.push_back({Block::rectangular(width_m, height_m, 10), {mu, mu}, {ImpactLaw::housner, factor}});
    shakings.push_back({&motion, row.pta_g * standard_gravity_mps2 * random.uniform(0.97, 1.03)});
  }
  std::vector<Response> responses(members);
  respond_batch(specimens, shakings, {}, responses);
  double overturned = 0.5;  // of one more than there are: none is certain
  for (const Response& r : responses) overturned += r.outcome == Outcome::overturned;
  return overturned / (members + 1);
}

struct Prediction {
  Row row;
  const Station* station;
  bool parallel_only;
  double normal, parallel;  // probabilities under either component

  double likelihood(bool along) const {
    const double p = along ? parallel : normal;
    return row.overturned ? p : 1 - p;
  }
  // Weight of the fault-parallel component.
  double mixed(double weight) const { return parallel_only ? parallel : weight * parallel + (1 - weight) * normal; }
};

std::vector<Prediction> predict(double half_power_hz, double Sides::*width) {
  const auto blocks = quarter_scale_blocks();
  std::map<const Station*, std::vector<FloorMotion>> motions;
  for (const Station& station : stations)
    for (const double azimuth : {fault_normal, fault_parallel})
      motions[&station].push_back(table_motion(station, azimuth, half_power_hz));
  std::vector<Prediction> predictions;
  for (const Row& row : sound_rows()) {
    const Station* station = station_of(row);
    if (!station) continue;
    const Sides& sides = blocks.at(row.block);
    const auto p = [&](std::size_t i) { return probability(row, sides.*width, sides.height_m, motions[station][i]); };
    predictions.push_back({row, station, row.motion.find(" FP ") != std::string::npos, p(0), p(1)});
  }
  return predictions;
}

// Weight of the fault-parallel component after the other rows under that motion.
double weight_after_others(const std::vector<Prediction>& all, const Prediction& one) {
  double normal = 1, parallel = 1;
  for (const Prediction& other : all)
    if (&other != &one && other.station == one.station && !other.parallel_only) {
      normal *= other.likelihood(false);
      parallel *= other.likelihood(true);
    }
  return parallel / (normal + parallel);
}

struct Score {
  double brier = 0, brier_after_others = 0;
  double forma = 0, kelvinator = 0;  // mean probabilities
  int agree = 0, agree_after_others = 0, working_model_agrees = 0;
};

Score score(const std::vector<Prediction>& predictions) {
  Score s;
  int formas = 0;
  const auto rows = static_cast<double>(predictions.size());
  for (const Prediction& one : predictions) {
    const bool truth = one.row.overturned;
    const double p = one.mixed(0.5), after = one.mixed(weight_after_others(predictions, one));
    std::printf(
        "  %-10s %-38s %.2f g  experiment %d, its model %d; normal %.2f, parallel %.2f; after the others %.2f\n",
        one.row.block.c_str(), one.row.motion.c_str(), one.row.pta_g, truth, one.row.working_model_overturned,
        one.normal, one.parallel, after);
    s.brier += (p - truth) * (p - truth) / rows;
    s.brier_after_others += (after - truth) * (after - truth) / rows;
    s.agree += (p > 0.5) == truth;
    s.agree_after_others += (after > 0.5) == truth;
    s.working_model_agrees += one.row.working_model_overturned == truth;
    formas += one.row.block == "FORMA";
    (one.row.block == "FORMA" ? s.forma : s.kelvinator) += p;
  }
  s.forma /= formas;
  s.kelvinator /= rows - formas;
  std::printf(
      "  Brier %.3f, %d of %.0f agree; after the others %.3f, %d; the report's model %d; FORMA %.2f, Kelvinator %.2f\n",
      s.brier, s.agree, rows, s.brier_after_others, s.agree_after_others, s.working_model_agrees, s.forma,
      s.kelvinator);
  return s;
}

TEST(Table7_1AsPrinted, EighteenRowsOfSoundBlocksAndSixteenRecords) {
  int rows = 0, with_record = 0, overturned = 0, model_agrees = 0;
  for (const Row& row : sound_rows()) {
    ++rows;
    with_record += station_of(row) != nullptr;
    overturned += row.overturned;
    model_agrees += row.working_model_overturned == row.overturned;
    if (!station_of(row)) std::printf("no record of %s (%s): left out\n", row.motion.c_str(), row.block.c_str());
  }
  EXPECT_EQ(rows, 18);
  EXPECT_EQ(with_record, 16);
  EXPECT_EQ(overturned, 16);
  EXPECT_EQ(model_agrees, 14);
}

class Table7_1 : public testing::Test {
 protected:
  void SetUp() override {
    for (const Station& station : stations)
      for (const char* file : station.files)
        if (!std::filesystem::exists(records_dir() / folder / file))
          GTEST_SKIP() << "record " << folder << '/' << file << " is not there (in " << records_dir()
                       << "): set FREESTAND_DATA_DIR to run this test";
  }
};

// At one station the shaking comes from both sides at one time: within 0.2 s where the two files are known to begin together.
TEST_F(Table7_1, ComponentsOfAStationBeginWhereTheirShakingMeets) {
  for (const Station& station : stations) {
    double begins_s[2];
    for (int i = 0; i < 2; ++i)
      begins_s[i] = record_dt_s * static_cast<double>(station.begins[i] + arrival(read_component(station.files[i])));
    EXPECT_NEAR(begins_s[0], begins_s[1], 0.2) << station.named;
  }
}

TEST_F(Table7_1, CorralitosBeginsAsThePairThatBeginsTogether) {
  const auto pair = records_dir() / "peer_ngawest2_corralitos";
  if (!std::filesystem::exists(pair)) GTEST_SKIP() << "records " << pair << " are not there";
  for (const auto& [file, whole] :
       {std::pair{"CLS-000", "RSN753_LOMAP_CLS000.AT2"}, {"CLS-090", "RSN753_LOMAP_CLS090.AT2"}}) {
    const std::vector<double> cut = read_component(file);
    const FloorMotion motion = motion::read_record(pair / whole);
    double difference = 0, size = 0;
    for (std::size_t k = 0; k < cut.size(); ++k) {
      difference += std::pow(cut[k] - motion.horizontal_mps2[2 * k], 2);
      size += cut[k] * cut[k];
    }
    EXPECT_LT(std::sqrt(difference / size), 0.03) << file;  // 0.05 s apart they would differ by more than 1
  }
}

// The numbers are what this program gives, kept so that a change of the kernel that moves them is seen. Nearly all of
// the experiments overturned, so that "always" is right in 14 of the 16.
TEST_F(Table7_1, OutcomesOfTheEnsembles) {
  struct Expected {
    double half_power_hz, brier, brier_after_others;
    int agree, agree_after_others;
  };
  constexpr Expected expected[] = {{0, 0.554, 0.473, 2, 6}, {20, 0.181, 0.107, 8, 14}, {10, 0.178, 0.072, 8, 14}};
  for (const Expected& e : expected) {
    std::printf("table that follows up to %.0f Hz (0: the record as it is)\n", e.half_power_hz);
    const Score s = score(predict(e.half_power_hz, &Sides::narrow_m));
    EXPECT_NEAR(s.brier, e.brier, 0.02);
    EXPECT_NEAR(s.brier_after_others, e.brier_after_others, 0.02);
    EXPECT_NEAR(s.agree, e.agree, 1);
    EXPECT_NEAR(s.agree_after_others, e.agree_after_others, 1);
    EXPECT_EQ(s.working_model_agrees, 12);
    EXPECT_NEAR(s.forma, s.kelvinator, 0.1);  // 8 of 8 and 6 of 8 in the experiment
  }
}

// So the experiment, where it always overturned, shook it along its narrow side.
TEST_F(Table7_1, FormaNearlyAlwaysStandsOnItsWideSide) {
  for (const double half_power_hz : {0.0, 20.0, 10.0}) {
    double sum = 0, most = 0;
    int rows = 0;
    for (const Prediction& one : predict(half_power_hz, &Sides::wide_m))
      if (one.row.block == "FORMA") {
        ++rows;
        sum += one.mixed(0.5);
        most = std::max({most, one.normal, one.parallel});
      }
    std::printf("up to %.0f Hz: on its wide side FORMA overturns with probability %.3f, at most %.2f\n", half_power_hz,
                sum / rows, most);
    EXPECT_LT(sum / rows, half_power_hz == 10 ? 0.05 : 0.005);
  }
}

}  // namespace
}  // namespace freestand::test::table_7_1_test
