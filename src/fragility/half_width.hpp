// How well the surfaces are known, for `until: {half_width: ..., relative_error: ...}`, what more samples would do, and in which
// bins of intensity they would.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "fragility/result.hpp"

namespace freestand::fragility {

// (upper - lower)/2 of the points of the surfaces, those over a second axis included: the largest, and that of the point which is farthest
// from what is wanted of it; the same where one half width is wanted of all. A point without a band (too few samples, or too few motions) in a bin or
// cell that the sweep does reach counts as unknown, which is a half width of 0.5. Bins without a single sample are not wanted, nor are
// cells of a second axis that would hold fewer than minimum_samples if as many samples were drawn as there may be. 0.5 too if
// nothing has a band yet.
struct HalfWidth {
  double largest = 0.5;
  double times_wanted = std::numeric_limits<double>::infinity();  // what is wanted is reached: at most 1
  double farthest = 0.5;                                          // of the point where that is,
  std::string edp;                                                // and where
  double im = unknown, capacity = unknown;
  std::string axis = {};  // of a surface over a second axis: its name, and where the cell stands
  double on_axis = unknown;
  int points = 0;                       // that have a band
  int empty_points = 0;                 // that have none
  int rare_cells = 0;                   // of second axes, not wanted
  std::vector<double> empty_bins = {};  // middles of the bins without a sample, not waited for any more
};

// Of a point of probability P, with z the quantile of the confidence: a half width of at most
//   min(half_width, z relative_error max(P, down_to))
// so that P is known with a standard error of relative_error P, and where it is below down_to, with that of down_to.
struct Wanted {
  double half_width = 0.5;
  double relative_error = std::numeric_limits<double>::infinity(), down_to = 1;
  double at_most = std::numeric_limits<double>::infinity();  // that are drawn
  int minimum_samples = 30;
  double drawn = 0;  // so far: all of the result and those that were passed over; 0: all of the result
};

HalfWidth half_width(const Result& result, const Wanted& wanted = {});

// Of the points of which least is wanted, those of a probability of at most down_to.
double least_wanted(const Wanted& wanted, double confidence);

// What stays of the half width however many samples are made of these motions, and how many samples make all wanted points known well
// enough: infinite where what stays is already too much, so that only more motions help. With h the half width at n samples of a bin, t the
// quantile of the confidence at one degree of freedom less than there are motions, and v the variance of one sample,
//   h^2(n) = stays^2 + t^2 v/n,   n wanted = t^2 v/(wanted^2 - stays^2)
// Where samples are motions of their own, stays = 0 and h^2 goes by 1/n. v is P(1 - P) of a counted point; of a fitted one, by the delta method,
//   v = (1 - (1 - never) Q)^2 over (1 - over) + ((1 - over) Q)^2 never (1 - never)/(1 - over)
//       + ((1 - over)(1 - never) phi(y))^2 (1 + y^2/2)/share that moved,   y = (ln C - lambda)/omega, Q = 1 - Phi(y).
// A point without a band needs minimum_samples at least.
struct Outlook {
  double stays = 0;    // of the wanted point for which that is most times what is wanted
  double samples = 0;  // to be drawn in all
};
Outlook outlook(const Result& result, const Wanted& wanted);

// The bins of intensity that want more samples: those with a point that is not known well enough, unless more samples hardly help there,
// and those without a sample that may yet get some. A bin that would hold minimum_samples of at_most drawn ones stays empty in n of them
// with a chance of (1 - minimum_samples/at_most)^n < exp(-n minimum_samples/at_most): where that is below 1 - confidence, an empty bin is
// taken for one that would never fill. More samples hardly help where stays is above what is wanted and t^2 v/n is less than a tenth of
// h^2: all that more can take off the band then is a twentieth.
std::vector<bool> bins_that_want(const Result& result, const Wanted& wanted);

}  // namespace freestand::fragility
