// One overturning curve over all intensities.
#pragma once

#include <vector>

#include "fragility/result.hpp"
#include "fragility/tally.hpp"

namespace freestand::fragility {

// `over` of `n` samples at intensity `im` > 0 overturned (reals, since resampled counts are weighted).
struct OverturningPoint {
  double im, n, over;
};

// P = Phi(a + b ln IM); median = exp(-a/b), dispersion = 1/b. penalised: the outcomes separate (some intensity parts all that overturned from all that stood), so
// that the likelihood has no maximum; Jeffreys' prior is multiplied to it (Firth 1993; Kosmidis & Firth, Biometrika
// 108, 2021), which keeps the estimate finite.
struct OverturningFit {
  double a = unknown, b = unknown;
  double median = unknown, dispersion = unknown;
  bool penalised = false;
};

// a and b are NaN where no sample, or every sample, overturned, or where all lie at one intensity; median and
// dispersion also where overturning does not grow with intensity (b <= 0).
// `start`: a fit to similar points, to save iterations.
OverturningFit fit_overturning(const std::vector<OverturningPoint>& points, const OverturningFit& start = {});

// P at an intensity; 0 where im <= 0, NaN where the fit is.
double overturning_probability(const OverturningFit& fit, double im);

// The curve of a tally, with everything that says how good it is from resampled motions. Cells with IM <= 0 do not enter
// the fit.
OverturningCurve overturning_curve(const Tally& tally, const Resampling& resampling);

}  // namespace freestand::fragility
