#include "fragility/fragility_function.hpp"

#include <algorithm>
#include <cmath>

#include "fragility/goodness.hpp"
#include "fragility/intervals.hpp"
#include "fragility/probit.hpp"
#include "fragility/small_shares.hpp"

namespace freestand::fragility {
namespace {

// Straight between 81 points over a range R the curve errs by h^2/8 of its bend, h = R/80. The bend is at most 3/m^2 at dispersion 0.4 and
// 8/m^2 at 0.2, m the median: an error of 0.0015 and 0.004 where m is at 0.2 R, of 0.006 and 0.016 at 0.1 R, as wide as a line in a
// picture. Pictures and bands alone go by the grid: rates, exports and databases go by median and dispersion.
constexpr int grid_points = 81;

// Counts by fine cell of IM and by group of motions. Cells without samples are left out.
struct Cells {
  std::vector<double> im;          // mean of its samples
  std::vector<std::size_t> place;  // among all cells, those without samples too
  Eigen::MatrixXd n, above;        // [group, cell]
  std::size_t bin(std::size_t cell) const { return place[cell] / TallyLayout::cells_per_bin; }
};

// Samples and those above, of one cell and one group.
struct Share {
  std::int64_t n, above;
};

template <class ShareOf>
Cells cells_of(const Tally& tally, const ShareOf& share_of) {
  const auto groups = static_cast<Eigen::Index>(tally.layout().groups);
  const auto all = static_cast<Eigen::Index>(tally.layout().im_cell_count());
  Cells cells{{}, {}, Eigen::MatrixXd(groups, all), Eigen::MatrixXd(groups, all)};
  Eigen::Index used = 0;
  for (std::size_t i = 0; i < tally.layout().im_cell_count(); ++i) {
    const ImCell total = tally.im_cell(i);
    if (total.n == 0) continue;
    cells.im.push_back(total.im_sum / static_cast<double>(total.n));
    cells.place.push_back(i);
    for (Eigen::Index g = 0; g < groups; ++g) {
      const Share share = share_of(i, static_cast<std::size_t>(g));
      cells.n(g, used) = static_cast<double>(share.n);
      cells.above(g, used) = static_cast<double>(share.above);
    }
    ++used;
  }
  cells.n.conservativeResize(groups, used);
  cells.above.conservativeResize(groups, used);
  return cells;
}

std::vector<ProbitPoint> points_of(const std::vector<double>& im, const Eigen::RowVectorXd& n,
                                   const Eigen::RowVectorXd& above) {
  std::vector<ProbitPoint> points;
  for (Eigen::Index i = 0; i < n.size(); ++i)
    if (n(i) > 0 && im[static_cast<std::size_t>(i)] > 0)
      points.push_back({im[static_cast<std::size_t>(i)], n(i), above(i)});
  return points;
}

// A fitted curve, or 0 or 1 throughout where no sample, or every sample, lies above.
struct Shape {
  ProbitFit fit;
  double share = unknown;

  Shape(const std::vector<ProbitPoint>& points, const ProbitFit& start) : fit(fit_probit(points, start)) {
    double n = 0, above = 0;
    for (const auto& point : points) {
      n += point.n;
      above += point.hits;
    }
    if (above == 0 || above == n) share = above / n;
  }
  double operator()(double im) const { return std::isnan(share) ? probit_probability(fit, im) : im > 0 ? share : 0; }
};

// Counted share less the curve, by bin or by `parts` of each; NaN where one holds fewer samples than `least`.
std::vector<double> misfits(const Cells& cells, std::size_t bins, std::size_t parts, const Eigen::RowVectorXd& n,
                            const Eigen::RowVectorXd& above, const Shape& shape, double least) {
  std::vector<double> there(bins * parts, 0), difference(bins * parts, 0);
  for (Eigen::Index i = 0; i < n.size(); ++i) {
    const std::size_t cell = static_cast<std::size_t>(i);
    const std::size_t part = cells.place[cell] / (TallyLayout::cells_per_bin / parts);
    there[part] += n(i);
    difference[part] += above(i) - n(i) * shape(cells.im[cell]);
  }
  for (std::size_t p = 0; p < there.size(); ++p) difference[p] = there[p] >= least ? difference[p] / there[p] : unknown;
  return difference;
}

// The largest of |a - b| that is known, and where; {0, size} when none is.
struct Largest {
  double value = 0;
  std::size_t at;
};
Largest largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  Largest largest{0, a.size()};
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::fabs(a[i] - b[i]) >= largest.value) largest = {std::fabs(a[i] - b[i]), i};
  return largest;
}

// Half the width of the middle 68 % of resampled estimates, expanded for the number of groups G by sqrt(G/(G - 1)): a
// standard error that a few resamples in which overturning hardly grows with IM (any median may come out) do not spoil.
double standard_error(std::vector<double> values, int groups) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.size() < 2 || groups < 2) return unknown;
  std::sort(values.begin(), values.end());
  constexpr double below = 0.15865525393145707;  // Phi(-1)
  return 0.5 * (sorted_quantile(values, 1 - below) - sorted_quantile(values, below)) *
         std::sqrt(groups / (groups - 1.0));
}

// Equally spaced from the first positive edge (or a hundredth of the last) to the last edge.
std::vector<double> grid_of(const std::vector<double>& edge) {
  const auto positive = std::find_if(edge.begin(), edge.end(), [](double e) { return e > 0; });
  if (positive == edge.end()) return {};
  const double low = positive + 1 == edge.end() ? edge.back() / 100 : *positive;
  std::vector<double> grid;
  for (int i = 0; i < grid_points; ++i) grid.push_back(low + (edge.back() - low) * i / (grid_points - 1));
  return grid;
}

// What is known of the curve from resampled motions.
class Resampled {
 public:
  Resampled(const Tally& tally, const Cells& cells, const Shape& shape, const Resampling& resampling)
      : tally_(tally),
        cells_(cells),
        shape_(shape),
        n_(resampling.totals(cells.n)),
        above_(resampling.totals(cells.above)),
        n_left_(resampling.totals_left_out(cells.n)),
        above_left_(resampling.totals_left_out(cells.above)),
        left_out_records_(resampling.left_out_records()) {
    const std::vector<bool> there = tally.groups_with_samples();
    motions_ = static_cast<int>(std::count(there.begin(), there.end(), true));
    for (Eigen::Index r = 0; r < n_.rows(); ++r)
      shapes_.emplace_back(points_of(cells.im, n_.row(r), above_.row(r)), shape.fit);
    for (Eigen::Index i = 0; i < n_left_.rows(); ++i)
      left_out_.emplace_back(points_of(cells.im, n_left_.row(i), above_left_.row(i)), shape.fit);
  }

  void errors(FragilityFunction& curve) const {
    std::vector<double> median, dispersion;
    for (const Shape& shape : shapes_) {
      median.push_back(shape.fit.median);
      dispersion.push_back(shape.fit.dispersion);
    }
    curve.median_se = standard_error(median, motions_);
    curve.dispersion_se = standard_error(dispersion, motions_);
    curve.resampled_median = std::move(median);
    curve.resampled_dispersion = std::move(dispersion);
    for (const Shape& shape : left_out_) {
      curve.left_out_median.push_back(shape.fit.median);
      curve.left_out_dispersion.push_back(shape.fit.dispersion);
    }
  }

  void band(FragilityFunction& curve) const {
    for (std::size_t i = 0; i < curve.grid.size(); ++i) {
      std::vector<double> values;
      for (const Shape& shape : shapes_) values.push_back(shape(curve.grid[i]));
      curve.probability[i] = shape_(curve.grid[i]);
      const Interval band = percentile_interval(values, curve.probability[i], tally_.options().confidence, motions_);
      curve.lower[i] = band.lower;
      curve.upper[i] = band.upper;
    }
  }

  // Up to eight cells a bin: what a bin alone does not tell, and a curve that may be off tells wrongly, how its probability grows within it.
  // Cells are joined until the standard error of a share, 0.5/sqrt(n) at most, is no more than a curve may be off, and a bin of as many
  // samples would be told. A curve that is merely not refuted keeps its own growth where that leaves fewer than two cells a bin: wider ones
  // see nothing of a bin's inside.
  void shares_of_cells(FragilityFunction& curve) const {
    if (curve.adequate) return;
    const double enough =
        std::max(std::pow(0.5 / tally_.options().adequate, 2), static_cast<double>(tally_.options().minimum_samples));
    std::vector<double> joined_im, joined_n;
    std::vector<std::vector<Eigen::Index>> joined(1);
    double n = 0, im = 0;
    for (Eigen::Index i = 0; i < cells_.n.cols(); ++i) {
      const double here = cells_.n.col(i).sum(), at = cells_.im[static_cast<std::size_t>(i)];
      if (!(at > 0)) continue;
      joined.back().push_back(i);
      n += here, im += here * at;
      if (n < enough) continue;
      joined_im.push_back(im / n);
      joined_n.push_back(n);
      joined.emplace_back();
      n = im = 0;
    }
    joined.pop_back();  // too few
    if (not_refuted(curve) && joined.size() < 2 * tally_.layout().bins) return;
    curve.cell_im = std::move(joined_im);
    curve.cell_n = std::move(joined_n);
    curve.cell_share = shares(joined, cells_.n.colwise().sum(), cells_.above.colwise().sum(), {});
    const auto again = [&](const Eigen::MatrixXd& of_n, const Eigen::MatrixXd& of_above, std::vector<double>& all) {
      for (Eigen::Index r = 0; r < of_n.rows(); ++r) {
        const std::vector<double> one = shares(joined, of_n.row(r), of_above.row(r), curve.cell_share);
        all.insert(all.end(), one.begin(), one.end());
      }
    };
    again(n_, above_, curve.resampled_cell_share);
    again(n_left_, above_left_, curve.left_out_cell_share);
  }

  // Of joined cells; `otherwise` where none has a sample.
  static std::vector<double> shares(const std::vector<std::vector<Eigen::Index>>& joined, const Eigen::RowVectorXd& n,
                                    const Eigen::RowVectorXd& above, const std::vector<double>& otherwise) {
    std::vector<double> share;
    for (const std::vector<Eigen::Index>& cells : joined) {
      double of = 0, all = 0;
      for (const Eigen::Index i : cells) of += above[i], all += n[i];
      share.push_back(all > 0 ? of / all : otherwise[share.size()]);
    }
    return share;
  }

  // The shares of bins say how far the curve may be off. Where it bends in another way within them, and their halves, quarters or eighths
  // show it, off by more than a curve may be and by more than chance explains (in three looks), it is off by what those show.
  void misfit(FragilityFunction& curve) const {
    const Misfit of_bins = misfit_of(1);
    if (std::isnan(of_bins.im)) return;
    Misfit worst = of_bins;
    for (std::size_t parts = 2; parts <= TallyLayout::cells_per_bin && motions_ > 1; parts *= 2)
      if (Misfit of = misfit_of(parts);
          of.size > std::max(worst.size, tally_.options().adequate) && of.chance() <= test_level / 3)
        worst = std::move(of);
    curve.misfit = worst.size;
    curve.misfit_im = worst.im;
    if (motions_ < 2) return;
    curve.misfit_p = worst.chance();
    // Through the shares of two bins there is a lognormal always, which tells nothing of others.
    const auto known =
        std::count_if(of_bins.found.begin(), of_bins.found.end(), [](double d) { return std::isfinite(d); });
    if (known > 2) curve.off_by = std::min(1.0, std::max(of_bins.at_most(), worst.at_most()));
    curve.rate_p = chance_of_small_shares(small_shares(of_bins.found));
    curve.adequate = curve.off_by <= tally_.options().adequate && !rates_differ(curve);
  }

 private:
  // Of bins, or of parts of them.
  struct Misfit {
    std::vector<double> found;         // counted share less the curve
    double size = 0, im = unknown;     // the largest, and where
    std::vector<double> scatter = {};  // of the largest, [resample]
    double reach = 0;                  // of the scatter, at Options::confidence
    double at_most() const { return size + reach; }
    // Of a larger one if the curve were true.
    double chance() const {
      const auto larger = std::count_if(scatter.begin(), scatter.end(), [&](double one) { return one >= size; });
      return (1.0 + static_cast<double>(larger)) / (1.0 + static_cast<double>(scatter.size()));
    }
  };

  // The resampled misfits scatter about those of the samples as those do about the true ones.
  Misfit misfit_of(std::size_t parts) const {
    const std::size_t bins = tally_.layout().bins;
    Misfit of{misfits(cells_, bins, parts, cells_.n.colwise().sum(), cells_.above.colwise().sum(), shape_,
                      tally_.options().minimum_samples)};
    const auto [size, part] = largest_difference(of.found, std::vector<double>(of.found.size(), 0));
    if (part == of.found.size()) return of;
    of.size = size;
    of.im = mean_im(part, parts);
    const double expand = std::sqrt(motions_ / (motions_ - 1.0));
    for (Eigen::Index r = 0; r < n_.rows() && motions_ > 1; ++r) {
      const auto again =
          misfits(cells_, bins, parts, n_.row(r), above_.row(r), shapes_[static_cast<std::size_t>(r)], 1);
      of.scatter.push_back(expand * largest_difference(again, of.found).value);
    }
    std::vector<double> sorted = of.scatter;
    std::sort(sorted.begin(), sorted.end());
    if (!sorted.empty()) of.reach = sorted_quantile(sorted, tally_.options().confidence);
    return of;
  }

  double mean_im(std::size_t part, std::size_t parts) const {
    double n = 0, im = 0;
    for (std::size_t cell = 0; cell < cells_.im.size(); ++cell) {
      if (cells_.place[cell] / (TallyLayout::cells_per_bin / parts) != part) continue;
      const double here = cells_.n.col(static_cast<Eigen::Index>(cell)).sum();
      n += here;
      im += here * cells_.im[cell];
    }
    return im / n;
  }

  SmallShares small_shares(const std::vector<double>& found) const {
    const std::size_t bins = tally_.layout().bins;
    SmallShares small{
        {},       std::vector<double>(bins, 0), found, std::vector<double>(bins, 0), {}, left_out_records_, 1,
        motions_, tally_.options().adequate};
    double binomial = 0;
    Eigen::VectorXd left = Eigen::VectorXd::Zero(cells_.n.rows());  // [group], counted less expected
    for (Eigen::Index i = 0; i < cells_.n.cols(); ++i) {
      const std::size_t cell = static_cast<std::size_t>(i), bin = cells_.bin(cell);
      const double p = shape_(cells_.im[cell]), n = cells_.n.col(i).sum();
      small.fitted[bin] += n * p;
      small.samples[bin] += n;
      left += cells_.above.col(i) - p * cells_.n.col(i);
      binomial += n * p * (1 - p);
    }
    if (binomial > 0) small.clustering = left.squaredNorm() / binomial;
    for (std::size_t b = 0; b < bins; ++b) {
      small.im.push_back(tally_.mean_im(b));
      small.fitted[b] /= small.samples[b];  // NaN where there is none
    }
    small.left_out.resize(n_left_.rows(), static_cast<Eigen::Index>(bins));
    for (Eigen::Index r = 0; r < n_left_.rows(); ++r) {
      const auto without =
          misfits(cells_, bins, 1, n_left_.row(r), above_left_.row(r), left_out_[static_cast<std::size_t>(r)], 1);
      for (std::size_t b = 0; b < bins; ++b) small.left_out(r, static_cast<Eigen::Index>(b)) = without[b];
    }
    return small;
  }

  const Tally& tally_;
  const Cells& cells_;
  const Shape& shape_;
  Eigen::MatrixXd n_, above_;            // [resample, cell]
  Eigen::MatrixXd n_left_, above_left_;  // [left out, cell]
  int left_out_records_, motions_ = 0;
  std::vector<Shape> shapes_;    // [resample]
  std::vector<Shape> left_out_;  // [left out]
};

FragilityFunction function_of(const Tally& tally, const Cells& cells, const Resampling& resampling) {
  const Shape shape(points_of(cells.im, cells.n.colwise().sum(), cells.above.colwise().sum()), {});
  FragilityFunction curve;
  curve.median = shape.fit.median;
  curve.dispersion = shape.fit.dispersion;
  curve.penalised = shape.fit.penalised;
  curve.grid = grid_of(tally.options().im_edge);
  curve.probability.assign(curve.grid.size(), unknown);
  curve.lower = curve.upper = curve.probability;
  if (!cells.im.empty()) {
    curve.im_least = cells.im.front();
    curve.im_most = cells.im.back();
  }
  const Resampled resampled(tally, cells, shape, resampling);
  if (std::isnan(curve.median)) {  // what falls with the intensity has none, and cells that say how
    resampled.shares_of_cells(curve);
    return curve;
  }
  curve.extrapolated = curve.median < curve.im_least || curve.median > curve.im_most;
  resampled.errors(curve);
  resampled.band(curve);
  resampled.misfit(curve);
  resampled.shares_of_cells(curve);
  return curve;
}

}  // namespace

bool rates_differ(const FragilityFunction& curve) { return curve.rate_p <= test_level; }

bool not_refuted(const FragilityFunction& curve) {
  return !curve.adequate && curve.misfit_p > test_level && !rates_differ(curve);
}

FragilityFunction overturning_function(const Tally& tally, const Resampling& resampling) {
  return function_of(tally,
                     cells_of(tally,
                              [&](std::size_t cell, std::size_t group) {
                                return Share{tally.im_cell_n(cell, group), tally.im_cell_over(cell, group)};
                              }),
                     resampling);
}

FragilityFunction fragility_function(const Tally& tally, std::size_t edp, std::size_t capacity,
                                     const Resampling& resampling) {
  return function_of(tally,
                     cells_of(tally,
                              [&](std::size_t cell, std::size_t group) {
                                const auto counts = tally.im_cell_of(edp, cell, group);
                                return Share{counts[0], counts[1 + capacity]};
                              }),
                     resampling);
}

}  // namespace freestand::fragility
