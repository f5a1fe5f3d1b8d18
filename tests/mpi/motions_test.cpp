#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <sstream>

#include "base/motion_table.hpp"
#include "mpi/mpi_main.hpp"
#include "study/known.hpp"
#include "study/motion_bytes.hpp"
#include "support/scratch.hpp"

namespace freestand::study {
namespace {

using test::world;

// The file that lies in memory at this address, by device and number; empty where there is none.
std::string file_at(const void* address) {
  std::ifstream maps("/proc/self/maps");
  const auto at = reinterpret_cast<std::uintptr_t>(address);
  for (std::string line; std::getline(maps, line);) {
    std::uintptr_t first = 0, last = 0;
    char dash = 0;
    std::string rights, offset, device, number;
    std::istringstream(line) >> std::hex >> first >> dash >> last >> rights >> offset >> device >> number;
    if (first <= at && at < last) return number == "0" ? "" : device + " " + number + " " + rights;
  }
  return "nowhere";
}

double own_memory_mb() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (double kb = 0; word == "RssAnon:" && status >> kb) return kb / 1000;
  return -1;
}

class Motions : public testing::Test {
 protected:
  static constexpr int length = 200000;
  // Of each instant: its time, two channels of two coefficients, and of the table eleven doubles and three short numbers.
  static constexpr double records_mb = length * (8 * (1 + 4 + 11) + 2 * 3) / 1e6;

  void SetUp() override {
    folder_ = world().broadcast(scratch_.folder().string());
    world().on_root([&] {
      std::ofstream record(scratch_ / "record.csv");
      record << "time_s,floor_acceleration_mps2,floor_vertical_acceleration_mps2\n";
      for (int i = 0; i < length; ++i)
        record << i / 100.0 << ',' << std::cos(0.01 * i) << ',' << std::sin(0.01 * i) << '\n';
      record.close();
      std::ofstream(scratch_ / "study.yaml")
          << "seed: 1\nsamples: 10\nblock: {width_m: 0.6, height_m: 1.8}\nfriction: {mu: 0.2}\n"
             "motions: [{records: record.csv, scale: 1}, {pulse: B, period_s: 1, peak_acceleration_g: 1}]\n"
             "fragility: {im: pga_g, bins: {count: 2}, edp: [peak_slip_m], capacities: {peak_slip_m: [0.1]}}\n";
    });
    study_ = read_study(std::filesystem::path(folder_) / "study.yaml", registries());
  }
  void TearDown() override { world().barrier(); }

  void expect_those_of_the_files(const MotionSet& taken) {
    const MotionSet read = load_motions(study_);
    ASSERT_NE(read.motion(0).table, nullptr);
    EXPECT_EQ(taken.fingerprint(), read.fingerprint());
    const MotionTable &a = *taken.motion(0).table, &b = *read.motion(0).table;
    EXPECT_TRUE(a.displacement == b.displacement && a.columns == b.columns && a.both == b.both);
    EXPECT_TRUE(a.heights == b.heights && a.run_levels == b.run_levels && a.levels_to_one == b.levels_to_one);
    EXPECT_EQ(a.backwards, b.backwards);
    EXPECT_EQ(taken.motion(0).vertical_run_mps2, read.motion(0).vertical_run_mps2);
    EXPECT_EQ(taken.motion(1).table, nullptr);
  }

  test::Scratch scratch_{"motions_of_ranks"};
  std::string folder_;
  Study study_;
};

TEST_F(Motions, LieOnceInTheMemoryOfANode) {
  if (world().size() == 1) GTEST_SKIP() << "one rank shares with no other";
  const double before = own_memory_mb();
  const MotionSet motions = load_motions_together(world(), study_);
  EXPECT_LT(own_memory_mb() - before, world().is_root() ? 1e9 : records_mb / 10);  // the root has read them
  const FloorMotion& motion = motions.motion(0);
  const std::string file = file_at(motion.horizontal_mps2.data());
  EXPECT_THAT(file, testing::HasSubstr(" r--s"));  // to be read only, and no copy of a page
  EXPECT_EQ(world().broadcast(file), file);
  for (const void* row :
       {static_cast<const void*>(motion.knot_s.data()), static_cast<const void*>(motion.table->columns.data()),
        static_cast<const void*>(motion.table->heights.data())})
    EXPECT_EQ(file_at(row), file);
  expect_those_of_the_files(motions);
}

TEST_F(Motions, OutliveTheirSet) {
  FloorMotion copy, moved;
  {
    MotionSet motions = load_motions_together(world(), study_);
    copy = motions.motion(0);
    moved = std::move(const_cast<FloorMotion&>(motions.motion(1)));
  }
  copy.horizontal_mps2[0] += 1;
  EXPECT_EQ(copy.horizontal_mps2[0], 2);
  EXPECT_EQ(copy.table->knots, length);
  EXPECT_EQ(copy.table->acceleration[0], 1);
  EXPECT_EQ(moved.knot_s.front(), 0);
}

// A limit on the size of files is one on that of shared memory.
TEST_F(Motions, AreCopiesWhereANodeHasNoRoomToShareThem) {
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{4096, before.rlim_max};
  testing::internal::CaptureStderr();
  setrlimit(RLIMIT_FSIZE, &small);
  const MotionSet motions = load_motions_together(world(), study_);
  setrlimit(RLIMIT_FSIZE, &before);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_EQ(said.find("of their own") != std::string::npos, world().is_root() && world().size() > 1) << said;
  EXPECT_EQ(file_at(motions.motion(0).horizontal_mps2.data()), "");
  EXPECT_EQ(file_at(motions.motion(0).table->columns.data()), "");
  expect_those_of_the_files(motions);
}

}  // namespace
}  // namespace freestand::study
