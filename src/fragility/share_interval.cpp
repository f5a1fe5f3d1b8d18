#include "fragility/share_interval.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fragility/variance_sum.hpp"

namespace freestand::fragility {
namespace {

constexpr double fewest_records = 3;  // that make a count whose error is known

// Of records.
struct CountedSums {
  double n = 0, hits = 0, squares = 0, miss_squares = 0, n_squares = 0;
  double n_that_hit = 0, n_that_missed = 0;  // samples of records that did, at least once
  int records = 0;

  explicit CountedSums(std::span<const GroupShare> groups) {
    for (const GroupShare& g : groups) {
      if (!(g.n > 0)) continue;
      ++records;
      n += g.n;
      hits += g.hits;
      squares += g.hits * g.hits;
      miss_squares += (g.n - g.hits) * (g.n - g.hits);
      n_squares += g.n * g.n;
      if (g.hits > 0) n_that_hit += g.n;
      if (g.hits < g.n) n_that_missed += g.n;
    }
  }

  double share() const { return hits / n; }
  // As many that hit alike scatter as these do.
  double that_hit() const { return hits * hits / squares; }
  double that_missed() const { return (n - hits) * (n - hits) / miss_squares; }
  double effective_records() const { return n * n / n_squares; }
};

// Limits in ln odds.
class OddsLimits {
 public:
  // independent: they reach at least as far as those of independent samples.
  OddsLimits(std::span<const GroupShare> records, const CountedSums& sums, bool independent = true)
      : p_(sums.share()), independent_(independent ? std::sqrt(p_ * (1 - p_) / sums.n) : 0) {
    VarianceSum variance;
    // By how much p moves where the record is left out: one that makes most of p hides how far it lies off the others.
    std::vector<double> excess;
    double sum = 0, squares = 0;
    for (const GroupShare& g : records) {
      if (!(g.n > 0)) continue;
      excess.push_back((g.hits - p_ * g.n) / (sums.n - g.n));
      sum += excess.back();
      squares += excess.back() * excess.back();
    }
    const auto groups = static_cast<double>(excess.size());
    variance.add((squares - sum * sum / groups) * (groups - 1) / groups, excess);
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

namespace {

Interval of_records(std::span<const GroupShare> groups, double confidence) {
  const CountedSums sums(groups);
  if (sums.hits <= 0 || sums.hits >= sums.n)
    return exact_interval(sums.share() * sums.records, sums.records, confidence);
  if (sums.records < 2) return {0, 1};
  const OddsLimits limits(groups, sums);
  // No share is greater than that of the records that show anything of it, whose own limit lies above what they are of all.
  const auto at_most = [&](double limit, double share_shown, double of) {
    if (limit <= share_shown) return limit;
    const double records = sums.effective_records();
    return std::min(limit, exact_interval(share_shown * records, records, 1 - 2 * of).upper);
  };
  const double tail = (1 - confidence) / 2, of_none = -std::expm1(std::log(tail) / sums.records);
  const auto own_lower = [&](double of) { return 1 - at_most(1 - limits.lower(of), sums.n_that_missed / sums.n, of); };
  const auto own_upper = [&](double of) { return at_most(limits.upper(of), sums.n_that_hit / sums.n, of); };
  const auto lower = [&](double of) {
    return sums.that_missed() < fewest_records ? std::min(own_lower(of), 1 - of_none) : own_lower(of);
  };
  const auto upper = [&](double of) {
    return sums.that_hit() < fewest_records ? std::max(own_upper(of), of_none) : own_upper(of);
  };
  const double least = lower(tail), most = upper(tail);
  return {lower(tail + unused_tail(tail, +1, own_upper, most)), upper(tail + unused_tail(tail, -1, own_lower, least))};
}

// Of samples that are motions of their own; each group is a design, or says nothing.
Interval of_samples(std::span<const GroupShare> groups, bool designs, double confidence) {
  const CountedSums sums(groups);
  const Interval exact = exact_interval(sums.hits, sums.n, confidence);
  if (!designs || sums.records < 2 || sums.that_hit() < fewest_records || sums.that_missed() < fewest_records)
    return exact;
  const OddsLimits among(groups, sums, false);
  const double tail = (1 - confidence) / 2;
  return {std::min(exact.lower, among.lower(tail)), std::max(exact.upper, among.upper(tail))};
}

}  // namespace

Interval share_interval(std::span<const GroupShare> groups, std::size_t record_groups, double confidence,
                        bool designs) {
  const auto records = groups.first(std::min(record_groups, groups.size()));
  GroupShare all{0, 0}, single{0, 0};
  for (std::size_t g = 0; g < groups.size(); ++g) {
    all.n += groups[g].n, all.hits += groups[g].hits;
    if (g >= record_groups) single.n += groups[g].n, single.hits += groups[g].hits;
  }
  const double of_record = all.n - single.n, hits_of_record = all.hits - single.hits;
  if (!(all.n > 0)) return {0, 1};
  const auto others = groups.subspan(records.size());
  if (!(of_record > 0)) return of_samples(others, designs, confidence);
  const Interval recorded = of_records(records, confidence);
  if (!(single.n > 0)) return recorded;
  const Interval made = of_samples(others, designs, confidence);
  const double p = all.hits / all.n;
  const auto limit = [&](double of_records, double of_single) {
    return std::hypot((of_record * of_records - hits_of_record) / all.n, (single.n * of_single - single.hits) / all.n);
  };
  return {std::max(0.0, p - limit(recorded.lower, made.lower)), std::min(1.0, p + limit(recorded.upper, made.upper))};
}

Interval share_interval(std::span<const GroupShare> groups, const MotionGroups& motions, double confidence) {
  return share_interval(groups, static_cast<std::size_t>(motions.record_groups()), confidence, motions.designs());
}

}  // namespace freestand::fragility
