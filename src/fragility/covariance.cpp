#include "fragility/covariance.hpp"

#include <cmath>

namespace freestand::fragility {
namespace {

// Sum of (x - mean)(y - mean).
double about_means(double n, double x, double y, double xy) { return xy - x * y / n; }

double covariance_of(const PairSums& s) {
  const auto n = static_cast<double>(s.n);
  const double ab = about_means(n, s.a, s.b, s.ab), mm = about_means(n, s.m, s.m, s.mm);
  // Sums are exact to 2^-40 a term: less than that times n is no spread.
  if (!(mm > 1e-9 * n)) return ab / (n - 1);
  return (ab - about_means(n, s.a, s.m, s.am) * about_means(n, s.b, s.m, s.bm) / mm) / (n - 2);
}

}  // namespace

Covariance covariance(const Tally& tally) {
  const Options& options = tally.options();
  Covariance found;
  for (const std::size_t e : tally.layout().paired) found.edps.push_back(options.edps[e].name);
  const std::size_t demands = found.edps.size(), bins = tally.layout().bins;
  found.ln_covariance.assign(bins * demands * demands, unknown);
  found.n.assign(found.ln_covariance.size(), 0);
  for (std::size_t bin = 0; bin < bins; ++bin)
    for (std::size_t i = 0; i < demands; ++i)
      for (std::size_t j = i; j < demands; ++j) {
        const PairSums sums = tally.pair(bin, i, j);
        const double value = sums.n >= options.minimum_samples && sums.n > 2 ? covariance_of(sums) : unknown;
        for (const std::size_t at : {(bin * demands + i) * demands + j, (bin * demands + j) * demands + i}) {
          found.n[at] = sums.n;
          found.ln_covariance[at] = value;
        }
      }
  return found;
}

}  // namespace freestand::fragility
