// The fit of each IM bin of one demand parameter.
#pragma once

#include <vector>

#include "fragility/result.hpp"
#include "fragility/tally.hpp"

namespace freestand::fragility {

// Counts, intervals, lognormal fit and goodness of fit of every bin of an EDP, with the false discovery control over
// the bins and the status that follows. lambda_se and omega_se are left to the surface, which resamples.
//
// The bound on its misfit decides whether a lognormal is used, off_by <= Options::adequate and half of Options::half_width; its test says how the others are told, rejected or
// not refuted. Of n independent samples a counted share has the standard error sqrt(P (1 - P)/n), a true lognormal phi(z) sqrt((1 + z^2/2)/n),
// which is 0.80 of it at P = 0.5, 0.81 at 0.16, 0.63 at 0.02: counts cost a quarter more where errors are largest, and less where records
// differ, which is an error of both. A lognormal that misses the truth by d at P = 0.5 is the worse one from d = 0.3/sqrt(n) on, its test
// fails from about 0.9/sqrt(n) on, and its band knows of no misfit: that it passes tells nothing. While off_by is small no such d is left that
// matters. Root mean square errors of P at seven capacities (P = 0.05 to 0.95), and how often bands of 90 % hold it where every lognormal that
// passes is used and where the bound decides (tests/fragility/bin_use_test.cpp, 400 repeats, that of those that pass 120):
//
//   samples  records  ln demand    passes  counts  lognormal  passing is used: error, band  bound decides: error, band
//   60       of 1     normal       0.97    0.046   0.039      0.039  0.907                  0.046  0.933
//   60       of 1     exponential  0.51    0.046   0.054      0.051  0.817                  0.046  0.933
//   60       of 1     even         0.72    0.046   0.048      0.050  0.818                  0.046  0.933
//   300      of 1     normal       0.96    0.021   0.017      0.017  0.882                  0.021  0.912
//   300      of 1     exponential  0.01    0.021   0.043      0.021  0.905                  0.021  0.912
//   4000     of 1     normal       0.98    0.0056  0.0045     0.0044 0.898                  0.0045 0.887
//   1000     40       normal       0.95    0.030   0.029      0.029  0.942                  0.030  0.927
//
// The bound itself: off_by holds the misfit in 0.99 to 1 of the cases, but in 0.80 to 0.94 where tails are so heavy that it is 0.16 (S scatters
// there more than under its null), far from any use. A lognormal whose misfit is above `adequate` was used in none.
std::vector<BinFit> fit_bins(const Tally& tally, std::size_t edp);

}  // namespace freestand::fragility
