// Blocks under real floor motions: the integrator of the sweep against the reference, and against the independent
// time-stepping with contact impulses while that is not chaotic.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "base/units.hpp"
#include "motion/record.hpp"
#include "support/contact_stepper.hpp"
#include "support/data.hpp"
#include "support/solvers.hpp"

namespace freestand::test {
namespace {

struct TestBlock {
  const char* name;
  double width_m, height_m, mu_s, mu_k;
};
constexpr TestBlock blocks[] = {{"refrigerator, slides", 0.8, 1.0, 0.2, 0.15},
                                {"cabinet, rocks", 0.6, 1.9, 0.9, 0.8},
                                {"cabinet, slide-rocks", 0.5, 1.5, 0.36, 0.36},
                                {"rack, slide-rocks", 0.7, 2.0, 0.42, 0.37}};

Specimen specimen_of(const TestBlock& block) {
  Specimen specimen;
  specimen.block = Block::rectangular(block.width_m, block.height_m, 200);
  specimen.friction = {block.mu_s, block.mu_k};
  specimen.impact.law = ImpactLaw::coulomb;
  return specimen;
}

// Every n-th .AT2 file, in order of their paths, so that the choice does not depend on the file system.
std::vector<FloorMotion> some_records(std::size_t count) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(records_dir()))
    if (entry.path().extension() == ".AT2" || entry.path().extension() == ".at2") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<FloorMotion> records;
  for (std::size_t i = 0; i < files.size() && records.size() < count;
       i += std::max<std::size_t>(1, files.size() / count))
    records.push_back(motion::read_record(files[i]));
  return records;
}

double peak(const FloorMotion& record) {
  double most = 0;
  const auto width = static_cast<std::size_t>(record.degree) + 1;
  for (std::size_t i = 0; i < record.horizontal_mps2.size(); i += width)
    most = std::max(most, std::abs(record.horizontal_mps2[i]));
  return most;
}

constexpr double tolerance = 1e-7;  // m of slip, rad

bool differ(const Response& a, const Response& b) {
  if (a.outcome != b.outcome) return true;
  return std::abs(a.peak_slip_m - b.peak_slip_m) > tolerance ||
         std::abs(a.residual_slip_m - b.residual_slip_m) > tolerance ||
         std::abs(a.peak_rotation_rad - b.peak_rotation_rad) > tolerance;
}

// A sample is sensitive when a change of the motion by 1e-10 changes its own answer by more than the tolerance: after
// fifty impacts on strong motions some are. There only chance decides whether two programs agree; they are counted.
TEST(RealRecords, FastAgainstReference) {
  FREESTAND_NEEDS_RECORDS();
  const Settings tight{.tolerance = 1e-12};
  int runs = 0, moved = 0, sensitive = 0;
  for (const FloorMotion& record : some_records(24)) {
    for (const TestBlock& block : blocks) {
      for (const double pga_g : {0.3, 0.7}) {
        const Specimen specimen = specimen_of(block);
        const Shaking shaking{&record, pga_g * standard_gravity_mps2 / peak(record)};
        Shaking more = shaking, less = shaking;
        more.scale *= 1 + 1e-10;
        less.scale *= 1 - 1e-10;
        const Response fast = respond(specimen, shaking, tight);
        ++runs;
        moved += fast.outcome == Outcome::at_rest ? 0 : 1;
        if (differ(fast, respond(specimen, more, tight)) || differ(fast, respond(specimen, less, tight))) {
          ++sensitive;
          continue;
        }
        const Response reference = respond_reference(specimen, shaking, tight);
        EXPECT_FALSE(differ(fast, reference))
            << record.name << ", " << block.name << " at " << pga_g << " g: " << name(fast.outcome) << '/'
            << name(reference.outcome) << ", slip " << fast.peak_slip_m << '/' << reference.peak_slip_m << ", rotation "
            << fast.peak_rotation_rad << '/' << reference.peak_rotation_rad << ", impacts " << fast.impacts;
      }
    }
  }
  std::printf("%d runs on real records, %d moved, %d too sensitive to compare\n", runs, moved, sensitive);
  EXPECT_GE(runs, 100);
  EXPECT_GT(moved, runs / 2);
  EXPECT_LE(sensitive, moved / 5);
}

TEST(RealRecords, FastAgainstTheContactStepper) {
  FREESTAND_NEEDS_RECORDS();
  constexpr double fanned_out = 1e-4, least = 1e-6, margin = 6;
  double compared_s = 0, worst = 0;
  int runs = 0;
  for (const FloorMotion& record : some_records(8)) {
    for (const TestBlock& block : blocks) {
      const Specimen specimen = specimen_of(block);
      const Shaking shaking{&record, 0.6 * standard_gravity_mps2 / peak(record)};
      const double end = std::min(record.duration_s(), 12.0);
      const StepperResult coarse = step_contacts(specimen, floor_of(shaking), {1e-3 / 29, end, 1e-3});
      const StepperResult fine = step_contacts(specimen, floor_of(shaking), {2e-5, end, 1e-3});
      History history;
      history.step_s = 1e-3;
      respond(specimen, shaking, {}, &history);
      ++runs;
      double own_slip = 0, own_rotation = 0;
      for (std::size_t i = 0; i < std::min({coarse.points.size(), fine.points.size(), history.points.size()}); ++i) {
        own_slip = std::max(own_slip, std::abs(coarse.points[i].slip_m - fine.points[i].slip_m));
        own_rotation = std::max(own_rotation, std::abs(coarse.points[i].rotation_rad - fine.points[i].rotation_rad));
        if (own_slip > fanned_out || own_rotation > fanned_out) break;
        compared_s += 1e-3;
        const double slip = std::abs(history.points[i].slip_m - fine.points[i].slip_m);
        const double rotation = std::abs(history.points[i].rotation_rad - fine.points[i].rotation_rad);
        ASSERT_LT(slip, least + margin * own_slip)
            << record.name << ", " << block.name << " at " << fine.points[i].time_s;
        ASSERT_LT(rotation, least + margin * own_rotation)
            << record.name << ", " << block.name << " at " << fine.points[i].time_s;
        worst = std::max({worst, slip, rotation});
      }
    }
  }
  std::printf("%d runs, %.0f s compared, worst difference %.1e\n", runs, compared_s, worst);
  EXPECT_GE(runs, 28);
  EXPECT_GT(compared_s, 100);
}

}  // namespace
}  // namespace freestand::test
