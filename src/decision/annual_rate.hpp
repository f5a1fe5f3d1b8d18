// How often a year a demand exceeds a capacity: the hazard curve and the fragility together.
//
//   rate = integral of P(EDP > C | im) |d lambda(im)|
//
// with lambda the annual rate of exceeding im (C. A. Cornell, Bull. Seism. Soc. Am. 58, 1968). Events are taken as a Poisson process:
// P(at least one in N years) = 1 - exp(-rate N).
#pragma once

#include <limits>
#include <vector>

#include "decision/hazard.hpp"

namespace freestand::decision {

struct Range {
  double from = 0, to = std::numeric_limits<double>::infinity();
};

// P = Phi(ln(im/median)/dispersion).
struct LognormalFragility {
  double median, dispersion;
  double operator()(double im) const;
};

// The integral over the intensities of `range` that the hazard curve spans, without what lies beyond its ends. By Gauss and Legendre in
// ln im, in panels that neither P nor the hazard turns in: relative error below 1e-10. For rate = k0 im^-k everywhere it is
// k0 median^-k exp(k^2 dispersion^2/2). NaN where the fragility is.
double annual_rate(const HazardCurve&, const LognormalFragility&, const Range& range = {});

// The same under a curve that is cut once, for many fragilities. A stretch of it: rate = rate_from (im/from)^-slope.
struct HazardPiece {
  double from, to, rate_from, rate_to, slope;
};
std::vector<HazardPiece> pieces(const HazardCurve&, const Range& range = {});
double annual_rate(const std::vector<HazardPiece>&, const LognormalFragility&);

// A fragility that is known at some intensities (increasing): linear in ln im between them, constant to the ends of `known`, which
// holds them; nothing is said outside.
struct TabulatedFragility {
  std::vector<double> im, probability;
  Range known;
};

// Its integral is linear in the probabilities: rate = sum_i weight_i probability_i. Over the intensities of `range` that both `known` and
// the hazard curve span.
std::vector<double> rate_weights(const HazardCurve&, const TabulatedFragility&, const Range& range = {});

// 1 - exp(-rate years)
double probability_in_years(double annual_rate, double years);

}  // namespace freestand::decision
