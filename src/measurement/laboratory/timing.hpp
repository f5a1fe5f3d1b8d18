// Sign and clock of the slip channel, without a model: while a block slips one way, u'' + a hardly changes, whatever the
// law of friction, since it is the acceleration that friction gives it. With the slip mirrored, or behind the floor, the
// sum still holds what the floor does.
#pragma once

#include "measurement/predict/bench.hpp"

namespace freestand::measurement {

struct Timing {
  bool mirrored = false;
  int late_steps = 0;  // by which the slip lags behind the floor's channel
  double late = 0;     // the same between the steps, by the parabola through the least variance and its neighbours
  double gain = 1;     // variance of u'' + a as measured, over that with the slip turned round and shifted by these
  double next =
      1;  // least variance at a lag, as mirrored, beyond two windows of smoothing from this one, over that here
  double samples = 0;  // independent ones
  // Chance that the least variance at one of so many lags and signs is so far below that as measured, were it the same at all but for chance: a
  // ratio of variances of so many samples each is Fisher's F.
  double p = 1;
  bool judged() const;  // there was slip enough
  bool wrong() const;   // more than chance
  bool known()
      const;  // no other lag brings the variance nearly as low, and the least is not at the end of those looked at
};

// Among lags of up to most_steps either way and both signs, the one in which u'' + a varies least about its mean of each
// direction, over the slips of one test; both smoothed alike. sign_is_known: as measured, no other is looked at.
Timing slip_timing(const Bench&, std::size_t test, int most_steps, bool sign_is_known = false);

// Of the floors of the other tests, the one under which u'' + a varies least over the slips of this test, as measured.
struct OtherFloor {
  std::size_t test = 0;
  double gain = 1;        // variance of u'' + a under its own floor over that under the other
  bool judged = false;    // there was slip enough, and another floor that covers it at the same rate
  bool likelier() const;  // more than chance: as Timing::wrong()
};
std::vector<OtherFloor> floors_of_others(const Bench&);  // of each test

// By what the slip has to be multiplied for c u'' + a to vary least: by least squares of a on u'' over the slips, freed of what noise of the
// slip adds to the squares of u''. 1 is right.
struct SlipScale {
  double factor = 1;
  double gain =
      1;  // the lesser of the variances of u'' + a and of a over that of c u'' + a: a slip in any unit tells of the floor
  bool judged = false;  // there was slip enough, under a floor that moved beyond its noise
  bool is_a_unit()
      const;  // a ratio of two units of length is nearer than a fit tells, and the gain is more than chance
};
SlipScale slip_scale(const Bench&, std::size_t test);
// Springs, and contents that move, pull with the slip's acceleration as well: they make factors up to this.
inline constexpr double factor_of_springs = 5;

}  // namespace freestand::measurement
