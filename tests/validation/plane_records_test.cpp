// What is lost where a block that slides in the plane of the floor is computed by its components: the table of README.md, over the
// pairs of real records, where they are there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <freestand/error.hpp>
#include <freestand/simulate.hpp>
#include <map>
#include <vector>

#include "base/csv_table.hpp"
#include "base/units.hpp"
#include "motion/component.hpp"
#include "motion/record.hpp"
#include "support/data.hpp"

namespace freestand::test::plane_records_test {
namespace {

struct Component {
  std::filesystem::path file;
  double dt_s = 0;
};

// Horizontal components of one station that the program takes for a pair: of the same step, length and start.
std::vector<FloorMotion> pairs() {
  const CsvTable index = read_csv_table(records_dir() / "INDEX.csv");
  const auto cell = [&](const CsvTable::Row& row, const char* column) { return row.cells.at(index.column(column)); };
  std::map<std::string, std::vector<Component>> stations;
  for (const CsvTable::Row& row : index.rows) {
    const std::string suite = cell(row, "suite"), component = cell(row, "component");
    const std::filesystem::path file = records_dir() / suite / cell(row, "file");
    if (suite == "vertical_gm_urm" || motion::is_vertical_word(component) || !motion::vertical_sign(file).empty())
      continue;
    stations[suite + "/" + cell(row, "event") + "/" + cell(row, "station")].push_back(
        {file, std::stod(cell(row, "dt_s"))});
  }
  std::vector<FloorMotion> found;
  for (const auto& [station, components] : stations) {
    if (components.size() != 2) continue;
    const bool plain = station.starts_with("slammer") || station.starts_with("fema");
    motion::ReadOptions options{.cross_file = components[1].file.string(), .keep_cross = true};
    if (plain) options.dt_s = components[0].dt_s, options.unit = "g";
    try {
      found.push_back(motion::read_record(components[0].file, options));
    } catch (const Error&) {
      continue;  // other lengths or steps
    }
  }
  return found;
}

FloorMotion alone(const FloorMotion& pair, bool cross) {
  FloorMotion motion = pair;
  if (cross) motion.horizontal_mps2 = motion.cross_mps2;
  motion.cross_mps2.clear();
  index_runs(motion);
  return motion;
}

double largest_acceleration(const FloorMotion& motion) {
  double most = 0;
  for (std::size_t i = 0; i < motion.horizontal_mps2.size(); i += 2)
    most = std::max(most, std::hypot(motion.horizontal_mps2[i], motion.cross_mps2[i]));
  return most;
}

double share(std::vector<double> values, double part) {
  std::sort(values.begin(), values.end());
  const double place = part * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const double up = place - static_cast<double>(below);
  return values[below] + (below + 1 < values.size() ? up * (values[below + 1] - values[below]) : 0.0);
}

TEST(PlaneRecords, WhatComponentsMiss) {
  FREESTAND_NEEDS_RECORDS();
  const std::vector<FloorMotion> motions = pairs();
  ASSERT_GT(motions.size(), 20u);
  std::printf(
      "%zu pairs\n| mu g over the largest acceleration | larger component: median | 5 to 95 %% | root of the sum "
      "of squares: median | 5 to 95 %% |\n|---|---|---|---|---|\n",
      motions.size());
  for (const double part : {0.1, 0.2, 0.3, 0.5, 0.7}) {
    std::vector<double> larger, root;
    for (const FloorMotion& motion : motions) {
      Specimen block;
      block.block = Block::rectangular(0.8, 1.6, 100);
      block.model = Model::slide;
      const double mu = part * largest_acceleration(motion) / standard_gravity_mps2;
      block.friction = {mu, mu};
      const FloorMotion x = alone(motion, false), y = alone(motion, true);
      const Response both = respond(block, {&motion});
      ASSERT_EQ(both.outcome, Outcome::moved) << motion.name;
      ASSERT_GT(both.peak_slip_m, 0);
      const double by_x = respond(block, {&x}).peak_slip_m, by_y = respond(block, {&y}).peak_slip_m;
      larger.push_back(std::max(by_x, by_y) / both.peak_slip_m);
      root.push_back(std::hypot(by_x, by_y) / both.peak_slip_m);
    }
    std::printf("| %.1f | %.2f | %.2f to %.2f | %.2f | %.2f to %.2f |\n", part, share(larger, 0.5), share(larger, 0.05),
                share(larger, 0.95), share(root, 0.5), share(root, 0.05), share(root, 0.95));
    // Friction is shared by the two directions: components alone have more of it than the block has in each, and miss some slip.
    EXPECT_LT(share(larger, 0.5), 1);
    EXPECT_GE(share(root, 0.5), share(larger, 0.5));
  }
}

}  // namespace
}  // namespace freestand::test::plane_records_test
