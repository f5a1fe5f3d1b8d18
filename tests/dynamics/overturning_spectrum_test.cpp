// Overturning of a block p = 1.25 rad/s, alpha = 0.16 under one-sine pulses ([KM05 Fig. 6.5]): the safe cape above the
// lowest overturning curve, and every cell of the spectrum against an integration of its own (tests/support/rocking).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "base/units.hpp"
#include "support/floor_motions.hpp"
#include "support/rocking.hpp"
#include "support/solvers.hpp"

namespace freestand::test::overturning_spectrum_test {
namespace {

constexpr double g = standard_gravity_mps2, p = 1.25, alpha = 0.16;

Specimen spectrum_block() {
  const double R = 0.75 * g / (p * p);
  Specimen specimen;
  specimen.block = Block::rectangular(2 * R * std::sin(alpha), 2 * R * std::cos(alpha), 1000);
  specimen.friction = {1, 1};
  specimen.model = Model::rock;
  return specimen;
}

struct Cell {
  bool overturned, near_edge;
};

// amplitude: a/(g tan alpha); frequency: omega/p.
RockingRun own(double amplitude, double frequency) {
  return rock_under_one_sine({p, alpha}, amplitude * std::tan(alpha), frequency * p, 1000);
}

Cell own_cell(double amplitude, double frequency) {
  const bool here = own(amplitude, frequency).overturned;
  bool near_edge = false;
  for (const double factor : {0.998, 1.002})
    near_edge = near_edge || own(factor * amplitude, frequency).overturned != here ||
                own(amplitude, factor * frequency).overturned != here;
  return {here, near_edge};
}

Response answer(const Solver& solver, const FloorMotion& sine, double amplitude, double frequency) {
  return solver(spectrum_block(), {&sine, amplitude * std::tan(alpha) * g, 2 * pi / (frequency * p), 0});
}

// Amplitudes at which the outcome changes, on a fine grid, from the bottom up.
std::vector<double> edges(double frequency, const std::function<bool(double)>& overturns) {
  std::vector<double> found;
  bool before = false;
  for (double amplitude = 1.05; amplitude < 25; amplitude += 0.05) {
    const bool now = overturns(amplitude);
    if (now != before) {
      double low = amplitude - 0.05, high = amplitude;
      for (int i = 0; i < 25; ++i) {
        const double middle = 0.5 * (low + high);
        (overturns(middle) == before ? low : high) = middle;
      }
      found.push_back(0.5 * (low + high));
    }
    before = now;
  }
  (void)frequency;
  return found;
}

TEST(OverturningSpectrum, HasASafeCapeAboveTheLowestCurve) {
  const FloorMotion sine = one_sine();
  for (const double frequency : {6.5, 7.0, 7.5, 8.0}) {
    const std::vector<double> expected = edges(frequency, [&](double a) { return own(a, frequency).overturned; });
    const std::vector<double> found = edges(
        frequency, [&](double a) { return answer(fast_solver, sine, a, frequency).outcome == Outcome::overturned; });
    // Stands, overturns after an impact, stands again (the cape), overturns without impact.
    ASSERT_EQ(expected.size(), 3u) << frequency;
    ASSERT_EQ(found.size(), 3u) << frequency;
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], 1e-5 * expected[i]) << frequency;
    EXPECT_GT(expected[2] / expected[1], 1.02);
    EXPECT_EQ(answer(fast_solver, sine, 1.01 * expected[0], frequency).impacts, 1);
    EXPECT_EQ(answer(fast_solver, sine, 1.01 * expected[2], frequency).impacts, 0);
    std::printf("omega/p %.1f: overturns at a/(g tan alpha) = %.4f to %.4f and above %.4f\n", frequency, found[0],
                found[1], found[2]);
  }
}

TEST(OverturningSpectrum, CellByCell) {
  const FloorMotion sine = one_sine();
  int cells = 0, skipped = 0, overturned = 0, reference_cells = 0;
  for (double frequency = 1; frequency < 10; frequency += 0.4) {
    for (double amplitude = 1.1; amplitude < 20; amplitude += 0.6) {
      const Cell cell = own_cell(amplitude, frequency);
      if (cell.near_edge) {
        ++skipped;
        continue;
      }
      const Outcome expected = cell.overturned ? Outcome::overturned : Outcome::moved;
      const Response fast = answer(fast_solver, sine, amplitude, frequency);
      ASSERT_EQ(fast.outcome, expected) << "omega/p " << frequency << " a/(g tan alpha) " << amplitude;
      if (!cell.overturned) {
        ASSERT_NEAR(fast.peak_rotation_rad, own(amplitude, frequency).peak_rotation_rad, 1e-5 * alpha)
            << frequency << ' ' << amplitude;
      }
      if (++cells % 9 == 0) {
        ASSERT_EQ(answer(reference_solver, sine, amplitude, frequency).outcome, expected);
        ++reference_cells;
      }
      overturned += cell.overturned ? 1 : 0;
    }
  }
  EXPECT_GT(cells, 600);
  EXPECT_GT(overturned, 200);
  EXPECT_LT(skipped, cells / 20);
  std::printf("%d cells (%d overturned, %d on the reference too), %d at the edge left out\n", cells, overturned,
              reference_cells, skipped);
}

}  // namespace
}  // namespace freestand::test::overturning_spectrum_test
