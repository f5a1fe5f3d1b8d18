// Samples that share a record: how alike they are, and the null distribution of S, with motions as the unit.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace freestand::fragility {

// How a number (ln demand) varies: samples of one group of records are correlated by `correlation`.
struct Clustering {
  std::vector<double> sizes;  // samples of each group of records, those with none left out
  double single = 0;          // samples that are motions of their own
  double correlation = 0;

  double n() const;
};

// Of one group: samples, sums of the number and of its square.
struct GroupMoments {
  double n, sum, sum2;
};

// The correlation by analysis of variance with unequal groups, (B - W)/(B + (n0 - 1) W), not below 0; 0 with fewer than
// two groups of records, or none that holds two samples (R. A. Fisher; S. Searle, Linear Models, 1971).
Clustering clustering(std::span<const GroupMoments> groups, std::size_t record_groups);

// S of `repeats` simulated bins, increasing: normal numbers that are clustered alike, those below the share `below`
// of the distribution cut off, mean and deviation estimated from the rest (fit_truncated), S against that estimate. Up
// to 256 samples are drawn one by one; of more the groups' normal effects are drawn, and about the mixture of the groups
// the empirical distribution of 256 independent samples, its deviations shrunk to those of n.
std::vector<double> clustered_null(const Clustering&, double below, std::uint64_t seed, int repeats);

// Share of the null at or above s (at least 1/(repeats + 1)).
double null_p(const std::vector<double>& null, double s);

}  // namespace freestand::fragility
