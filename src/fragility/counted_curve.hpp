// P(EDP > C) over the intensity by the counted shares of the bins: what stands for a fitted curve that is not adequate. Rates integrate it,
// and discrete exports hand it on.
//
// Straight lines from bin to bin lie above a curve that bends up, and shares of whole bins lie above the share at their mean: of ten bins as
// wide as the curve's dispersion annual rates come out 8 % too large at a hazard slope of 1.5, and 27 % at 2.5. So the shares are joined
// by straight lines over the fitted curve F instead of over the intensity: with F_i what bin i would show if the curve were true
// (its mean over the bin's intensities, as its fine cells tell these),
//
//   P(im) = p_i + (p_{i+1} - p_i) (F(im) - F_i)/(F_{i+1} - F_i)
//
// (the lines of a probability plot; M. B. Wilk & R. Gnanadesikan, Biometrika 55, 1968). P lies between the shares of its neighbours whatever F is,
// and is without bias where F is true, since it is linear in the shares: E P = F. Below the first bin it falls in proportion to the
// curve, P = p_1 F/F_1 (what it has beside the curve, left to stay, would make it p_1 at least whenever chance gave p_1 more, and with hundreds
// of times the events there rates of such bins came out 1.6 times); above the last it grows in proportion where the curve has
// more, so that what was never counted stays so, and else 1 - P falls in proportion. Where F does not change from bin to bin (0 or 1 to the
// last digit), where the shares fall, which F never does, and where there is no curve, the lines are over the intensity, between the places
// at which F is F_i, and level beyond such bins.
//
// A fitted curve that is off tells wrongly how P grows within a bin, and rates follow it: of 12 bins of even width up to 2 g, a wall that is hit
// from 0.1 g on came out 1.55 times too often under configs/hazard.csv. Nor need it be refuted: of 8 bins and 20 records, slips of blocks with
// friction of 0.1 or 0.45 came out 1.33 times too often on the average of ten sweeps. So, unless the curve is adequate, the fine cells of IM
// tell, up to eight a bin (FragilityFunction::cell_share). Where there are two a bin at least, rates go by lines through their shares, whether
// these rise or fall (through_cells): below the first in proportion to the fitted curve, and level beyond the last. Exports, which may not
// fall, and rates by fewer cells take F as the cells show it, pooled where they fall.
#pragma once

#include <vector>

#include "fragility/result.hpp"

namespace freestand::fragility {

// A bin with enough samples. places: how its intensities are spread, in their order; by_law: its probability is that of a law at its mean, not
// a share of the whole bin; index: which of the result.
struct CountedBin {
  struct Place {
    double im, n;
  };
  double im, probability;
  std::vector<Place> places = {};
  bool by_law = false;
  std::size_t index = 0;
};

// Bin number `index` with a probability of P(EDP > C).
CountedBin counted_bin(const Result&, std::size_t index, double probability);

// The counted shares of the bins of one capacity that are known and lie above 0, in the order of their intensities.
std::vector<CountedBin> counted_bins(const Result&, const EdpResult&, std::size_t capacity);

class CountedCurve {
 public:
  // What F is: the lognormal, or the shares of cells where there are any; NaN and none: straight lines.
  struct Shape {
    double median = unknown, dispersion = unknown;
    std::vector<double> cell_im = {}, cell_n = {}, cell_share = {};

    Shape() = default;
    Shape(double of_median, double of_dispersion) : median(of_median), dispersion(of_dispersion) {}
    explicit Shape(const FragilityFunction& f)
        : median(f.median), dispersion(f.dispersion), cell_im(f.cell_im), cell_n(f.cell_n), cell_share(f.cell_share) {}
  };

  // One bin at least.
  CountedCurve(const std::vector<CountedBin>&, Shape);

  // By lines through the cells of the shape: one at least.
  static CountedCurve through_cells(Shape);

  double operator()(double im) const;

 private:
  explicit CountedCurve(Shape shape) : shape_(std::move(shape)) {}

  double fitted(double im) const;
  double lognormal(double im) const;
  double over_bin(const CountedBin&) const;
  double where(const CountedBin&, double shown) const;

  Shape shape_;
  struct Knot {
    double im, fitted, probability;  // im: where the curve shows `fitted`
  };
  std::vector<Knot> knots_;
};

// Intensities between which straight lines follow the curve to a fiftieth of it (or 1e-6): the means of the bins, `least` and `most` where they
// lie below and above these, and what is needed between.
std::vector<double> places_to_follow(const CountedCurve&, const std::vector<CountedBin>&, double least, double most);

}  // namespace freestand::fragility
