#include "decision/risk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <limits>
#include <optional>

#include "decision/annual_rate.hpp"
#include "decision/by_counts.hpp"
#include "fragility/fragility_function.hpp"

namespace freestand::decision {
namespace {

using fragility::EdpResult;
using fragility::FragilityFunction;
using fragility::Result;
using fragility::unknown;

constexpr int intervals = 24;

// The hazard curve, with a point before its first one that goes on by its slope down to `im`, or as far as that leads to no more
// than once an hour.
HazardCurve begun_earlier(const HazardCurve& hazard, double im) {
  const double slope = hazard.slope(1);
  if (slope < 0) im = std::max(im, hazard.first() * std::pow(once_an_hour / hazard.annual_rate[0], 1 / slope));
  if (!(im < hazard.first())) return hazard;
  HazardCurve longer{hazard.measure, hazard.period_s, {im}, {hazard.rate(im)}};
  longer.im.insert(longer.im.end(), hazard.im.begin(), hazard.im.end());
  longer.annual_rate.insert(longer.annual_rate.end(), hazard.annual_rate.begin(), hazard.annual_rate.end());
  return longer;
}

// Events above the hazard curve's end are as many as it has there, and as likely to exceed as there.
struct ByFunction {
  const HazardCurve& hazard;
  std::vector<HazardPiece> whole = pieces(hazard);

  double rate(const LognormalFragility& f) const {
    return annual_rate(whole, f) + hazard.annual_rate.back() * f(hazard.last());
  }
  double rate(const LognormalFragility& f, const Range& range) const {
    const double tail = range.to > hazard.last() ? hazard.annual_rate.back() * f(hazard.last()) : 0;
    return annual_rate(hazard, f, range) + tail;
  }
};

// Motions of which nothing exceeded have no curve: they count as no rate.
Rate banded(const Result& result, const FragilityFunction& f, const ByFunction& by, const CurveReach& curve) {
  const auto rates = [&](const std::vector<double>& median, const std::vector<double>& dispersion) {
    std::vector<double> found;
    for (std::size_t i = 0; i < median.size(); ++i) {
      const double rate = by.rate({median[i], dispersion[i]});
      found.push_back(std::isfinite(rate) ? rate : 0);
    }
    return found;
  };
  const double value = by.rate({f.median, f.dispersion}), tail = (1 - result.confidence) / 2;
  const RateLimits limits(value, rates(f.left_out_median, f.left_out_dispersion),
                          rates(f.resampled_median, f.resampled_dispersion), result, curve);
  return {value, limits.lower(tail), limits.upper(tail)};
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
        counts_(hazard, result, edp, c, f, {risk.im_least, risk.im_most}),
        edp_(edp),
        capacity_(c) {
    row_.edp = edp.name;
    row_.unit = edp.unit;
    if (!edp.binary) row_.capacity = edp.capacity[c];
  }

  RiskRow operator()() {
    const CurveReach curve(f_, result_, [this](const LognormalFragility& f) { return function_.rate(f); });
    row_.by_function = banded(result_, f_, function_, curve);
    if (!counts_.empty()) row_.by_counts = counts_.banded(curve);
    recommend();
    outside(curve);
    if (row_.refused.empty() && row_.rate().value > 0) split();
    return std::move(row_);
  }

 private:
  LognormalFragility fragility() const { return {f_.median, f_.dispersion}; }

  void recommend() {
    const bool function = std::isfinite(row_.by_function.value), counts = std::isfinite(row_.by_counts.value);
    const bool agree = function && f_.adequate;
    row_.recommended = function && (agree || !counts) ? By::function : By::counts;
    if (!function && !counts)
      row_.refused = "no bin has enough samples, and no curve could be fitted";
    else if (!function)
      row_.why = "no curve could be fitted (nothing exceeds, everything does, or it does not grow with the intensity)";
    else if (agree)
      row_.why = fmt::format("the fitted curve is adequate: off the counted shares by at most {:.2g}{}", f_.off_by,
                             std::isnan(f_.rate_p) ? "" : ", and its rates are theirs");
    else if (!counts)
      row_.why = "no bin has enough samples";
    else if (rates_differ(f_)) {
      row_.why = fmt::format(
          "the fitted curve may be off the counted shares by up to {:.2g}, and its rates are not those of the counts",
          f_.off_by);
      row_.rates_differ = true;
    } else
      row_.why = fmt::format("the fitted curve may be off the counted shares by up to {:.2g}", f_.off_by);
    if (row_.recommended == By::counts && counts_.bounded_by_others())
      row_.why +=
          "; where no sample exceeds it the upper limit of P is the least of those there and at higher intensities "
          "(and "
          "where all do the lower limit alike), since P is taken not to fall as the intensity rises";
    if (row_.recommended == By::counts && 2 * counts_.upper_if_falling() < row_.by_counts.upper) {
      row_.upper_if_falling = counts_.upper_if_falling();
      row_.why += fmt::format(
          "; the upper limit is that of the lowest intensities, at which nothing exceeded it; if P falls there as the "
          "fitted curve does, it is {:.2g} a year",
          row_.upper_if_falling);
    }
  }

  // What the recommended curve gives before the hazard curve's start, or, where nothing exceeds, what it may; `longer` begins before it.
  double before_start(const HazardCurve& longer, bool nothing, const CurveReach& curve) const {
    const Range before{0, hazard_.first()};
    if (row_.recommended == By::function) return annual_rate(longer, fragility(), before);
    if (!(risk_.im_least < hazard_.first()))
      return counts_.rate_below(longer, before);  // none of the sweep lies before it
    ByCounts counts(longer, result_, edp_, capacity_, f_, {risk_.im_least, risk_.im_most});
    if (nothing) return std::max(0.0, counts.banded(curve).upper - row_.rate().upper);
    return std::max(0.0, counts.rate(before)) + counts.rate_below(longer, {0, risk_.im_least});
  }

  void outside(const CurveReach& curve) {
    const bool function = row_.recommended == By::function;
    if (!function && counts_.empty()) return;
    // Of a demand that no sample exceeds the upper limit stands for the rate: it is all that is told.
    const bool nothing = !(row_.rate().value > 0) && counts_.nothing_counted();
    const double rate = nothing ? row_.rate().upper : row_.rate().value, end = hazard_.annual_rate.back();
    const HazardCurve longer = begun_earlier(hazard_, std::min(hazard_.first(), risk_.im_least) / 100);
    double beyond = 0, missing = before_start(longer, nothing, curve);
    if (function) {
      beyond = annual_rate(hazard_, fragility(), {0, risk_.im_least});
      if (hazard_.last() > risk_.im_most) beyond += function_.rate(fragility(), {risk_.im_most, Range{}.to});
      missing += end * (1 - fragility()(hazard_.last()));
    } else {
      beyond = counts_.rate_below(hazard_, {0, risk_.im_least});
      if (hazard_.last() > risk_.im_most) beyond += hazard_.rate(risk_.im_most) * counts_.unknown_above(risk_.im_most);
      missing += end * counts_.unknown_above(hazard_.last());
    }
    row_.outside_sweep = function ? beyond / rate : rate + beyond > 0 ? beyond / (rate + beyond) : 0;
    row_.outside_hazard = rate + missing > 0 ? missing / (rate + missing) : 0;
    for (const auto& [share, what] : {std::pair(row_.outside_sweep, "outside of the sweep"),
                                      std::pair(row_.outside_hazard, "outside of the hazard curve")})
      if (share > outside_to_refuse && row_.refused.empty())
        row_.refused =
            nothing
                ? fmt::format(
                      "no sample exceeds it, and {:.0f} % of what its rate may at most be comes from intensities {}",
                      100 * share, what)
                : fmt::format("{:.0f} % of the rate may come from intensities {}", 100 * share, what);
  }

  double recommended_rate(const Range& range) const {
    return row_.recommended == By::function ? function_.rate(fragility(), range) : counts_.rate(range);
  }

  void split() {
    const double rate = row_.rate().value;
    double sum = 0;
    row_.median_im = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < risk_.edge.size(); ++i) {
      const bool last = i + 2 == risk_.edge.size();
      const double from = risk_.edge[i], to = last ? hazard_.last() : risk_.edge[i + 1];
      const double within = recommended_rate({from, to}) / rate;
      if (sum < 0.5 && sum + within >= 0.5) row_.median_im = from * std::pow(to / from, (0.5 - sum) / within);
      row_.share.push_back(last ? recommended_rate({from, Range{}.to}) / rate : within);
      sum += within;
    }
  }

  const Result& result_;
  const HazardCurve& hazard_;
  const Risk& risk_;
  const FragilityFunction& f_;
  const ByFunction function_;
  ByCounts counts_;
  const EdpResult& edp_;
  const std::size_t capacity_;
  RiskRow row_;
};

bool happens_within(const RiskRow& inner, const RiskRow& outer, const std::vector<std::string>& with_overturned) {
  if (inner.edp == outer.edp) return inner.capacity > outer.capacity;
  return inner.edp == "overturned" &&
         std::find(with_overturned.begin(), with_overturned.end(), outer.edp) != with_overturned.end();
}

// Limits by those of events that hold or are held. A limit that would pass the value itself is none. Curves of their own may give what is held
// more events than what holds it: it has as many.
void put_in_order(std::vector<RiskRow>& rows, const std::vector<std::string>& with_overturned) {
  const std::vector<RiskRow> own = rows;
  for (RiskRow& row : rows) {
    Rate& rate = row.recommended == By::function ? row.by_function : row.by_counts;
    const RiskRow* bound = nullptr;
    for (const RiskRow& other : own) {
      if (!row.refused.empty() || !other.refused.empty()) continue;
      const Rate& beside = other.rate();
      if (happens_within(row, other, with_overturned) && beside.upper < rate.upper && beside.upper >= rate.value) {
        rate.upper = beside.upper;
        bound = &other;
      }
      if (happens_within(other, row, with_overturned) && beside.lower > rate.lower && beside.lower <= rate.value)
        rate.lower = beside.lower;
    }
    if (bound)
      row.why += fmt::format("; its upper limit is that of {}, which holds whenever this happens", title(*bound));
    bound = nullptr;
    for (const RiskRow& other : own)
      if (row.refused.empty() && other.refused.empty() && happens_within(row, other, with_overturned) &&
          other.rate().value < rate.value) {
        rate.value = other.rate().value;
        bound = &other;
      }
    rate.lower = std::min(rate.lower, rate.value);
    if (bound)
      row.why +=
          fmt::format("; its rate is that of {}, which holds whenever this happens, and came out lower", title(*bound));
  }
}

// One sentence a cause, with all that it concerns.
void warn(Risk& risk, const HazardCurve& hazard, double RiskRow::*share, const std::string& what,
          std::optional<By> by = {}) {
  std::string concerned;
  for (const RiskRow& row : risk.rows)
    if (row.refused.empty() && row.*share > outside_to_warn_of && (!by || row.recommended == *by))
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

Risk risk(const Result& result, const HazardCurve& hazard, const std::vector<std::string>& with_overturned) {
  Risk found;
  found.im = result.im_name;
  found.im_unit = result.im_unit;
  found.confidence = result.confidence;
  found.im_least = result.overturning.im_least;
  found.im_most = result.overturning.im_most;
  if (std::isnan(found.im_least))
    throw Error(
        "no sample of the sweep lies in a bin of intensity (all are outside of the bins): fit it with other bins");
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
  put_in_order(found.rows, with_overturned);
  for (const RiskRow& row : found.rows)
    if (!row.refused.empty())
      found.warnings.push_back(fmt::format("{}: no rate is told: {}", title(row), row.refused));
    else if (row.rate().value == 0)
      found.warnings.push_back(fmt::format(
          "{}: no sample exceeds it; as far as the sweep reaches, up to {:.3g} {}, the rate is at most {:.2g} a year",
          title(row), found.im_most, found.im_unit, row.rate().upper));
  for (const RiskRow& row : found.rows)
    if (row.rates_differ && row.refused.empty())
      found.warnings.push_back(
          fmt::format("{}: the fitted curve gives {:.3g} a year where the counts give {:.3g}; where shares are small "
                      "it is not theirs, by more than chance explains: the counts are taken",
                      title(row), row.by_function.value, row.by_counts.value));
  warn(found, hazard, &RiskRow::outside_sweep,
       "much of the rate comes from a fragility that is extrapolated beyond the sweep", By::function);
  warn(
      found, hazard, &RiskRow::outside_sweep,
      "much may be missing from the rate, which goes by counts over what was swept: sweep a wider range; of the whole, "
      "as its lowest shares fall and at most above it, about",
      By::counts);
  warn(found, hazard, &RiskRow::outside_hazard,
       "much of the rate may come from intensities that the hazard curve does not reach");
  return found;
}

}  // namespace freestand::decision
