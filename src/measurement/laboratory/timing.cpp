#include "measurement/laboratory/timing.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "measurement/data/ground.hpp"
#include "measurement/data/slips.hpp"
#include "measurement/laboratory/units.hpp"

namespace freestand::measurement {
namespace {

constexpr double timing_half_window_s = 0.04;

struct Variance {
  double n = 0, sum = 0, square = 0;
  void add(double y) { n += 1, sum += y, square += y * y; }
  double total() const { return n > 0 ? square - sum * sum / n : 0; }
};

constexpr double enough_samples = 1.5, beyond_chance = 4;

std::vector<double> floor_of(const Test& test) {
  return smooth(floor_displacement(test), test.dt_s, timing_half_window_s).second;
}

// The slips of a test, away from their ends.
class Slipping {
 public:
  // edge: samples at both ends of the history that are left out.
  Slipping(const Bench& bench, const Test& test, int edge)
      : half_(half_window_samples(timing_half_window_s, test.dt_s)),
        block_(smooth(test.slip_m, test.dt_s, timing_half_window_s)) {
    const double least = 5 * bench.noise(Channel::slip) * rate_noise(test.dt_s, timing_half_window_s);
    for (const Slip& slip : slips(test, block_, least, bench.noise(Channel::rotation)))
      for (std::size_t k = slip.from + half_; k + half_ < slip.to; ++k)
        if (static_cast<int>(k) >= edge && static_cast<int>(k) + edge < static_cast<int>(block_.second.size()))
          (slip.sigma > 0 ? there_ : back_).push_back(k);
  }

  double window() const { return static_cast<double>(2 * half_ + 1); }
  double samples() const { return static_cast<double>(there_.size() + back_.size()) / window(); }
  std::size_t last() const { return std::max(there_.empty() ? 0 : there_.back(), back_.empty() ? 0 : back_.back()); }

  // Of sign u'' + a about its mean of each direction, a read `late` steps before.
  double variance(const std::vector<double>& floor, int late = 0, double sign = 1) const {
    double sum = 0;
    for (const auto* way : {&there_, &back_}) {
      Variance of_way;
      for (const std::size_t k : *way)
        of_way.add(sign * block_.second[k] + floor[static_cast<std::size_t>(static_cast<int>(k) - late)]);
      sum += of_way.total();
    }
    return sum;
  }

  // Least squares of the floor's acceleration on that of the slip, each about its mean of each direction. noise: of u'', and of the
  // floor [m/s2].
  SlipScale scale(const std::vector<double>& floor, double noise, double floor_noise) const {
    double uu = 0, ua = 0, aa = 0, n = 0;
    for (const auto* way : {&there_, &back_}) {
      Variance u, a, sum;
      for (const std::size_t k : *way) u.add(block_.second[k]), a.add(floor[k]), sum.add(block_.second[k] + floor[k]);
      uu += u.total();
      aa += a.total();
      ua += 0.5 * (sum.total() - u.total() - a.total());
      n += u.n;
    }
    const double free_of_noise = uu - n * noise * noise, factor = free_of_noise > 0 ? -ua / free_of_noise : 1;
    const double own = variance(floor), scaled = own + 2 * (factor - 1) * ua + (factor * factor - 1) * uu;
    const bool shaken = aa > beyond_chance * n * floor_noise * floor_noise;
    return {factor, scaled > 0 ? std::min(own, aa) / scaled : 1, shaken && samples() >= enough_samples};
  }

 private:
  std::size_t half_;
  Smooth block_;
  std::vector<std::size_t> there_, back_;
};

}  // namespace

bool Timing::judged() const { return samples >= enough_samples; }

// On measurements in order the gain stays under 3, with two independent samples; wrong signs and clocks make 9 to 400.
bool Timing::wrong() const { return (mirrored || std::abs(late_steps) > 1) && judged() && gain > beyond_chance; }

bool Timing::known() const { return next > beyond_chance; }

bool OtherFloor::likelier() const { return judged && gain > beyond_chance; }

bool SlipScale::is_a_unit() const { return judged && gain > beyond_chance && is_ratio_of_units(factor); }

SlipScale slip_scale(const Bench& bench, std::size_t i) {
  const Test& test = bench.test(i);
  if (test.slip_m.empty() || test.dt_s <= 0) return {};
  const double noise = bench.noise(Channel::slip) * bench.sensor(Channel::slip).size();
  return Slipping(bench, test, 0)
      .scale(floor_of(test), noise * second_noise(test.dt_s, timing_half_window_s), bench.floor_noise_mps2(i));
}

Timing slip_timing(const Bench& bench, std::size_t i, int most_steps, bool sign_is_known) {
  const Test& test = bench.test(i);
  if (test.slip_m.empty() || test.dt_s <= 0) return {};
  const Slipping slipping(bench, test, most_steps);
  const std::vector<double> floor = floor_of(test);
  Timing best;
  double least_variance = 0;
  std::vector<double> variances[2];  // at each lag, as measured and mirrored
  for (const bool mirrored : {false, true})
    for (int late = -most_steps; late <= most_steps; ++late) {
      if (mirrored && sign_is_known) continue;
      variances[mirrored].push_back(slipping.variance(floor, late, mirrored ? -1 : 1));
      if (best.samples == 0 || variances[mirrored].back() < least_variance) {
        least_variance = variances[mirrored].back();
        best = {mirrored, late, static_cast<double>(late), 1, 1, slipping.samples()};
      }
    }
  const auto& curve = variances[best.mirrored];
  const auto place = static_cast<std::size_t>(best.late_steps + most_steps);
  const bool inside = place > 0 && place + 1 < curve.size();
  if (inside) {
    const double before = curve[place - 1], after = curve[place + 1], bend = before - 2 * curve[place] + after;
    if (bend > 0) best.late += 0.5 * (before - after) / bend;
  }
  const std::size_t apart = 2 * (2 * half_window_samples(timing_half_window_s, test.dt_s) + 1);
  double next = inside ? std::numeric_limits<double>::infinity() : 0;
  for (std::size_t k = 0; k < curve.size(); ++k)
    if (std::max(k, place) - std::min(k, place) > apart) next = std::min(next, curve[k]);
  best.next = least_variance > 0 ? next / least_variance : 1;
  best.gain = least_variance > 0 ? variances[0][static_cast<std::size_t>(most_steps)] / least_variance : 1;
  const double tries = static_cast<double>(variances[0].size() + variances[1].size()) / slipping.window();
  if (best.samples > 0) best.p = std::min(1.0, tries * gsl_cdf_fdist_Q(best.gain, best.samples, best.samples));
  return best;
}

std::vector<OtherFloor> floors_of_others(const Bench& bench) {
  std::vector<std::vector<double>> floors;  // empty where no slip was measured
  for (std::size_t i = 0; i < bench.size(); ++i)
    floors.push_back(bench.test(i).dt_s > 0 ? floor_of(bench.test(i)) : std::vector<double>{});
  std::vector<OtherFloor> found(bench.size());
  for (std::size_t i = 0; i < bench.size(); ++i) {
    const Test& test = bench.test(i);
    if (floors[i].empty()) continue;
    const Slipping slipping(bench, test, 0);
    if (slipping.samples() < enough_samples) continue;
    const double own = slipping.variance(floors[i]);
    for (std::size_t j = 0; j < bench.size(); ++j) {
      if (j == i || bench.test(j).dt_s != test.dt_s || floors[j].size() <= slipping.last()) continue;
      const double variance = slipping.variance(floors[j]), gain = variance > 0 ? own / variance : 1;
      if (gain > found[i].gain || !found[i].judged) found[i] = {j, gain, true};
    }
  }
  return found;
}

}  // namespace freestand::measurement
