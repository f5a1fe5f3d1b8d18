#include "fragility/share_interval.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fragility/variance_sum.hpp"

namespace freestand::fragility {
namespace {

constexpr double fewest_records = 3;  // that make a count whose error is known

// All samples, those that are motions of their own, and the records.
struct CountedSums {
  double n = 0, hits = 0, squares = 0, miss_squares = 0;
  double single = 0, single_hits = 0;
  int records = 0, records_that_hit = 0, records_that_missed = 0;  // at least once

  CountedSums(std::span<const GroupShare> groups, std::size_t record_groups) {
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const double all = groups[g].n, above = groups[g].hits;
      n += all;
      hits += above;
      if (g >= record_groups) {
        single += all;
        single_hits += above;
      } else if (all > 0) {
        ++records;
        records_that_hit += above > 0;
        records_that_missed += above < all;
        squares += above * above;
        miss_squares += (all - above) * (all - above);
      }
    }
  }

  double share() const { return hits / n; }
  double motions() const { return single + records; }
  // As many that hit alike scatter as these do.
  double that_hit() const { return hits * hits / (squares + single_hits); }
  double that_missed() const { return (n - hits) * (n - hits) / (miss_squares + single - single_hits); }
};

// Limits in ln odds.
class OddsLimits {
 public:
  OddsLimits(std::span<const GroupShare> records, const CountedSums& sums)
      : p_(sums.share()), independent_(std::sqrt(p_ * (1 - p_) / sums.n)) {
    VarianceSum variance;
    std::vector<double> excess;
    for (const GroupShare& g : records)
      if (g.n > 0) excess.push_back(g.hits - p_ * g.n);
    const double n2 = sums.n * sums.n, groups = static_cast<double>(excess.size());
    if (groups > 1) {
      double sum = 0, squares = 0;
      for (const double e : excess) {
        sum += e;
        squares += e * e;
      }
      variance.add((squares - sum * sum / groups) * groups / (groups - 1) / n2, excess);
    } else {
      variance.add(std::pow(sums.n - sums.single, 2) * p_ * (1 - p_) / n2);  // one record: as one sample
    }
    if (sums.single > 0) {
      const double own = sums.single_hits / sums.single;
      variance.add(sums.single * own * (1 - own) / n2);
    }
    se_ = std::sqrt(variance.value());
    freedom_ = variance.freedom();
  }

  double upper(double tail) const { return at(+reach(tail)); }
  double lower(double tail) const { return at(-reach(tail)); }

 private:
  double reach(double tail) const {
    const double normal = gsl_cdf_ugaussian_Qinv(tail) * independent_;
    // Of freedom beyond 1e6, or without end, Student's t is normal.
    const double shown = freedom_ < 1e6 ? gsl_cdf_tdist_Qinv(tail, freedom_) * se_ : gsl_cdf_ugaussian_Qinv(tail) * se_;
    return std::max(normal, shown) / (p_ * (1 - p_));
  }
  double at(double distance) const { return 1 / (1 + (1 - p_) / p_ * std::exp(-distance)); }

  double p_, independent_, se_ = 0, freedom_ = 0;
};

}  // namespace

Interval share_interval(std::span<const GroupShare> groups, std::size_t record_groups, double confidence) {
  const CountedSums sums(groups, record_groups);
  if (!(sums.n > 0)) return {0, 1};
  if (sums.records == 0) return exact_interval(sums.hits, sums.n, confidence);
  if (sums.hits <= 0 || sums.hits >= sums.n)
    return exact_interval(sums.share() * sums.motions(), sums.motions(), confidence);
  if (sums.motions() < 2) return {0, 1};
  const OddsLimits limits(groups.first(record_groups), sums);
  // No share is greater than that of the records that show anything of it, whose own limit lies above what they are of all.
  const auto at_most = [&](double limit, int shown, double of) {
    if (sums.single > 0 || limit * sums.records <= shown) return limit;
    return std::min(limit, exact_interval(shown, sums.records, 1 - 2 * of).upper);
  };
  const double tail = (1 - confidence) / 2, of_none = -std::expm1(std::log(tail) / sums.motions());
  const auto own_lower = [&](double of) { return 1 - at_most(1 - limits.lower(of), sums.records_that_missed, of); };
  const auto own_upper = [&](double of) { return at_most(limits.upper(of), sums.records_that_hit, of); };
  const auto lower = [&](double of) {
    return sums.that_missed() < fewest_records ? std::min(own_lower(of), 1 - of_none) : own_lower(of);
  };
  const auto upper = [&](double of) {
    return sums.that_hit() < fewest_records ? std::max(own_upper(of), of_none) : own_upper(of);
  };
  const double least = lower(tail), most = upper(tail);
  return {lower(tail + unused_tail(tail, +1, own_upper, most)), upper(tail + unused_tail(tail, -1, own_lower, least))};
}

}  // namespace freestand::fragility
