#include "fragility/ranking.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "fragility/jackknife.hpp"
#include "fragility/normal.hpp"
#include "fragility/probit.hpp"

namespace freestand::fragility {
namespace {

// Of so many folds a standard error is within a factor of two of the true one in nine cases of ten: its square goes as chi^2 of
// folds - 1 degrees of freedom, over these.
constexpr std::size_t least_folds = 5;
// With so many events on either side the curve's one slope is biased by a tenth [Peduzzi et al., J. Clin. Epidemiol. 49 (1996); by
// simulation in tests/fragility/ranking_test.cpp].
constexpr int least_hits = 10;
// A line through fewer leaves nothing for its error; with n of them Student's t of n - 2 degrees of freedom says what they prove.
constexpr int least_motions = 3;

// Sums of x, y over a set of samples, as reals.
struct Sums {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;

  void add(const Sums& other, double sign) {
    n += sign * other.n;
    x += sign * other.x;
    y += sign * other.y;
    xx += sign * other.xx;
    xy += sign * other.xy;
    yy += sign * other.yy;
  }
};

// y = intercept + slope x, and the standard deviation about it.
struct Line {
  double intercept = unknown, slope = unknown, scatter = unknown;
};

Line line_of(const Sums& s) {
  if (s.n < 3) return {};
  const double sxx = s.xx - s.x * s.x / s.n, sxy = s.xy - s.x * s.y / s.n, syy = s.yy - s.y * s.y / s.n;
  if (!(sxx > 0)) return {};
  const double slope = sxy / sxx;
  return {(s.y - slope * s.x) / s.n, slope, std::sqrt(std::max(0.0, syy - slope * sxy) / (s.n - 2))};
}

// A figure of all samples and of all but one fold, for each fold that has samples.
struct Jackknifed {
  double all = unknown;
  std::vector<double> without;  // [fold], NaN where the fold is empty
};

// Standard error of what `of` makes of the figures.
template <class Of>
double error_of(std::size_t folds, const Of& of) {
  std::vector<double> values;
  for (std::size_t f = 0; f < folds; ++f)
    if (const double value = of(f); std::isfinite(value)) values.push_back(value);
  return values.size() < least_folds ? unknown : std::sqrt(jackknife_variance(values));
}

std::vector<Sums> sums_by_fold(const RankingTally& tally, std::size_t e, std::size_t k) {
  std::vector<Sums> folds(RankingTally::folds);
  std::vector<ExactSum> x(RankingTally::folds), y(RankingTally::folds);
  for (std::size_t unit = 0; unit < tally.units(); ++unit) {
    const RankingTally::First& first = tally.first(e, k, unit);
    const std::size_t fold = tally.fold_of_unit(unit);
    folds[fold].n += static_cast<double>(first.n);
    x[fold].add(first.x);
    y[fold].add(first.y);
  }
  for (std::size_t f = 0; f < RankingTally::folds; ++f) {
    const RankingTally::Second& second = tally.second(e, k, f);
    folds[f] = {folds[f].n, x[f].value(), y[f].value(), second.xx.value(), second.xy.value(), second.yy.value()};
  }
  return folds;
}

struct Efficiency {
  Line line;
  std::int64_t samples = 0;
  Jackknifed scatter;
};

Efficiency efficiency(const RankingTally& tally, std::size_t e, std::size_t k) {
  const std::vector<Sums> folds = sums_by_fold(tally, e, k);
  Sums all;
  for (const Sums& fold : folds) all.add(fold, 1);
  Efficiency result{line_of(all), static_cast<std::int64_t>(all.n), {}};
  result.scatter.all = result.line.scatter;
  for (const Sums& fold : folds) {
    Sums rest = all;
    rest.add(fold, -1);
    result.scatter.without.push_back(fold.n > 0 ? line_of(rest).scatter : unknown);
  }
  return result;
}

// Slope of a line through points, its standard error and Student's two-sided p.
Sufficiency slope_test(const std::string& property, const std::vector<double>& z,
                       const std::vector<double>& remainder) {
  Sufficiency result{property, static_cast<int>(z.size())};
  const auto n = static_cast<double>(z.size());
  if (result.motions < least_motions) return result;
  Sums s;
  for (std::size_t i = 0; i < z.size(); ++i)
    s.add({1, z[i], remainder[i], z[i] * z[i], z[i] * remainder[i], remainder[i] * remainder[i]}, 1);
  const Line line = line_of(s);
  const double spread = s.xx - s.x * s.x / n;
  if (!(spread > 1e-12 * s.xx) || !(line.scatter > 0)) return result;  // all alike: nothing to depend on
  result.slope = line.slope;
  result.slope_se = line.scatter / std::sqrt(spread);
  result.p = 2 * gsl_cdf_tdist_Q(std::abs(result.slope / result.slope_se), n - 2);
  return result;
}

// Of records: the mean remainder of each group over the group's mean property.
Sufficiency of_records(const RankingTally& tally, const MotionProperty& property, std::size_t e, std::size_t k,
                       const Line& line) {
  std::vector<double> sum(tally.record_units(), 0), known(tally.record_units(), 0);
  for (std::size_t motion = 0; motion < property.value.size(); ++motion) {
    const double value = property.logarithm ? std::log(property.value[motion]) : property.value[motion];
    if (tally.options().motion_group[motion] < 0 || !std::isfinite(value)) continue;
    sum[tally.unit_of_motion(motion)] += value;
    ++known[tally.unit_of_motion(motion)];
  }
  std::vector<double> z, remainder;
  for (std::size_t unit = 0; unit < tally.record_units(); ++unit) {
    const RankingTally::First& first = tally.first(e, k, unit);
    if (known[unit] == 0 || first.n == 0) continue;
    z.push_back(sum[unit] / known[unit]);
    remainder.push_back((first.y.value() - line.slope * first.x.value()) / static_cast<double>(first.n) -
                        line.intercept);
  }
  return slope_test(property.name, z, remainder);
}

// Of pulses, where each sample is a motion: from the sums alone.
Sufficiency of_pulses(const RankingTally& tally, const MotionProperty& property, std::size_t e, std::size_t k,
                      const Line& line) {
  const RankingTally::WithPeriod& w = tally.with_period(e, k);
  const auto n = static_cast<double>(w.n);
  Sufficiency result{property.name, static_cast<int>(std::min<std::int64_t>(w.n, 2'000'000'000))};
  if (w.n < least_motions) return result;
  const double a = line.intercept, b = line.slope, x = w.x.value(), y = w.y.value(), z = w.z.value();
  const double r = y - a * n - b * x;  // sums of the remainder r, and of its products
  const double rz = w.yz.value() - a * z - b * w.xz.value();
  const double rr = w.yy.value() - 2 * a * y - 2 * b * w.xy.value() + a * a * n + 2 * a * b * x + b * b * w.xx.value();
  const double spread = w.zz.value() - z * z / n;
  const Line left = line_of({n, z, r, w.zz.value(), rz, rr});
  if (!(spread > 1e-9 * n) || !(left.scatter > 0)) return result;
  result.slope = left.slope;
  result.slope_se = left.scatter / std::sqrt(spread);
  result.p = 2 * gsl_cdf_tdist_Q(std::abs(result.slope / result.slope_se), n - 2);
  return result;
}

// Share of the deviance that a lognormal curve over IM explains; NaN where there is no curve.
double deviance_explained(const std::vector<ProbitPoint>& points, ProbitFit& start) {
  double n = 0, hits = 0;
  for (const ProbitPoint& point : points) {
    n += point.n;
    hits += point.hits;
  }
  const ProbitFit fit = fit_probit(points, start);
  if (!std::isfinite(fit.a)) return unknown;
  start = fit;
  double curve = 0;
  for (const ProbitPoint& point : points) {
    const double eta = fit.a + fit.b * std::log(point.im);
    if (point.hits > 0) curve += point.hits * std::log(std::max(normal_cdf(eta), 1e-300));
    if (point.hits < point.n) curve += (point.n - point.hits) * std::log(std::max(normal_cdf(-eta), 1e-300));
  }
  const double none = hits * std::log(hits / n) + (n - hits) * std::log(1 - hits / n);
  return 1 - curve / none;
}

// P that of a sample to which it happened and one to which not the first has the higher IM; half of those in one cell.
double parts(const std::vector<ProbitPoint>& points) {
  double hits = 0, misses = 0, ordered = 0;
  for (const ProbitPoint& point : points) {
    ordered += point.hits * (misses + 0.5 * (point.n - point.hits));
    hits += point.hits;
    misses += point.n - point.hits;
  }
  return ordered / (hits * misses);
}

struct Parting {
  std::int64_t samples = 0, hits = 0;
  double parts = unknown;
  Jackknifed explained;
};

Parting parting(const RankingTally& tally, std::size_t e, std::size_t k) {
  const auto points_without = [&](std::optional<std::size_t> left_out) {
    std::vector<ProbitPoint> points;
    for (std::size_t i = 0; i < RankingTally::cells; ++i) {
      ProbitPoint point{RankingTally::im_of_cell(i), 0, 0};
      for (std::size_t f = 0; f < RankingTally::folds; ++f) {
        if (left_out == f) continue;
        point.n += static_cast<double>(tally.cell(e, k, f, i).n);
        point.hits += static_cast<double>(tally.cell(e, k, f, i).hits);
      }
      if (point.n > 0) points.push_back(point);
    }
    return points;
  };
  Parting result;
  const std::vector<ProbitPoint> all = points_without({});
  for (const ProbitPoint& point : all) {
    result.samples += static_cast<std::int64_t>(point.n);
    result.hits += static_cast<std::int64_t>(point.hits);
  }
  if (std::min(result.hits, result.samples - result.hits) < least_hits) return result;
  ProbitFit start;
  result.parts = parts(all);
  result.explained.all = deviance_explained(all, start);
  for (std::size_t f = 0; f < RankingTally::folds; ++f) {
    bool there = false;
    for (std::size_t i = 0; i < RankingTally::cells; ++i) there = there || tally.cell(e, k, f, i).n > 0;
    ProbitFit near = start;
    result.explained.without.push_back(there ? deviance_explained(points_without(f), near) : unknown);
  }
  return result;
}

// Sorts the best first and tells how far each other is behind.
void order(RankedDemand& demand, std::vector<Jackknifed> figures) {
  std::vector<std::size_t> place(demand.ims.size());
  for (std::size_t i = 0; i < place.size(); ++i) place[i] = i;
  const double better = demand.binary ? -1 : 1;
  std::stable_sort(place.begin(), place.end(), [&](std::size_t a, std::size_t b) {
    const bool known_a = std::isfinite(figures[a].all), known_b = std::isfinite(figures[b].all);
    return known_a != known_b ? known_a : known_a && better * figures[a].all < better * figures[b].all;
  });
  const Jackknifed& best = figures[place.front()];
  std::vector<RankedIm> sorted;
  for (const std::size_t i : place) {
    RankedIm& im = sorted.emplace_back(std::move(demand.ims[i]));
    im.value = figures[i].all;
    im.value_se = error_of(figures[i].without.size(), [&](std::size_t f) { return figures[i].without[f]; });
    im.behind = better * (figures[i].all - best.all) + 0.0;  // no -0
    im.behind_se = i == place.front() ? 0 : error_of(figures[i].without.size(), [&](std::size_t f) {
      return figures[i].without[f] - best.without[f];
    });
  }
  demand.ims = std::move(sorted);
}

}  // namespace

std::vector<RankedDemand> rank(const RankingTally& tally) {
  std::vector<RankedDemand> ranked;
  const RankingOptions& options = tally.options();
  for (std::size_t e = 0; e < options.edps.size(); ++e) {
    RankedDemand demand{options.edps[e].name, options.edps[e].binary, {}};
    std::vector<Jackknifed> figures;
    for (std::size_t k = 0; k < options.ims.size(); ++k) {
      RankedIm im{options.ims[k]};
      if (demand.binary) {
        Parting found = parting(tally, e, k);
        im.samples = found.samples;
        im.parts = found.parts;
        figures.push_back(std::move(found.explained));
      } else {
        Efficiency found = efficiency(tally, e, k);
        im.samples = found.samples;
        im.slope = found.line.slope;
        if (std::isfinite(im.slope))
          for (const MotionProperty& property : options.properties)
            im.sufficiency.push_back(property.of_pulses ? of_pulses(tally, property, e, k, found.line)
                                                        : of_records(tally, property, e, k, found.line));
        figures.push_back(std::move(found.scatter));
      }
      demand.ims.push_back(std::move(im));
    }
    order(demand, std::move(figures));
    const auto has_error = [](const RankedIm& im) { return std::isfinite(im.value_se); };
    if (std::any_of(demand.ims.begin(), demand.ims.end(), has_error)) ranked.push_back(std::move(demand));
  }
  return ranked;
}

}  // namespace freestand::fragility
