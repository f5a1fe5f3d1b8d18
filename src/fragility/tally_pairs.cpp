// Sums over two demands of one sample.
#include <array>
#include <cmath>
#include <limits>

#include "fragility/tally.hpp"

namespace freestand::fragility {

void Tally::add_pairs(const Place& place, const Sample& sample) {
  if (sample.outcome == Outcome::overturned || !(sample.im > 0)) return;
  const double m = place.ln_im;
  const auto ln_moved = [&](std::size_t i) {
    const std::size_t e = layout_.paired[i];
    return sample.edp[e] > options_.edps[e].still_threshold && std::isfinite(sample.edp[e])
               ? std::log(sample.edp[e])
               : std::numeric_limits<double>::quiet_NaN();
  };
  for (std::size_t i = 0; i < layout_.paired.size(); ++i) {
    const double a = ln_moved(i);
    if (std::isnan(a)) continue;
    for (std::size_t j = i; j < layout_.paired.size(); ++j) {
      const double b = ln_moved(j);
      if (std::isnan(b)) continue;
      ++count_[layout_.pair_counts + layout_.pair(place.bin, i, j)];
      const std::array terms{m, m * m, a, b, a * b, a * m, b * m};
      static_assert(terms.size() == TallyLayout::sums_per_pair);
      ExactSum* sums = &sum_[layout_.pair_sums + TallyLayout::sums_per_pair * layout_.pair(place.bin, i, j)];
      for (std::size_t term = 0; term < terms.size(); ++term) sums[term].add(terms[term]);
    }
  }
}

PairSums Tally::pair(std::size_t bin, std::size_t i, std::size_t j) const {
  const ExactSum* s = &sum_[layout_.pair_sums + TallyLayout::sums_per_pair * layout_.pair(bin, i, j)];
  return {count_[layout_.pair_counts + layout_.pair(bin, i, j)],
          s[0].value(),
          s[1].value(),
          s[2].value(),
          s[3].value(),
          s[4].value(),
          s[5].value(),
          s[6].value()};
}

}  // namespace freestand::fragility
