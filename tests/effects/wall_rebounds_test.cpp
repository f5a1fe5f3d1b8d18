// Beside a wall blows of floor and wall follow one another ever faster, and which of them a tolerance goes through is its own matter:
// the largest acceleration is not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/motion_table.hpp"
#include "base/units.hpp"
#include "effects/effect_fixture.hpp"

namespace freestand::test {
namespace {

RandomCase beside_a_wall(std::uint64_t number, double gap_m, double restitution) {
  CaseFamily family;
  family.seed = 97;
  family.alpha_low = 0.12;
  family.alpha_high = 0.5;
  family.one_model = 0;
  family.duration_low_s = 2;
  family.duration_high_s = 3;
  RandomCase c = random_case(family, number);
  c.specimen.model = Model::slide_rock;
  c.specimen.effects = {effect("wall_impact", {gap_m, restitution})};
  return c;
}

// What the floor changes in the row of rebounds that a tolerance t leaves out: those slower than a fall from t R, each e times as fast
// as the one before, of an edge that is pulled to the wall by a tenth of gravity.
double change_in_row(const RandomCase& c, double restitution, double tolerance) {
  double steepest = 0;
  const auto& record = c.motion->table->acceleration;
  for (std::size_t i = 1; i < record.size(); ++i)
    steepest = std::max(steepest, std::abs(record[i] - record[i - 1]) / c.motion->table->step_s);
  const double slow = std::sqrt(2 * standard_gravity_mps2 * tolerance * c.specimen.block.size_m());
  const double pull = 0.1 * standard_gravity_mps2;
  return steepest * 2 * slow / pull / (1 - restitution);
}

void expect_the_same_peaks(const Solver& solver, std::uint64_t cases) {
  std::uint64_t compared = 0, hits = 0;
  for (std::uint64_t number = 0; number < cases; ++number) {
    const double gap_m = 0.01 * static_cast<double>(1 + number % 3), e = 0.1 + 0.2 * static_cast<double>(number % 5);
    const RandomCase c = beside_a_wall(number, gap_m, e);
    Settings settings;
    settings.free_vibration_s = 3;
    settings.acceleration_height_m = 0;
    settings.contact_forces = true;
    settings.tolerance = 1e-12;
    const Response exact = solver(c.specimen, c.shaking, settings, nullptr);
    settings.tolerance = 1e-9;
    const Response r = solver(c.specimen, c.shaking, settings, nullptr);
    if (std::abs(r.residual_slip_m - exact.residual_slip_m) > 1e-6 || r.outcome != exact.outcome) continue;
    ++compared;
    hits += exact.wall_hits > 0;
    const double allowed = 1e-6 * exact.peak_acceleration_mps2 + change_in_row(c, e, settings.tolerance);
    EXPECT_NEAR(r.peak_acceleration_mps2, exact.peak_acceleration_mps2, allowed) << number << ' ' << c.text();
    EXPECT_NEAR(r.peak_acceleration_at_height_mps2, exact.peak_acceleration_at_height_mps2,
                2 * allowed + 1e-6 * exact.peak_acceleration_at_height_mps2)
        << number << ' ' << c.text();
    EXPECT_NEAR(r.peak_contact_vertical_mps2, exact.peak_contact_vertical_mps2, 2 * allowed)
        << number << ' ' << c.text();
  }
  EXPECT_GE(compared, cases * 97 / 100);
  EXPECT_GT(hits, cases / 3);
}

TEST(WallRebounds, AreFeltAlikeAtAnyTolerance) { expect_the_same_peaks(fast_solver, 1500); }
TEST(WallRebounds, AreFeltAlikeByTheReference) { expect_the_same_peaks(reference_solver, 60); }

}  // namespace
}  // namespace freestand::test
