// Measured drops of a 60 mm square on a floor (100 trajectories at 250 Hz): what the angle means, and the kernel's flight.
// Nothing is taken from the smoothed velocities of the files. Intervals: 95 %, drops drawn again.
#include "support/square_drops.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "dynamics/contact.hpp"
#include "support/medians.hpp"
#include "validation/measured_drops.hpp"

namespace freestand::test::square_drops_test {
namespace {

constexpr double g = 9.80665, h = drop_half_side_m, k2 = drop_gyration2_m2;

// How far the impulse must pass from the lowest corner so that it gives the measured turn, per normal impulse [m].
double missed_lever(const Blow& blow, double sense) {
  const Lever r = lever(sense * blow.place[2]);
  const double px = blow.after[0] - blow.before[0], py = blow.after[1] - blow.before[1];
  return std::abs(k2 * sense * (blow.after[2] - blow.before[2]) - (r.x * py - r.y * px)) / py;
}

// The impulse acts at the corner that is down, so it cannot pass far from it. Which corner that is, and where, follows
// from the sense of th; heights do not tell, the square being the same in a mirror.
TEST(SquareDrops, TheAngleIsCounterClockwise) {
  FREESTAND_NEEDS_DROPS();
  std::vector<double> as_read, mirrored, difference, inertia;
  std::vector<int> drop, turned;
  for (const Blow& blow : blows()) {
    as_read.push_back(missed_lever(blow, 1));
    mirrored.push_back(missed_lever(blow, -1));
    difference.push_back(mirrored.back() - as_read.back());
    drop.push_back(blow.drop);
    const Lever r = lever(blow.place[2]);
    const double turn = blow.after[2] - blow.before[2], py = blow.after[1] - blow.before[1];
    if (std::abs(k2 * turn) < 0.005 * py) continue;  // too little turn to tell the inertia from
    inertia.push_back((r.x * py - r.y * (blow.after[0] - blow.before[0])) / (k2 * turn));
    turned.push_back(blow.drop);
  }
  const auto nearer = std::count_if(difference.begin(), difference.end(), [](double d) { return d > 0; });
  const Interval gain = interval_of_median(difference, drop), i95 = interval_of_median(inertia, turned);
  std::printf("th on a face %.4f rad (scatter %.4f)\n", drops().resting.th_rad, drops().resting.scatter_rad);
  std::printf(
      "%zu blows: impulse misses the corner by %.1f mm with th counter-clockwise, %.1f mm clockwise; difference "
      "%.1f mm (95 %%: %.1f..%.1f); counter-clockwise nearer in %td\n",
      as_read.size(), 1e3 * median(as_read), 1e3 * median(mirrored), 1e3 * median(difference), 1e3 * gain.low,
      1e3 * gain.high, nearer);
  std::printf("k^2 that the blows show, over side^2/6: %.3f (95 %%: %.3f..%.3f, n = %zu)\n", median(inertia), i95.low,
              i95.high, inertia.size());
  EXPECT_NEAR(drops().resting.th_rad, -0.033, 3 * drops().resting.scatter_rad);
  EXPECT_GE(as_read.size(), 80U);
  EXPECT_GT(gain.low, 0);
  EXPECT_GT(nearer, 3 * static_cast<std::ptrdiff_t>(difference.size()) / 4);
  EXPECT_LT(2 * median(as_read), median(mirrored));
}

// Frames of an arc against the kernel's flight from the arc's middle.
Triple misses(const Drop& drop, const Arc& arc, int frame) {
  using namespace dynamics;
  Flight<double, 3> flight{};
  Floor<double, 3> floor{Series<double, 3>::zero(), Series<double, 3>::zero()};
  floor.g[0] = g;
  flight.x[0] = arc.place[0];
  flight.y[0] = arc.place[1];
  flight.theta[0] = arc.place[2];
  flight.vx[0] = arc.rate[0];
  flight.vy[0] = arc.rate[1];
  flight.omega[0] = arc.rate[2];
  fly(flight, floor, h, h, h);
  const double t = (frame - arc.at_frame) * drop_step_s;
  const Triple& pose = drop[static_cast<std::size_t>(frame)];
  return {pose[0] - flight.x.at(t), pose[1] - flight.y.at(t), pose[2] - flight.theta.at(t)};
}

struct Departure {
  Triple scatter;  // about the flight, its parameters counted
  Triple bend;     // acceleration beyond that of the flight
};
Departure departure(const Drop& drop, const Arc& arc) {
  Departure all{};
  const int n = arc.last - arc.first;
  double mean = 0, spread = 0;
  const auto square = [&](int i) { return std::pow((i - arc.at_frame) * drop_step_s, 2); };
  for (int i = arc.first; i < arc.last; ++i) mean += square(i) / n;
  for (int i = arc.first; i < arc.last; ++i) {
    const double u = square(i) - mean;
    const Triple miss = misses(drop, arc, i);
    spread += u * u;
    for (std::size_t k = 0; k < 3; ++k) {
      all.scatter[k] += miss[k] * miss[k] / (n - 2);
      all.bend[k] += 2 * u * miss[k];
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    all.scatter[k] = std::sqrt(all.scatter[k]);
    all.bend[k] /= spread;
  }
  return all;
}

// Noise of the frames without any law of motion: third differences, which no parabola has.
Triple third_differences(const Drop& drop, int first, int last) {
  Triple noise{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto at = [&](int i) { return drop[static_cast<std::size_t>(i)][k]; };
    for (int i = first; i + 3 < last; ++i)
      noise[k] += std::pow(at(i + 3) - 3 * at(i + 2) + 3 * at(i + 1) - at(i), 2) / (20 * (last - first - 3));
    noise[k] = std::sqrt(noise[k]);
  }
  return noise;
}

TEST(SquareDrops, FlightIsBallistic) {
  FREESTAND_NEEDS_DROPS();
  constexpr int window = 12, whole_flight = 30;
  std::array<std::vector<double>, 3> scatter, noise, whole, bend;
  std::vector<int> of_drop;
  for (std::size_t d = 0; d < drops().drops.size(); ++d) {
    const Drop& drop = drops().drops[d];
    for (const auto& [first, last] : free_flights(drop)) {
      for (int start = first; start + window <= last; start += window) {
        const Arc arc = fit_arc(drop, start, start + window, start + 0.5 * (window - 1));
        const Triple about = departure(drop, arc).scatter, white = third_differences(drop, start, start + window);
        for (std::size_t k = 0; k < 3; ++k) {
          scatter[k].push_back(about[k]);
          noise[k].push_back(white[k]);
        }
      }
      if (last - first < whole_flight) continue;
      const Arc arc = fit_arc(drop, first, last, 0.5 * (first + last - 1));
      const Departure from = departure(drop, arc);
      for (std::size_t k = 0; k < 3; ++k) {
        whole[k].push_back(from.scatter[k]);
        bend[k].push_back(from.bend[k] / (k == 2 ? arc.rate[2] : 1));
      }
      of_drop.push_back(static_cast<int>(d));
    }
  }
  const char* names[] = {"x [m]", "y [m]", "theta [rad]"};
  Interval beyond[3];
  for (std::size_t k = 0; k < 3; ++k) {
    beyond[k] = interval_of_median(bend[k], of_drop);
    std::printf(
        "%-11s %zu windows of 12 frames: scatter about the flight %.1e, noise by third differences %.1e; %zu "
        "flights of 30 frames and more: %.1e, acceleration beyond the flight's %.3f (95 %%: %.3f..%.3f)\n",
        names[k], scatter[k].size(), median(scatter[k]), median(noise[k]), whole[k].size(), median(whole[k]),
        median(bend[k]), beyond[k].low, beyond[k].high);
    EXPECT_LT(median(scatter[k]), 2 * median(noise[k])) << names[k];
  }
  EXPECT_GE(scatter[0].size(), 400U);
  // Gravity: its own interval holds zero, and is narrow enough that 1 % would show.
  EXPECT_LT(beyond[1].low, 0);
  EXPECT_GT(beyond[1].high, 0);
  EXPECT_LT(beyond[1].high - beyond[1].low, 0.01 * g);
}

}  // namespace
}  // namespace freestand::test::square_drops_test
