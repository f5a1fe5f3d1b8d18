#include "decision/risk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <numeric>

#include "decision/annual_rate.hpp"
#include "fragility/intervals.hpp"
#include "fragility/jackknife.hpp"

namespace freestand::decision {
namespace {

using fragility::EdpResult;
using fragility::FragilityFunction;
using fragility::Result;
using fragility::unknown;

constexpr int intervals = 24;

// The hazard curve, with a point before its first one that goes on by its slope down to `im`.
HazardCurve begun_earlier(const HazardCurve& hazard, double im) {
  HazardCurve longer = hazard;
  longer.im.insert(longer.im.begin(), im);
  longer.annual_rate.insert(longer.annual_rate.begin(), hazard.rate(im));
  return longer;
}

// Events above the hazard curve's end are as many as it has there, and as likely to exceed as there.
struct ByFunction {
  const HazardCurve& hazard;
  double rate(const LognormalFragility& f, const Range& range = {}) const {
    const double tail = range.to > hazard.last() ? hazard.annual_rate.back() * f(hazard.last()) : 0;
    return annual_rate(hazard, f, range) + tail;
  }
};

// The band of a rate: by leaving out groups of motions; where one of them makes all of it, or none can be left out, from resampled motions.
Rate banded(double value, const std::vector<double>& left_out, const std::vector<double>& resampled,
            const Result& result) {
  const auto border = left_out.begin() + std::min<std::ptrdiff_t>(result.left_out_records, std::ssize(left_out));
  fragility::Interval band = fragility::jackknife_of_positive(
      value, {{left_out.begin(), border}, {border, left_out.end()}}, result.confidence);
  if (std::isnan(band.lower))
    band = fragility::percentile_interval(resampled, value, result.confidence, result.motions);
  return {value, band.lower, band.upper};
}

// The same of the counted shares of the bins: P from one bin's mean to the next, the last bin's share above the sweep, nothing below it.
class ByCounts {
 public:
  ByCounts(const HazardCurve& hazard, const Result& result, const EdpResult& edp, std::size_t c, const Range& swept)
      : hazard_(hazard) {
    const std::size_t capacities = edp.capacity.size();
    for (std::size_t i = 0; i < result.im.size(); ++i) {
      const double p = edp.surface.probability[i * capacities + c];
      if (!std::isfinite(p) || !(result.im[i] > 0)) continue;
      at_.push_back(i * capacities + c);
      table_.im.push_back(result.im[i]);
      table_.probability.push_back(p);
    }
    table_.known = {swept.from, std::numeric_limits<double>::infinity()};
  }

  bool empty() const { return table_.im.empty(); }

  std::vector<double> weights(const Range& range = {}) const {
    std::vector<double> weight = rate_weights(hazard_, table_, range);
    if (!(range.to > hazard_.last())) return weight;
    const auto next = static_cast<std::size_t>(std::upper_bound(table_.im.begin(), table_.im.end(), hazard_.last()) -
                                               table_.im.begin());
    const std::size_t low = next == 0 ? 0 : next - 1, high = std::min(next, table_.im.size() - 1);
    const double share =
        low == high ? 0 : std::log(hazard_.last() / table_.im[low]) / std::log(table_.im[high] / table_.im[low]);
    weight[low] += (1 - share) * hazard_.annual_rate.back();
    weight[high] += share * hazard_.annual_rate.back();
    return weight;
  }

  double rate(const std::vector<double>& weight) const {
    return std::inner_product(weight.begin(), weight.end(), table_.probability.begin(), 0.0);
  }

  // Rows that no resample changes (nothing above was counted, say) are known to their own bands, which hold the exact binomial limits;
  // what these allow adds as independent errors do.
  Rate banded(const Result& result, const EdpResult& edp) {
    const std::vector<double> weight = weights();
    const std::vector<double> resampled = rates(weight, edp.surface.resampled, edp),
                              left_out = rates(weight, edp.surface.left_out, edp);
    double below = 0, above = 0;
    for (std::size_t i = 0; i < at_.size(); ++i) {
      if (!same(i, edp.surface.resampled, edp)) continue;
      const fragility::Interval limits = rising_limits(i, edp);
      below += std::pow(weight[i] * (table_.probability[i] - limits.lower), 2);
      above += std::pow(weight[i] * (limits.upper - table_.probability[i]), 2);
    }
    Rate found = decision::banded(rate(weight), left_out, resampled, result);
    if (std::isnan(found.lower)) return found;
    found.lower = std::max(0.0, found.lower - std::sqrt(below));
    found.upper = std::min(hazard_.annual_rate.front(), found.upper + std::sqrt(above));
    return found;
  }

  double at_end() const { return table_.probability.back(); }
  bool bounded_by_others() const { return bounded_by_others_; }

 private:
  // Of a row in which nothing was counted: its upper limit, or that of a row at a higher intensity where it is less. Of one in which all
  // was counted the lower limit alike.
  fragility::Interval rising_limits(std::size_t i, const EdpResult& edp) {
    const double own_lower = edp.surface.lower[at_[i]], own_upper = edp.surface.upper[at_[i]];
    fragility::Interval limits{own_lower, own_upper};
    if (table_.probability[i] == 0)
      for (std::size_t j = i; j < at_.size(); ++j) limits.upper = std::min(limits.upper, edp.surface.upper[at_[j]]);
    if (table_.probability[i] == 1)
      for (std::size_t j = 0; j <= i; ++j) limits.lower = std::max(limits.lower, edp.surface.lower[at_[j]]);
    bounded_by_others_ = bounded_by_others_ || limits.lower > own_lower || limits.upper < own_upper;
    return limits;
  }

  // Of each resample, or of each group left out: `again` is [of them, im, capacity].
  std::vector<double> rates(const std::vector<double>& weight, const std::vector<double>& again,
                            const EdpResult& edp) const {
    const std::size_t size = edp.surface.probability.size();
    std::vector<double> found(size == 0 ? 0 : again.size() / size, 0);
    for (std::size_t r = 0; r < found.size(); ++r)
      for (std::size_t i = 0; i < at_.size(); ++i) found[r] += weight[i] * again[r * size + at_[i]];
    return found;
  }
  bool same(std::size_t i, const std::vector<double>& again, const EdpResult& edp) const {
    const std::size_t size = edp.surface.probability.size();
    for (std::size_t at = at_[i]; at < again.size(); at += size)
      if (again[at] != table_.probability[i]) return false;
    return true;
  }

  const HazardCurve& hazard_;
  TabulatedFragility table_;
  std::vector<std::size_t> at_;  // points of the surface
  bool bounded_by_others_ = false;
};

// Motions of which nothing exceeded have no curve: they count as no rate.
Rate banded(const Result& result, const FragilityFunction& f, const ByFunction& by) {
  const auto rates = [&](const std::vector<double>& median, const std::vector<double>& dispersion) {
    std::vector<double> found;
    for (std::size_t i = 0; i < median.size(); ++i) {
      const double rate = by.rate({median[i], dispersion[i]});
      found.push_back(std::isfinite(rate) ? rate : 0);
    }
    return found;
  };
  return banded(by.rate({f.median, f.dispersion}), rates(f.left_out_median, f.left_out_dispersion),
                rates(f.resampled_median, f.resampled_dispersion), result);
}

// One demand and one capacity.
class Row {
 public:
  Row(const Result& result, const HazardCurve& hazard, const EdpResult& edp, std::size_t c, const FragilityFunction& f,
      const Risk& risk)
      : result_(result),
        hazard_(hazard),
        risk_(risk),
        f_(f),
        function_{hazard},
        counts_(hazard, result, edp, c, {risk.im_least, risk.im_most}),
        edp_(edp) {
    row_.edp = edp.name;
    row_.unit = edp.unit;
    if (!edp.binary) row_.capacity = edp.capacity[c];
  }

  RiskRow operator()() {
    row_.by_function = banded(result_, f_, function_);
    if (!counts_.empty()) row_.by_counts = counts_.banded(result_, edp_);
    recommend();
    outside();
    if (row_.refused.empty() && row_.rate().value > 0) split();
    return std::move(row_);
  }

 private:
  LognormalFragility fragility() const { return {f_.median, f_.dispersion}; }

  void recommend() {
    const bool function = std::isfinite(row_.by_function.value), counts = std::isfinite(row_.by_counts.value);
    row_.recommended = function && (f_.adequate || !counts) ? By::function : By::counts;
    if (!function && !counts)
      row_.refused = "no bin has enough samples, and no curve could be fitted";
    else if (!function)
      row_.why = "no curve could be fitted (nothing exceeds, everything does, or it does not grow with the intensity)";
    else if (f_.adequate)
      row_.why = fmt::format("the fitted curve is adequate: off the counted shares by at most {:.2g}", f_.off_by);
    else if (counts)
      row_.why = fmt::format("the fitted curve is off the counted shares by up to {:.2g}", f_.off_by);
    else
      row_.why = "no bin has enough samples";
    if (row_.recommended == By::counts && counts_.bounded_by_others())
      row_.why +=
          "; where no sample exceeds it the upper limit of P is the least of those there and at higher intensities "
          "(and "
          "where all do the lower limit alike), since P is taken not to fall as the intensity rises";
  }

  void outside() {
    const double rate = row_.rate().value, end = hazard_.annual_rate.back();
    const bool function = std::isfinite(row_.by_function.value);
    if (!(rate > 0)) return;
    const double start = std::min(hazard_.first(), risk_.im_least) / 100;
    const HazardCurve longer = begun_earlier(hazard_, start);
    const Range before{0, hazard_.first()};
    double beyond = 0, missing = 0;
    if (function) {
      beyond = annual_rate(hazard_, fragility(), {0, risk_.im_least});
      if (hazard_.last() > risk_.im_most) beyond += function_.rate(fragility(), {risk_.im_most, Range{}.to});
      missing = annual_rate(longer, fragility(), before) + end * (1 - fragility()(hazard_.last()));
    } else {
      beyond = hazard_.last() > risk_.im_most ? hazard_.rate(risk_.im_most) * (1 - counts_.at_end()) : 0;
      missing = end * (1 - counts_.at_end());
    }
    row_.outside_sweep = beyond / (row_.recommended == By::function ? rate : rate + beyond);
    row_.outside_hazard = missing / (rate + missing);
    for (const auto& [share, what] : {std::pair(row_.outside_sweep, "outside of the sweep"),
                                      std::pair(row_.outside_hazard, "outside of the hazard curve")})
      if (share > outside_to_refuse && row_.refused.empty())
        row_.refused = fmt::format("{:.0f} % of the rate would come from intensities {}", 100 * share, what);
  }

  void split() {
    const double rate = row_.rate().value;
    double sum = 0;
    for (std::size_t i = 0; i + 1 < risk_.edge.size(); ++i) {
      const bool last = i + 2 == risk_.edge.size();
      const Range range{risk_.edge[i], last ? Range{}.to : risk_.edge[i + 1]};
      const double part =
          row_.recommended == By::function ? function_.rate(fragility(), range) : counts_.rate(counts_.weights(range));
      row_.share.push_back(part / rate);
      if (sum < 0.5 && sum + part / rate >= 0.5)
        row_.median_im = risk_.edge[i] * std::pow(risk_.edge[i + 1] / risk_.edge[i], (0.5 - sum) * rate / part);
      sum += part / rate;
    }
  }

  const Result& result_;
  const HazardCurve& hazard_;
  const Risk& risk_;
  const FragilityFunction& f_;
  const ByFunction function_;
  ByCounts counts_;
  const EdpResult& edp_;
  RiskRow row_;
};

// One sentence a cause, with all that it concerns.
void warn(Risk& risk, const HazardCurve& hazard, double RiskRow::*share, const std::string& what) {
  std::string concerned;
  for (const RiskRow& row : risk.rows)
    if (row.refused.empty() && row.*share > outside_to_warn_of)
      concerned += fmt::format("{}{} ({:.0f} %)", concerned.empty() ? "" : ", ", title(row), 100 * (row.*share));
  if (concerned.empty()) return;
  risk.warnings.push_back(fmt::format("{}: {} (swept {:.3g} to {:.3g}, hazard curve {:.3g} to {:.3g} {})", what,
                                      concerned, risk.im_least, risk.im_most, hazard.first(), hazard.last(),
                                      risk.im_unit));
}

}  // namespace

std::string title(const RiskRow& row) {
  if (std::isnan(row.capacity)) return row.edp;
  return fmt::format("{} > {}{}", row.edp, row.capacity, row.unit == "1" ? "" : " " + row.unit);
}

Risk risk(const Result& result, const HazardCurve& hazard) {
  Risk found;
  found.im = result.im_name;
  found.im_unit = result.im_unit;
  found.confidence = result.confidence;
  found.im_least = result.overturning.im_least;
  found.im_most = result.overturning.im_most;
  if (!(found.im_least < hazard.last()) || !(hazard.first() < found.im_most))
    throw Error(fmt::format(
        "the hazard curve ({:.3g} to {:.3g}) and the sweep ({:.3g} to {:.3g} {}) share no intensity: is the "
        "curve in {}?",
        hazard.first(), hazard.last(), found.im_least, found.im_most, found.im_unit, found.im_unit));
  for (int i = 0; i <= intervals; ++i)
    found.edge.push_back(hazard.first() * std::pow(hazard.last() / hazard.first(), i / static_cast<double>(intervals)));
  const FragilityFunction none;
  for (const EdpResult& edp : result.edps)
    for (std::size_t c = 0; c < edp.capacity.size(); ++c)
      found.rows.push_back(Row(result, hazard, edp, c, edp.functions.empty() ? none : edp.functions[c], found)());
  for (const RiskRow& row : found.rows)
    if (!row.refused.empty())
      found.warnings.push_back(fmt::format("{}: no rate is told: {}", title(row), row.refused));
    else if (row.rate().value == 0)
      found.warnings.push_back(fmt::format(
          "{}: no sample exceeds it; as far as the sweep reaches, up to {:.3g} {}, the rate is at most {:.2g} a year",
          title(row), found.im_most, found.im_unit, row.rate().upper));
  warn(found, hazard, &RiskRow::outside_sweep,
       "much of the rate comes from a fragility that is extrapolated beyond the sweep");
  warn(found, hazard, &RiskRow::outside_hazard,
       "much of the rate may come from intensities that the hazard curve does not reach");
  return found;
}

}  // namespace freestand::decision
