#include "report/quarter_scale.hpp"

#include <algorithm>
#include <cmath>
#include <freestand/simulate.hpp>

#include "base/random.hpp"
#include "base/units.hpp"
#include "report/printed_table.hpp"

namespace freestand::report {
namespace {

// Share of the ensemble that overturns, of one member more than there are: none is certain.
double probability(const BlockTest& test, double width_m, double height_m, const FloorMotion& motion) {
  const std::uint64_t stream = random::stable_hash("report/quarter_scale");
  std::vector<Specimen> specimens;
  std::vector<Shaking> shakings;
  for (std::size_t i = 0; i < ensemble_members; ++i) {
    const auto within = [&](std::size_t which, double low, double high) {
      return low + (high - low) * random::uniform(71, 3 * i + which, stream);
    };
    const double mu = test.mu * within(0, 0.9, 1.1);
    specimens.push_back({Block::rectangular(width_m, height_m, 10), {mu, mu}, {ImpactLaw::housner, within(1, 0.9, 1)}});
    shakings.push_back({&motion, test.pta_g * standard_gravity_mps2 * within(2, 0.97, 1.03)});
  }
  std::vector<Response> responses(ensemble_members);
  respond_batch(specimens, shakings, {}, responses);
  double overturned = 0.5;
  for (const Response& r : responses) overturned += r.outcome == Outcome::overturned;
  return overturned / (ensemble_members + 1);
}

}  // namespace

std::vector<BlockTest> sound_tests(const Sources& sources) {
  const PrintedTable table(sources, "table_7_1.csv");
  const auto block = table.texts("prototype"), motion = table.texts("motion");
  const auto pta = table.numbers("pta_g"), mu = table.numbers("mu"),
             experiment = table.numbers("experiment_overturned"), model = table.numbers("working_model_overturned"),
             usable = table.numbers("usable");
  std::vector<BlockTest> tests;
  for (std::size_t i = 0; i < block.size(); ++i)
    if (usable[i] == 1) tests.push_back({block[i], motion[i], pta[i], mu[i], experiment[i] == 1, model[i] == 1});
  return tests;
}

std::map<std::string, Sides> quarter_scale_blocks(const Sources& sources) {
  const PrintedTable table(sources, "table_3_1.csv");
  const auto name = table.texts("specimen");
  const auto height = table.numbers("height_in"), width = table.numbers("width_in"), depth = table.numbers("depth_in");
  constexpr double unit = inch_m * length_scale;
  std::map<std::string, Sides> blocks;
  for (std::size_t i = 0; i < name.size(); ++i)
    blocks[name[i]] = {height[i] * unit, std::min(width[i], depth[i]) * unit, std::max(width[i], depth[i]) * unit};
  return blocks;
}

double Prediction::likelihood(bool along) const {
  const double p = along ? parallel : normal;
  return test.overturned ? p : 1 - p;
}

double Prediction::mixed(double weight) const {
  return parallel_only ? parallel : weight * parallel + (1 - weight) * normal;
}

std::vector<Prediction> predict(const Sources& sources, const std::filesystem::path& records, double half_power_hz,
                                double Sides::*width) {
  const auto folder = station_folder(records);
  const auto blocks = quarter_scale_blocks(sources);
  std::map<const Station*, std::vector<FloorMotion>> motions;
  for (const Station& station : stations)
    for (const double azimuth : {fault_normal, fault_parallel})
      motions[&station].push_back(table_motion(folder, station, azimuth, half_power_hz));
  std::vector<Prediction> predictions;
  for (const BlockTest& test : sound_tests(sources))
    if (const Station* station = station_of(test.motion))
      predictions.push_back({test, station, test.motion.find(" FP ") != std::string::npos, 0, 0});
  const auto shares = sources.jobs("table 7.1", predictions.size(), [&](std::size_t i) {
    const Prediction& one = predictions[i];
    const Sides& sides = blocks.at(one.test.block);
    const auto& both = motions.at(one.station);
    return std::vector{probability(one.test, sides.*width, sides.height_m, both[0]),
                       probability(one.test, sides.*width, sides.height_m, both[1])};
  });
  for (std::size_t i = 0; i < predictions.size(); ++i) {
    predictions[i].normal = shares[i][0];
    predictions[i].parallel = shares[i][1];
  }
  return predictions;
}

double weight_after_others(const std::vector<Prediction>& all, const Prediction& one) {
  double normal = 1, parallel = 1;
  for (const Prediction& other : all)
    if (&other != &one && other.station == one.station && !other.parallel_only) {
      normal *= other.likelihood(false);
      parallel *= other.likelihood(true);
    }
  return parallel / (normal + parallel);
}

Score score(const std::vector<Prediction>& predictions) {
  Score s;
  int formas = 0;
  const auto rows = static_cast<double>(predictions.size());
  for (const Prediction& one : predictions) {
    const bool truth = one.test.overturned;
    const double p = one.mixed(0.5), after = one.mixed(weight_after_others(predictions, one));
    s.brier += (p - truth) * (p - truth) / rows;
    s.brier_after_others += (after - truth) * (after - truth) / rows;
    s.agree += (p > 0.5) == truth;
    s.agree_after_others += (after > 0.5) == truth;
    s.working_model_agrees += one.test.working_model_overturned == truth;
    formas += one.test.block == "FORMA";
    (one.test.block == "FORMA" ? s.forma : s.kelvinator) += p;
  }
  s.forma /= formas;
  s.kelvinator /= rows - formas;
  return s;
}

}  // namespace freestand::report
