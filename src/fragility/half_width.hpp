// How well the surfaces are known, for `until: {half_width: ...}`, and what more samples would do.
#pragma once

#include <limits>
#include <string>

#include "fragility/result.hpp"

namespace freestand::fragility {

// The largest (upper - lower)/2 over all points of the surfaces, those over a second axis included. A point without a band (too few
// samples, or too few motions) in a bin or cell that the sweep does reach counts as unknown, which is a half width of 0.5. Bins
// without a single sample are not wanted, nor are cells of a second axis that would hold fewer than minimum_samples if as many samples
// were made as there may be. 0.5 too if nothing has a band yet.
struct HalfWidth {
  double largest = 0.5;
  std::string edp;  // where that is
  double im = unknown, capacity = unknown;
  std::string axis = {};  // of a surface over a second axis: its name, and the middle of the cell
  double on_axis = unknown;
  int points = 0;        // that have a band
  int empty_points = 0;  // that have none
  int rare_cells = 0;    // of second axes, not wanted
};

struct Wanted {
  double half_width = 0.5;
  double at_most = std::numeric_limits<double>::infinity();  // samples
  int minimum_samples = 30;
};

HalfWidth half_width(const Result& result, const Wanted& wanted = {});

// What stays of the half width however many samples are made of these motions, and how many samples make all wanted points known well
// enough: infinite where what stays is already too much, so that only more motions help. With h the half width at n samples of a bin, t the
// quantile of the confidence at one degree of freedom less than there are motions, and v the variance of one sample,
//   h^2(n) = stays^2 + t^2 v/n,   n wanted = t^2 v/(wanted^2 - stays^2)
// Where samples are motions of their own, stays = 0 and h^2 goes by 1/n. v is P(1 - P) of a counted point; of a fitted one, by the delta method,
//   v = (1 - (1 - never) Q)^2 over (1 - over) + ((1 - over) Q)^2 never (1 - never)/(1 - over)
//       + ((1 - over)(1 - never) phi(y))^2 (1 + y^2/2)/share that moved,   y = (ln C - lambda)/omega, Q = 1 - Phi(y).
// A point without a band needs minimum_samples at least.
struct Outlook {
  double stays = 0;    // the largest over the wanted points
  double samples = 0;  // of the whole sweep
};
Outlook outlook(const Result& result, const Wanted& wanted);

}  // namespace freestand::fragility
