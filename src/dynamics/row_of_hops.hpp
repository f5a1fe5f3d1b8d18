// What becomes of a slip in the endless row of ever smaller hops with which a block comes to stand on both corners.
#pragma once

#include <cmath>

namespace freestand::dynamics {

// Accelerations of a block that slips on a corner, at the start of a hop [rad/s2], [m/s2].
struct HopStart {
  double alpha, slip;
};

// Whether a slip w outlasts the row that starts on `pivot` with `rate`; one that does not ends within the row, and nothing slides
// on both corners after it. In the limit of small hops the accelerations are those at their start, and every two hops with their
// blows are the two before, times the share of the rate that these have kept: the slips after each are geometric series, which
// stay on one side of zero if those of the first two hops do and their limit does.
//
// start(pivot, w) -> HopStart;  blow(pivot, rate, w): the corner opposite to `pivot` strikes; rate and w after it, false: no hop follows.
template <class Start, class Blow>
bool outlasts_hops(int pivot, const double rate, const double w, Start&& start, Blow&& blow) {
  double now = rate, slip = w;
  const auto goes_on = [&] { return w > 0 ? slip > 0 : slip < 0; };
  for (int hop = 0; hop < 2; ++hop) {
    const HopStart at = start(pivot, slip);
    if (!(at.alpha * now < 0)) return true;  // it does not come down
    slip -= 2 * now / at.alpha * at.slip;
    if (!goes_on()) return false;
    now = -now;
    const bool hops = blow(pivot, now, slip);
    if (!goes_on()) return false;
    if (!hops) return true;
    pivot = -pivot;
  }
  if (!(now / rate < 1)) return true;
  slip = w + (slip - w) / (1 - now / rate);
  return goes_on();
}

// A hop that starts with `rate` and is over after `time` turns the block by rate time/4. What ends as a row of hops is smaller than a
// tolerance under the pull of the weight alone, which slipping may take to a quarter. Where the floor's push takes nearly all of it, the
// hop is no small one, and the floor decides what becomes of it.
inline bool is_small_hop(double rate, double time, double rest_rotation) {
  return std::abs(rate) * time <= 16 * rest_rotation;
}

// A row of hops as a corner is about to strike.
struct HopRow {
  double rate, slip;
  double lasts = 0;    // until now [s]
  bool stops = false;  // the slip was zero since this was last cleared
};

// Along a row in which the slip stops, and maybe goes on; the slip with which it leaves the row, which is zero where it ends with the
// row or goes on stopping in every two hops. What two hops without a stop do, so many more do as a geometric series.
//
// two_hops(row): goes through a blow, a hop, a blow and a hop; false: the row ends there.
template <class TwoHops>
double slip_after_stops(HopRow& row, TwoHops&& two_hops) {
  constexpr int pairs = 64;
  constexpr double alike = 1e-9;
  for (int i = 0; i < pairs; ++i) {
    const HopRow before = row;
    row.stops = false;
    if (!two_hops(row)) return 0;
    const double kept = row.rate / before.rate, gained = row.slip - before.slip;
    if (!(kept > 0 && kept < 1)) return 0;
    if (row.stops || row.slip * before.slip <= 0) {
      if (std::abs(row.slip - kept * before.slip) <= alike * std::abs(row.slip)) return 0;
      continue;
    }
    const double all = 1 / (1 - kept), limit = before.slip + gained * all, lasts = row.lasts - before.lasts;
    const bool outlasts = limit * before.slip > 0;
    // Up to the two hops in which it stops.
    const double left =
        outlasts ? 0 : std::pow(kept, std::floor(std::log(limit / (limit - before.slip)) / std::log(kept)));
    if (outlasts || left < kept) {
      row.rate = left * before.rate;
      row.slip = limit + (before.slip - limit) * left;
      row.lasts = before.lasts + lasts * all * (1 - left);
    }
    if (outlasts) return row.slip;
  }
  return 0;
}

}  // namespace freestand::dynamics
