// P(EDP > C) over the intensity by the counted shares of the bins: what stands for a fitted curve that is not adequate. Rates integrate it, and
// discrete exports hand it on.
//
// Straight lines from bin to bin lie above a curve that bends up, and shares of whole bins lie above the share at their mean: of ten bins as
// wide as the curve's dispersion annual rates come out 8 % too large at a hazard slope of 1.5, and 27 % at 2.5. So the fitted curve F lends
// its bend: with F_i what bin i would show if it were true,
//
//   P(im) = r(im) F(im) + e(im),   r_i = min(1, p_i/F_i),   e_i = p_i - r_i F_i
//
// r and e on straight lines over im between the means of the bins, level beyond the first and the last; P is level above the last mean.
// What the counts have beside the curve stays as it was counted, and where the curve has more than the counts, in proportion (difference and
// ratio estimates; W. Cochran, Sampling Techniques, 1977, chapters 6 and 7). Of a true curve it is that curve.
#pragma once

#include <vector>

#include "fragility/result.hpp"

namespace freestand::fragility {

// A bin with enough samples. `from`, `to`: its edges; by_law: its probability is that of a law at its mean, not a share of the whole bin.
struct CountedBin {
  double im, probability, from, to;
  bool by_law;
};

// The bins of the surface of one capacity that are known and lie above 0, in the order of their intensities.
std::vector<CountedBin> counted_bins(const Result&, const EdpResult&, std::size_t capacity);

class CountedCurve {
 public:
  // One bin at least. Without a fitted curve (NaN): straight lines.
  CountedCurve(const std::vector<CountedBin>&, double median, double dispersion);

  double operator()(double im) const;

 private:
  double fitted(double im) const;
  double over_bin(const CountedBin&) const;

  double median_, dispersion_;
  struct Knot {
    double im, r, e;
  };
  std::vector<Knot> knots_;
};

// Intensities between which straight lines follow the curve to a fiftieth of it (or 1e-6): the means of the bins, `least` where it lies
// below them, and what is needed between.
std::vector<double> places_to_follow(const CountedCurve&, const std::vector<CountedBin>&, double least);

}  // namespace freestand::fragility
