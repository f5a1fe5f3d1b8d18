// Where shares are small a difference of probabilities says nothing: a curve that is 0.01 everywhere is within 0.05 of one that is 0, and gives
// many times its events a year. So a curve that may stand for the counts is held to them twice more:
//
// * Are annual rates by the curve within a twentieth of those by the counts (which does not show in the first of two digits)? Under hazard
//   curves of slope k = 1, 2, 3 (C. A. Cornell et al., J. Struct. Eng. 128, 2002: 1 to 4), as sums over the bins by trapezoids,
//   rate ~ sum_b share_b im_b^-k d ln im_b.
// * If not: is that chance? Of the bins in which the curve, or the count, is `small` at most, neighbours are pooled until five independent
//   samples are expected above (W. G. Cochran, Biometrics 10, 1954), and
//
//   Q = sum_j (counted_j - expected_j)^2 / V_j,   V_j the larger one of the variance by leaving out motions and of that of counts under the
//   curve, n p (1 - p) times the clustering: motions that show nothing have no scatter of their own, though they might have shown something
//
//   is held against F. Its degrees of freedom are m^2/tr(R^2), R the correlation of the m pools by leaving out motions (F. Satterthwaite,
//   Biometrics 2, 1946), and motions - 1.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace freestand::fragility {

struct SmallShares {
  std::vector<double> im, fitted;  // [bin]: mean intensity, and the curve's mean over the samples; NaN: too few samples
  std::vector<double> misfit;      // [bin]: counted share less `fitted`
  std::vector<double> samples;     // [bin]
  Eigen::MatrixXd left_out;  // [left out, bin]: misfits without a group of motions about the curve fitted without it
  int left_out_records = 0;  // the first of these are of records, the others of pulses
  // Samples of one motion are not independent: how many times the binomial variance the sum over a motion's samples has.
  double clustering = 1;
  int motions = 0;
  double small = 0.05;
};

// The chance of counts as far from the curve if it were true; 1 where its rates are theirs, or no bin is small; NaN where nothing was counted, or
// of fewer than two motions.
double chance_of_small_shares(const SmallShares&);

}  // namespace freestand::fragility
