// The lognormal along a line: ln X ~ N(lambda + slope x, omega^2) with x = ln IM, of which what lies at or below a threshold c is only counted,
// as in threshold_fit.hpp. A threshold cuts more of the demands where x is low, so that the least-squares line of what lies above is flatter
// than the truth, and the distribution about it is cut at no one place.
//
// Maximum likelihood in a = 1/omega, with e = a (ln x - ln c) - a (lambda - ln c) - a slope x and eta(x) = (lambda + slope x - ln c)/omega:
// where more are still than the line has below c
//   n ln a - sum e^2/2 - sum over the n above of ln Phi(eta(x))                       (truncated: A. C. Cohen 1950; C. Orme and P. Ruud, Econ. Lett. 63, 1999:
//                                                                                     one maximum), and `never` makes up the count;
// else never = 0 and
//   n ln a - sum e^2/2 + sum over those that stood still of ln Phi(-eta(x))           (J. Tobin, Econometrica 26, 1958).
// Each x is known in a cell, at whose mean the sums over ln Phi are taken.
#pragma once

#include <optional>
#include <span>

#include "fragility/threshold_fit.hpp"

namespace freestand::fragility {

// Of the demands above the threshold, y = ln X (numbers and sums are reals, since resampled ones are weighted).
struct LineSums {
  double n, x, xx, y, yy, xy;
};
// So many of a cell lie above the threshold, and so many at or below.
struct LineCell {
  double x, above, still;
};

struct LineFit {
  ThresholdFit at;  // lambda at x = 0; `below`: the share in the mean over all that stood
  double slope;
};

// threshold > 0. slope: known; else it is fitted, which needs x that vary. Everything is NaN where no lognormal's tail is so long, as in
// fit_above().
LineFit fit_line_above(const LineSums& above, std::span<const LineCell> cells, double threshold,
                       std::optional<double> slope = {});

}  // namespace freestand::fragility
