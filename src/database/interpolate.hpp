// Probabilities between those that are known.
#pragma once

#include <span>
#include <vector>

#include "database/database.hpp"

namespace freestand::database {

// A probability with its band. resolution: a share smaller than this (or nearer to 1) is not told from none (or all).
struct Probability {
  double value = unknown, lower = unknown, upper = unknown;
  double resolution = 1e-3;
  // More than the least of the curves that it lies between ever reaches: none tells at which intensity it comes.
  bool none_tells = false;
};

// Between curves with these weights, which sum to 1 and may be negative outside of them: at equal probability. P at im is that of
// which the curves' intensities have im as their weighed geometric mean: of lognormals that is one, of the weighed ln medians and the
// weighed dispersions, and where one curve has come to 1 and another is still at 0 the change lies between theirs. The ends of a band
// alike, with a negative weight the opposite one. Above the largest P that all of them reach it is at least the mean of Phi^-1(P), with a
// band that holds those of all, or, with a negative weight, level with a band up to 1. Where one of the curves falls as the intensity rises
// (over the report's PTA/(mu g) - 1), or a negative weight makes the answer fall, by blend(), of whose band nothing is known in the latter
// case.
Probability between(std::span<const Curve* const>, std::span<const double> weights, double im);

// Between probabilities at one intensity. The mean is taken of Phi^-1(P), each P first drawn in to the resolution, so that the ends of a band
// stay in order; with a negative weight the opposite end. Where all are within the resolution of 0, or of 1, the mean is of P itself; each end
// of the band for itself. So it is where some are and others are not: where between them the change begins none tells, and the band holds
// the bands of both. A lower end of 0, or an upper one of 1, of any that has a positive weight is that of the answer.
Probability blend(std::span<const Probability> known, std::span<const double> weights);

// The curve at an intensity > 0, by the rule that its family states: the lognormal of median and dispersion, or straight lines
// in P over the intensity between the points, from 0 at 0 to the first one (level below one from which the curve falls) and level above the last. So do the page of the
// database and exports read it. The band is on straight lines too: its ends, or of a lognormal, which takes it along, how far they
// are from their point (a bin's, which a curve that bends within the bin need not meet); level beyond the points. It is widened where it
// does not hold the curve. NaN where no point is known.
Probability at(const Curve&, double im);

// Is it read by its lognormal?
bool by_lognormal(const Curve&);

// Is the intensity outside of what was swept?
bool outside(const Curve&, double im);

}  // namespace freestand::database
