// How well a variance is known that is a sum of strata's, each estimated from the scatter of its own groups.
#pragma once

#include <vector>

namespace freestand::fragility {

// f = 2 (sum_s V_s)^2/sum_s var(V_s),   var(V_s) = V_s^2 (2/(G_s - 1) + k_s/G_s)      (F. E. Satterthwaite, Biometrics Bulletin 2, 1946)
// with G_s values of the stratum and k_s their excess kurtosis by the ratio of unbiased cumulants, not below 0: where few groups make most
// of a number, its error is known worse than from as many normal ones.
class VarianceSum {
 public:
  // values: what V_s was estimated from; two at least.
  void add(double variance, const std::vector<double>& values);
  // A variance that is known.
  void add(double variance) { variance_ += variance; }

  double value() const { return variance_; }
  double freedom() const { return 2 * variance_ * variance_ / of_it_; }  // not finite where nothing scatters
 private:
  double variance_ = 0, of_it_ = 0;
};

}  // namespace freestand::fragility
