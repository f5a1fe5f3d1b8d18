#include "measurement/noise/quiet.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "measurement/data/ground.hpp"
#include "measurement/data/slips.hpp"
#include "measurement/data/smooth.hpp"
#include "measurement/noise/third_differences.hpp"

namespace freestand::measurement {
namespace {

constexpr double half_window_s = 0.04, shortest_s = 0.3;
constexpr double still = 5;  // in what noise makes
// Times that: noise that is stated at less than a third is refused elsewhere (plausible.hpp).
constexpr double surely = 3;
constexpr double below = 0.7;  // of what holds the block

// Marks where this displacement moves, with half a window to either side. Noise that is stated too small would be motion:
// what the third differences show of it counts where it is more.
void mark_motion(const std::vector<double>& samples, double stated, double dt_s, double times,
                 std::vector<bool>& moves) {
  if (samples.empty() || stated <= 0) return;
  const double noise = times * std::clamp(sensor_noise(samples), stated, surely * stated);
  const Smooth motion = smooth(samples, dt_s, half_window_s);
  const double least = still * noise * rate_noise(dt_s, half_window_s);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (std::abs(motion.firm_rate(i)) < least) continue;
    const std::size_t from = i < motion.half ? 0 : i - motion.half, to = std::min(samples.size(), i + motion.half + 1);
    for (std::size_t k = from; k < to; ++k) moves[k] = true;
  }
}

std::vector<bool> motion_of(const Dataset& data, const Test& test, double times = 1) {
  std::vector<bool> moves(std::max(test.slip_m.size(), test.rotation_rad.size()), false);
  mark_motion(test.slip_m, data.noise.slip_m, test.dt_s, times, moves);
  mark_motion(test.rotation_rad, data.noise.rotation_rad, test.dt_s, times, moves);
  return moves;
}

// The least floor, over the tests, that had been reached when something was first seen to move beyond doubt.
double floor_that_moves(const Dataset& data, double times) {
  double least = std::numeric_limits<double>::infinity();
  for (const Test& test : data.tests) {
    if (test.role == Role::holdout || !test.has_history() || !test.start.upright_at_rest()) continue;
    const std::vector<bool> moves = motion_of(data, test, times);
    double reached = 0;
    std::size_t i = 0;
    for (; i < moves.size() && !moves[i]; ++i) reached = std::max(reached, std::abs(floor_acceleration_mps2(test, i)));
    // A window that saw the motion ends two halves later: by then it had begun.
    const std::size_t end = std::min(moves.size(), i + 2 * half_window_samples(half_window_s, test.dt_s));
    for (std::size_t k = i; k < end; ++k) reached = std::max(reached, std::abs(floor_acceleration_mps2(test, k)));
    if (i < moves.size() && reached > 0) least = std::min(least, reached);
  }
  return least;
}

// What carries the block while it slips, its own acceleration [m/s2]: the median over the middles of its slips. The contact lets go at no
// less than that. Infinite where no slip is long enough.
double acceleration_in_slips(const Dataset& data) {
  std::vector<double> carried;
  for (const Test& test : data.tests) {
    if (test.role == Role::holdout || test.slip_m.empty() || data.noise.slip_m <= 0) continue;
    const Smooth motion = smooth(test.slip_m, test.dt_s, half_window_s);
    std::vector<double> own = floor_displacement(test);
    for (std::size_t i = 0; i < own.size(); ++i) own[i] += test.slip_m[i];
    const std::vector<double> acceleration = smooth(own, test.dt_s, half_window_s).second;
    const double noise = surely * std::clamp(sensor_noise(test.slip_m), data.noise.slip_m, surely * data.noise.slip_m);
    for (const Slip& slip :
         slips(test, motion, still * noise * rate_noise(test.dt_s, half_window_s), data.noise.rotation_rad))
      for (std::size_t i = slip.from + motion.half; i + motion.half < slip.to; ++i)
        carried.push_back(-slip.sigma * acceleration[i]);
  }
  if (carried.empty()) return std::numeric_limits<double>::infinity();
  const auto middle = carried.begin() + static_cast<long>(carried.size() / 2);
  std::nth_element(carried.begin(), middle, carried.end());
  return std::max(0.0, *middle);
}

}  // namespace

double floor_without_slip_mps2(const Dataset& data) {
  const double beyond_doubt = std::min(floor_that_moves(data, surely), acceleration_in_slips(data));
  // Where nothing moves beyond doubt, small slips may still hide in noise: what is seen of motion at all is taken for it.
  return below * (std::isfinite(beyond_doubt) ? beyond_doubt : floor_that_moves(data, 1));
}

std::vector<QuietStretch> quiet_stretches(const Dataset& data, Channel channel) {
  std::vector<QuietStretch> found;
  const double stated = measurement::noise(data.noise, channel);
  if (stated <= 0) return found;
  const double holds = floor_without_slip_mps2(data);
  const bool carried = channel == Channel::block_acceleration;
  for (std::size_t t = 0; t < data.tests.size(); ++t) {
    const Test& test = data.tests[t];
    const std::vector<double>& samples = history(test, channel);
    if (samples.empty() || test.role == Role::holdout || test.dt_s <= 0) continue;
    std::vector<bool> moves = motion_of(data, test);
    moves.resize(samples.size(), false);
    const double of_floor = floor_noise_mps2(data, test), loud = carried ? std::min(holds, still * of_floor) : holds,
                 noise = carried ? std::hypot(stated, of_floor) : stated;
    if (!test.start.upright_at_rest())  // on its way from the first sample on, also where it turns round
      std::fill(moves.begin(), std::find(moves.rbegin(), moves.rend(), true).base(), true);
    const std::size_t half = half_window_samples(half_window_s, test.dt_s);
    for (std::size_t i = 0; i < samples.size(); ++i)
      if (std::abs(floor_acceleration_mps2(test, i)) > loud)
        std::fill(moves.begin() + static_cast<long>(i < half ? 0 : i - half),
                  moves.begin() + static_cast<long>(std::min(samples.size(), i + half + 1)), true);
    for (std::size_t from = 0; from < samples.size();) {
      std::size_t to = from;
      while (to < samples.size() && !moves[to]) ++to;
      if (static_cast<double>(to - from) * test.dt_s >= shortest_s) {
        found.push_back({t, test.dt_s, {}});
        for (std::size_t i = from; i < to; ++i)
          found.back().samples.push_back((samples[i] - (carried ? floor_acceleration_mps2(test, i) : 0)) / noise);
      }
      from = to + 1;
    }
  }
  return found;
}

}  // namespace freestand::measurement
