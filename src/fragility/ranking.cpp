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
// Relative, of what sums leave.
constexpr double round_off = 1e-9;

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

// ln EDP = intercept + slope ln IM where IM > 0, and its mean where there is no logarithm.
struct Fitted {
  Line line;
  double mean = 0, scatter = unknown;
};

Fitted fitted(const Sums& with_im, const Sums& all) {
  Fitted found{line_of(with_im)};
  double squares = found.line.scatter * found.line.scatter * (with_im.n - 2), freedom = all.n - 2;
  Sums rest = all;
  rest.add(with_im, -1);
  if (rest.n > 0) {
    found.mean = rest.y / rest.n;
    squares += std::max(0.0, rest.yy - rest.y * found.mean);
    --freedom;
  }
  found.scatter = std::sqrt(squares / freedom);
  return found;
}

struct Efficiency {
  Fitted fit;
  std::int64_t samples = 0, with_im = 0;
  Jackknifed scatter;
};

Efficiency efficiency(const RankingTally& tally, std::size_t e, std::size_t k) {
  const std::vector<Sums> folds = sums_by_fold(tally, e, k), folds_of_all = sums_by_fold(tally, e, tally.any_im());
  Sums with_im, all;
  for (const Sums& fold : folds) with_im.add(fold, 1);
  for (const Sums& fold : folds_of_all) all.add(fold, 1);
  Efficiency result{fitted(with_im, all), static_cast<std::int64_t>(all.n), static_cast<std::int64_t>(with_im.n), {}};
  result.scatter.all = result.fit.scatter;
  for (std::size_t f = 0; f < folds.size(); ++f) {
    Sums left = with_im, left_of_all = all;
    left.add(folds[f], -1);
    left_of_all.add(folds_of_all[f], -1);
    result.scatter.without.push_back(folds_of_all[f].n > 0 ? fitted(left, left_of_all).scatter : unknown);
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
                       const Fitted& fit) {
  std::vector<double> sum(tally.record_units(), 0), known(tally.record_units(), 0);
  for (std::size_t motion = 0; motion < property.value.size(); ++motion) {
    const double value = property.logarithm ? std::log(property.value[motion]) : property.value[motion];
    if (tally.options().motion_group[motion] < 0 || !std::isfinite(value)) continue;
    sum[tally.unit_of_motion(motion)] += value;
    ++known[tally.unit_of_motion(motion)];
  }
  std::vector<double> z, remainder;
  for (std::size_t unit = 0; unit < tally.record_units(); ++unit) {
    const RankingTally::First &first = tally.first(e, k, unit), &all = tally.first(e, tally.any_im(), unit);
    if (known[unit] == 0 || all.n == 0) continue;
    z.push_back(sum[unit] / known[unit]);
    const double left = all.y.value() - fit.line.slope * first.x.value() -
                        fit.line.intercept * static_cast<double>(first.n) -
                        fit.mean * static_cast<double>(all.n - first.n);
    remainder.push_back(left / static_cast<double>(all.n));
  }
  return slope_test(property.name, z, remainder);
}

// Of pulses, where each sample is a motion: from the sums alone.
Sufficiency of_pulses(const RankingTally& tally, const MotionProperty& property, std::size_t e, std::size_t k,
                      const Fitted& fit) {
  const RankingTally::WithPeriod &w = tally.with_period(e, k), &all = tally.with_period(e, tally.any_im());
  const auto n = static_cast<double>(all.n), n_line = static_cast<double>(w.n), n_rest = n - n_line;
  Sufficiency result{property.name, static_cast<int>(std::min<std::int64_t>(all.n, 2'000'000'000))};
  if (all.n < least_motions) return result;
  const double a = fit.line.intercept, b = fit.line.slope, c = fit.mean;
  const double x = w.x.value(), y = w.y.value(), y_rest = all.y.value() - y, z = all.z.value();
  // Sums of the remainder r, and of its products.
  const double r = y + y_rest - a * n_line - b * x - c * n_rest;
  const double rz = all.yz.value() - a * w.z.value() - b * w.xz.value() - c * (z - w.z.value());
  const double rr = all.yy.value() - 2 * a * y - 2 * b * w.xy.value() + a * a * n_line + 2 * a * b * x +
                    b * b * w.xx.value() - 2 * c * y_rest + c * c * n_rest;
  const double spread = all.zz.value() - z * z / n;
  const Line left = line_of({n, z, r, all.zz.value(), rz, rr});
  if (!(spread > 1e-9 * n) || !(left.scatter > 0)) return result;
  result.slope = left.slope;
  result.slope_se = left.scatter / std::sqrt(spread);
  result.p = 2 * gsl_cdf_tdist_Q(std::abs(result.slope / result.slope_se), n - 2);
  return result;
}

double log_likelihood(double n, double hits, double share) {
  const double yes = hits > 0 ? hits * std::log(std::max(share, 1e-300)) : 0;
  return yes + (hits < n ? (n - hits) * std::log(std::max(1 - share, 1e-300)) : 0);
}

// Share of the deviance that a lognormal curve over IM explains, and a share of its own where IM has no logarithm; NaN where there is
// no curve.
double deviance_explained(const std::vector<ProbitPoint>& points, ProbitFit& start) {
  double n = 0, hits = 0, left = 0;
  std::vector<ProbitPoint> with_im;
  for (const ProbitPoint& point : points) {
    n += point.n;
    hits += point.hits;
    if (point.im > 0)
      with_im.push_back(point);
    else
      left += log_likelihood(point.n, point.hits, point.hits / point.n);
  }
  const ProbitFit fit = fit_probit(with_im, start);
  if (!std::isfinite(fit.a)) return unknown;
  start = fit;
  for (const ProbitPoint& point : with_im)
    left += log_likelihood(point.n, point.hits, normal_cdf(fit.a + fit.b * std::log(point.im)));
  return 1 - left / log_likelihood(n, hits, hits / n);
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
  std::int64_t samples = 0, with_im = 0, hits = 0;
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
    if (point.im > 0) result.with_im += static_cast<std::int64_t>(point.n);
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
  // One that is another times a constant differs from it by round-off alone: of such the one that was given first is the best.
  const double least = figures[place.front()].all;
  const auto is_the_best = [&](std::size_t i) {
    return std::abs(figures[i].all - least) <= round_off * std::abs(least);
  };
  const auto behind = std::stable_partition(place.begin(), place.end(), is_the_best);
  std::sort(place.begin(), behind);
  const Jackknifed& best = figures[place.front()];
  std::vector<RankedIm> sorted;
  for (const std::size_t i : place) {
    RankedIm& im = sorted.emplace_back(std::move(demand.ims[i]));
    im.value = figures[i].all;
    im.value_se = error_of(figures[i].without.size(), [&](std::size_t f) { return figures[i].without[f]; });
    const bool equal = i == place.front() || is_the_best(i);
    im.behind = equal ? 0 : better * (figures[i].all - best.all);
    im.behind_se = equal ? 0 : error_of(figures[i].without.size(), [&](std::size_t f) {
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
        im.with_im = found.with_im;
        im.parts = found.parts;
        figures.push_back(std::move(found.explained));
      } else {
        Efficiency found = efficiency(tally, e, k);
        im.samples = found.samples;
        im.with_im = found.with_im;
        im.slope = found.fit.line.slope;
        if (std::isfinite(im.slope))
          for (const MotionProperty& property : options.properties)
            im.sufficiency.push_back(property.of_pulses ? of_pulses(tally, property, e, k, found.fit)
                                                        : of_records(tally, property, e, k, found.fit));
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
