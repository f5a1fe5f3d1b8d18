// What becomes of a slip in the endless row of ever smaller hops with which a block comes to stand on both corners.
#pragma once

#include <cmath>
#include <limits>

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

// Whether a row of hops, whose first one starts with `rate` and turns the block by `rotation` under its weight alone, is over:
// too small to tell by the tolerance of rotations, and certain to end before the floor could lift the block. Its rates may be the
// root of that tolerance, and a floor that tips the block while the row lasts makes a motion of them; only rates as small as the tolerance
// are nothing by themselves.
//
// Each hop ends with the rate with which it started, turned round: the accelerations back to the floor give 2 rate to it, and to
// all of the row 2 rate/(1 - kept), kept: of the rate, over an impact, at most. given(): what they give for sure, given_ahead of the corner
// that gives less.
template <class Given>
bool row_is_over(double rotation, double tolerance, double rate, double kept, Given&& given) {
  if (rotation < tolerance * tolerance) return true;
  return rotation < tolerance && 2 * std::abs(rate) <= (1 - kept) * given();
}

// What an acceleration back to the floor that changes evenly gives within `time`, and before it is half of what it is now [rad/s].
inline double given_ahead(double pull, double change, double time) {
  if (!(pull > 0)) return 0;
  if (!(change < 0)) return pull * time;
  const double until = std::fmin(time, pull / (-2 * change));
  return (pull + 0.5 * change * until) * until;
}

// A row of hops as a corner is about to strike.
struct HopRow {
  double rate, slip;
  bool felt = true;    // its accelerations count
  double lasts = 0;    // until now [s]
  bool stops = false;  // the slip was zero since this was last cleared
  double slid = 0;     // until now [m]
};

// A row that started with `rate`, as its first two hops tell [s].
inline double lasts_in_all(double rate, const HopRow& after_two) {
  return after_two.lasts / (1 - after_two.rate / rate);
}

// The same of a row without slip that starts with `rate` on one corner: pulls back to the floor [rad/s2], on it and on the other one, and
// what of the rate is kept where the stay on each ends.
inline double lasts_in_all(double rate, double pull, double kept, double other_pull, double other_kept) {
  return 2 * rate * (1 / pull + kept / other_pull) / (1 - kept * other_kept);
}

// The same where the floor's acceleration changes evenly, for `left` seconds. On a steady floor a row loses the same part of its first rate
// in every second, `now` being how long it lasts on the floor as it is and lasts(time) on the floor as it is then; here that part changes
// evenly. Infinite: it comes to no end.
template <class Lasts>
double lasts_on_changing_floor(double now, double left, Lasts&& lasts) {
  const double later = std::fmin(now, 0.5 * left);
  const double square = 1 / (now * now) + 2 * (1 / lasts(later) - 1 / now) / later;
  return square >= 0 ? 2 / (1 / now + std::sqrt(square)) : std::numeric_limits<double>::infinity();
}

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
    const double kept = row.rate / before.rate, gained = row.slip - before.slip, lasts = row.lasts - before.lasts;
    if (!(kept > 0 && kept < 1)) return 0;
    const double all = 1 / (1 - kept), limit = before.slip + gained * all;
    if (row.stops || row.slip * before.slip <= 0) {
      if (std::abs(row.slip - kept * before.slip) > alike * std::abs(row.slip)) continue;
      row.lasts = before.lasts + lasts * all;
      return 0;
    }
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
