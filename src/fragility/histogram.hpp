// The fixed fine histogram of ln(EDP) from which goodness of fit and empirical curves are taken: memory does not grow
// with the number of samples, and counts merge exactly.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace freestand::fragility {

// Cells of width 1/256 in ln(EDP) from -18 to 12 (EDP from 1.5e-8 to 1.6e5 in its unit), one cell below and
// one above. S errs by `resolution` below, 5e-6 at omega 0.3 and 5e-5 at 0.1, where 10^6 samples scatter it by 8e-4.
inline constexpr double ln_lowest = -18, ln_highest = 12, ln_cell_width = 1.0 / 256;
inline constexpr int ln_cell_count = 30 * 256 + 2;

// Cell of a value, 0 (below the range) ... ln_cell_count - 1 (above it).
int ln_cell(double ln_value);

// Left edge of a cell; for cell 0 one cell width below the range.
double ln_cell_edge(int cell);

// So much of what was counted is cut off at or below that value.
struct Cut {
  double weight, ln_threshold;
};

// S and A^2 of the counts (ln_cell_count of them) against N(lambda, omega^2), or against the mixture of its parts above each of the cuts. The samples of a cell are taken as spread evenly over it: that is no other sample of the same
// distribution but for the density's slope within a cell, which moves its distribution function by at most
// ln_cell_width^2/(8 omega^2 sqrt(2 pi e)), and for the share of samples outside the range; `resolution` is the sum of both.
struct HistogramGoodness {
  double ks, ad, resolution;
};
HistogramGoodness histogram_goodness(std::span<const std::int64_t> count, double lambda, double omega,
                                     const std::vector<Cut>& cuts = {});

}  // namespace freestand::fragility
