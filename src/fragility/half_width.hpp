// How well the surfaces are known, for `until: {half_width: ..., relative_error: ...}`, what more samples would do, and in which
// bins of intensity they would.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "fragility/result.hpp"

namespace freestand::fragility {

// The half width that holds at all m points at once, those over a second axis included: by Bonferroni's inequality, which shares a chance of
// 1 - confidence out among them, whatever they have to do with each other (O. Dunn, J. American Statistical Association 56, 1961). With
// upper and lower a point's own band at `confidence`,
//   h = k max(upper - P, P - lower), 0.5 at most,   k = q((1 - confidence)/(2 m))/q((1 - confidence)/2),
// q the upper quantile of the distribution by which the band goes: Student's t where it is of records, or of a fit, with one degree of
// freedom less than there are motions in the bin (of records all have: at most 63), else the normal one. Of 48 points k = 1.67 at 95 %, and
// 3.07 with five records. m counts the points that are wanted: none of bins without a single sample, nor of cells of a second axis that would
// hold fewer than minimum_samples if as many samples were drawn as there may be. A point without a band (too few samples, or too few
// motions) in a bin or cell that the sweep does reach is one of them, and counts as unknown, which is a half width of 0.5.
//
// By simulation (tests/fragility/known_at_once_test.cpp, 1000 sets, 95 %) of eight bins with six points each no estimate is off by more than h in
// 0.99 of the sets, by counts of 300 samples a bin as by lognormals of 4000; by more than the widest band of a single point none is in 0.39 and
// 0.58. Where no two points have to do with each other (one a bin, P = 0.3 to 0.65) h holds in 0.97 of the sets by counts, in 0.97
// of five records with a correlation of 0.15 to 0.2, and in 0.95 of 10 to 40 records with 0.3. Bands reach further to one side where P is small:
// with nothing but P = 0.02 to 0.09, one a bin, h holds in 0.97 of the sets of 2000 samples a bin, in 0.98 of 300.
struct HalfWidth {
  double largest = 0.5;
  double times_wanted = std::numeric_limits<double>::infinity();  // what is wanted is reached: at most 1
  double farthest = 0.5;                                          // of the point where that is,
  std::string edp;                                                // and where
  double im = unknown, capacity = unknown;
  std::string axis = {};  // of a surface over a second axis: its name, and where the cell stands
  double on_axis = unknown;
  int points = 0;                       // wanted
  int rare_cells = 0;                   // of second axes, not wanted
  std::vector<double> empty_bins = {};  // middles of the bins without a sample, not waited for any more
};

// What is wanted. All points at once: h of at most half_width; of 0.5 nothing is wanted, and all half widths here are those of single points
// (k = 1). And of each point by itself, of probability P: with z the normal quantile of the confidence, (upper - lower)/2 of at most
//   z relative_error max(P, down_to)
// so that P is known with a standard error of relative_error P, and where it is below down_to, with that of down_to.
struct Wanted {
  double half_width = 0.5;
  double relative_error = std::numeric_limits<double>::infinity(), down_to = 1;
  double at_most = std::numeric_limits<double>::infinity();  // that are drawn
  int minimum_samples = 30;
  double drawn = 0;  // so far: all of the result and those that were passed over; 0: all of the result

  bool at_once() const { return half_width < 0.5; }
};

// 0.5 and times without end if nothing has a band yet.
HalfWidth half_width(const Result& result, const Wanted& wanted = {});

// Of the points of which least is wanted, those of a probability of at most down_to: the smaller of half_width and z relative_error down_to.
double least_wanted(const Wanted& wanted, double confidence);

// What stays of the half width however many samples are made of these motions, and how many samples make all wanted points known well
// enough: infinite where what stays is already too much, so that only more motions help. With h the half width of a point's own band at n samples
// of a bin, t the quantile of the confidence at one degree of freedom less than there are motions, and v the variance of one sample,
//   h^2(n) = s^2 + t^2 v/n,   n wanted = t^2 v/(wanted^2 - s^2),   wanted = min(half_width/k, z relative_error max(P, down_to))
// Where samples are motions of their own, s = 0 and h^2 goes by 1/n. v is P(1 - P) of a counted point; of a fitted one, by the delta method,
//   v = (1 - (1 - never) Q)^2 over (1 - over) + ((1 - over) Q)^2 never (1 - never)/(1 - over)
//       + ((1 - over)(1 - never) phi(y))^2 (1 + y^2/2)/share that moved,   y = (ln C - lambda)/omega, Q = 1 - Phi(y).
// A point without a band needs minimum_samples at least.
struct Outlook {
  double stays = 0;       // k s, of the wanted point for which that is most times what is wanted
  double samples = 0;     // to be drawn in all
  bool at_least = false;  // points without a band want so many, and what they want then is not known
};
Outlook outlook(const Result& result, const Wanted& wanted);

// The bins of intensity that want more samples: those with a point that is not known well enough, unless more samples hardly help there,
// and those without a sample that may yet get some. A bin that would hold minimum_samples of at_most drawn ones stays empty in n of them
// with a chance of (1 - minimum_samples/at_most)^n < exp(-n minimum_samples/at_most): where that is below 1 - confidence, an empty bin is
// taken for one that would never fill. More samples hardly help where s is above what is wanted and t^2 v/n is less than a tenth of
// h^2: all that more can take off the band then is a twentieth.
std::vector<bool> bins_that_want(const Result& result, const Wanted& wanted);

}  // namespace freestand::fragility
