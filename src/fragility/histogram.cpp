#include "fragility/histogram.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/units.hpp"
#include "fragility/goodness.hpp"

namespace freestand::fragility {

int ln_cell(double ln_value) {
  const double cell = std::floor(ln_value / ln_cell_width) - ln_lowest / ln_cell_width + 1;
  return static_cast<int>(std::clamp(cell, 0.0, static_cast<double>(ln_cell_count - 1)));
}

double ln_cell_edge(int cell) { return ln_lowest + (cell - 1) * ln_cell_width; }

HistogramGoodness histogram_goodness(std::span<const std::int64_t> count, double lambda, double omega) {
  std::vector<double> u;
  const double scale = 1 / (omega * std::sqrt(2.0));
  for (int cell = 0; cell < ln_cell_count; ++cell) {
    const std::int64_t here = count[static_cast<std::size_t>(cell)];
    for (std::int64_t k = 0; k < here; ++k) {
      const double place = (static_cast<double>(k) + 0.5) / static_cast<double>(here);
      u.push_back(0.5 * std::erfc(-(ln_cell_edge(cell) + place * ln_cell_width - lambda) * scale));
    }
  }
  const double outside = static_cast<double>(count.front() + count.back());
  const double resolution = ln_cell_width / (omega * std::sqrt(2 * pi)) + outside / static_cast<double>(u.size());
  return {ks_statistic(u), ad_statistic(u), resolution};
}

}  // namespace freestand::fragility
