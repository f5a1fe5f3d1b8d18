// A lognormal curve over intensity, fitted to counts: the probit regression on ln IM.
#pragma once

#include <vector>

#include "fragility/result.hpp"

namespace freestand::fragility {

// `hits` of `n` samples at intensity `im` > 0 overturned, or exceeded a capacity (reals, since resampled counts are
// weighted).
struct ProbitPoint {
  double im, n, hits;
};

// P = Phi(a + b ln IM); median = exp(-a/b), dispersion = 1/b. penalised: the outcomes separate (some intensity parts all hits from all
// misses), so that the likelihood has no maximum; Jeffreys' prior is multiplied to it (Firth 1993; Kosmidis & Firth, Biometrika
// 108, 2021), which keeps the estimate finite.
struct ProbitFit {
  double a = unknown, b = unknown;
  double median = unknown, dispersion = unknown;
  bool penalised = false;
};

// a and b are NaN where no sample, or every sample, is a hit, or where all lie at one intensity; median and
// dispersion also where hits do not grow with intensity (b <= 0).
// `start`: a fit to similar points, to save iterations.
ProbitFit fit_probit(const std::vector<ProbitPoint>& points, const ProbitFit& start = {});

// P at an intensity; 0 where im <= 0, NaN where the fit is.
double probit_probability(const ProbitFit& fit, double im);

}  // namespace freestand::fragility
