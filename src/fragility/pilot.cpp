#include "fragility/pilot.hpp"

#include <cmath>

#include "fragility/bin_sums.hpp"
#include "fragility/regression.hpp"

namespace freestand::fragility {

Options with_pilot(const Tally& first) {
  Options options = first.options();
  const std::size_t bins = first.layout().bins;
  options.pilot_im.clear();
  for (std::size_t b = 0; b < bins; ++b) {
    const double mean = first.mean_im(b), middle = 0.5 * (options.im_edge[b] + options.im_edge[b + 1]);
    options.pilot_im.push_back(mean > 0 ? mean : middle > 0 ? middle : 1);
  }
  options.pilot_slope.assign(options.edps.size(), std::vector<double>(bins, 0));
  for (std::size_t e = 0; e < options.edps.size(); ++e) {
    if (options.edps[e].binary) continue;
    const double everywhere = regressions(first.regression(e), {}).cloud_slope;
    for (std::size_t b = 0; b < bins; ++b) {
      const BinSums sums(sums_by_group(first, e, b).colwise().sum());
      const bool enough = sums.moved >= options.minimum_samples;
      const double im = im_of_line(options, b, options.pilot_im[b]);
      const double slope =
          enough ? law_of(sums, ln_im_of_cells(first, b), im, options.edps[e].still_threshold).slope : everywhere;
      if (std::isfinite(slope) && im > 0) options.pilot_slope[e][b] = slope;
    }
  }
  return options;
}

}  // namespace freestand::fragility
