#include "measurement/timing.hpp"

#include <algorithm>
#include <cmath>

#include "measurement/ground.hpp"
#include "measurement/slips.hpp"

namespace freestand::measurement {
namespace {

constexpr double timing_half_window_s = 0.04;

struct Variance {
  double n = 0, sum = 0, square = 0;
  void add(double y) { n += 1, sum += y, square += y * y; }
  double total() const { return n > 0 ? square - sum * sum / n : 0; }
};

}  // namespace

bool Timing::judged() const { return samples >= 1.5; }

// On measurements in order the gain stays under 3, with two independent samples; wrong signs and clocks make 9 to 400.
bool Timing::wrong() const { return (mirrored || std::abs(late_steps) > 1) && judged() && gain > 4; }

Timing slip_timing(const Bench& bench, std::size_t i, int most_steps, bool sign_is_known) {
  const Test& test = bench.test(i);
  if (test.slip_m.empty() || test.dt_s <= 0) return {};
  const std::size_t half = half_window_samples(timing_half_window_s, test.dt_s);
  const Smooth block = smooth(test.slip_m, test.dt_s, timing_half_window_s);
  const std::vector<double> floor = smooth(floor_displacement(test), test.dt_s, timing_half_window_s).second;
  const double least = 5 * bench.noise(Channel::slip) * rate_noise(test.dt_s, timing_half_window_s);
  const auto found = slips(test, block, least, bench.noise(Channel::rotation));
  const auto n = static_cast<int>(floor.size());

  Timing best;
  double least_variance = 0, as_measured = 0;
  std::vector<double> variances[2];  // at each lag, as measured and mirrored
  for (const bool mirrored : {false, true})
    for (int late = -most_steps; late <= most_steps; ++late) {
      if (mirrored && sign_is_known) continue;
      Variance either_way[2];
      for (const Slip& slip : found)
        for (std::size_t k = slip.from + half; k + half < slip.to; ++k) {
          const int at = static_cast<int>(k) - late;
          if (static_cast<int>(k) < most_steps || static_cast<int>(k) + most_steps >= n) continue;
          const double sum = (mirrored ? -1 : 1) * block.second[k] + floor[static_cast<std::size_t>(at)];
          either_way[slip.sigma > 0].add(sum);
        }
      const double variance = either_way[0].total() + either_way[1].total();
      const double count = either_way[0].n + either_way[1].n;
      variances[mirrored].push_back(variance);
      if (!mirrored && late == 0) as_measured = variance;
      if (best.samples == 0 || variance < least_variance) {
        least_variance = variance;
        best = {mirrored, late, static_cast<double>(late), 1, count / static_cast<double>(2 * half + 1)};
      }
    }
  const auto& curve = variances[best.mirrored];
  const auto place = static_cast<std::size_t>(best.late_steps + most_steps);
  if (place > 0 && place + 1 < curve.size()) {
    const double before = curve[place - 1], after = curve[place + 1], bend = before - 2 * curve[place] + after;
    if (bend > 0) best.late += 0.5 * (before - after) / bend;
  }
  best.gain = least_variance > 0 ? as_measured / least_variance : 1;
  return best;
}

}  // namespace freestand::measurement
