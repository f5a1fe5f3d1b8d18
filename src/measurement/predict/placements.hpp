// Probability that a specimen overturns, when no two placements of it are alike: ln(width) is normal about the model's
// with ModelSpec::placement_scatter (ln(slenderness) at the same size, where the model is given by those).
//
// What is predicted is the share of 64 placements, at the middles of as many equally likely parts, that overturn: one place
// at which the outcome changes moves it by 1/128 at most.
//
// For a fit the outcome is computed at places, equal steps apart in that logarithm and anchored at its zero, and taken to
// change evenly between two places that differ; beyond the last ones it stays. So the probability is a smooth function of
// middle and scatter, and the same outcomes serve for all middles and scatters: a fit need not compute them again.
#pragma once

#include <cstdint>

#include "measurement/predict/bench.hpp"

namespace freestand::measurement {

// At most 64 of them.
struct Places {
  double first = 0, step = 0;
  int count = 1;
  double at(int k) const { return first + k * step; }
  std::vector<double> all() const;
  bool operator==(const Places&) const = default;
};

// Middle of ln(slenderness) or ln(width); 0 where every test has its own width, and places are relative to that.
double placement_middle(const ModelSpec&, std::span<const double> x);
double placement_scatter(const ModelSpec&, std::span<const double> x);
inline constexpr double steepest_rad = 1.5;  // a slenderness lies below pi/2
// The slenderness or the width there.
double placed_at(const ModelSpec&, double place);
// The free number that moves the middle; -1: none.
int placement_number(const ModelSpec&);
// That of their scatter; -1: it is known.
int scatter_number(const ModelSpec&);
// All others.
std::vector<std::size_t> other_numbers(const ModelSpec&);

// Distance of places that is fine enough for a scatter: between a fifth and two fifths of it, a power of two.
double place_step(double scatter);
// All places in [low, high], and the next beyond; wider apart than `step` if need be.
Places places_between(double low, double high, double step);

// Share of the placements that each place stands for; their sum is 1.
std::vector<double> place_shares(const Places&, double middle, double scatter);

// One word a test: bit k is set where it overturns at the k-th of at most 64 places. All samples go as one batch. (A narrower
// specimen does not always overturn before a wider one, so that no place can be left out.)
std::vector<std::uint64_t> outcomes(const Bench&, const std::vector<std::size_t>& tests, const ModelSpec&,
                                    std::span<const double> x, std::span<const double> places);

// Sum of the shares whose bit is set.
double overturning_share(std::uint64_t outcomes, const std::vector<double>& shares);

// Of each of these tests.
std::vector<double> overturning_probabilities(const Bench&, const std::vector<std::size_t>& tests, const ModelSpec&,
                                              std::span<const double> x);

}  // namespace freestand::measurement
