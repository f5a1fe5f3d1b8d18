// What becomes of a slip in the endless row of ever smaller hops with which a block comes to stand on both corners.
#pragma once

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

}  // namespace freestand::dynamics
