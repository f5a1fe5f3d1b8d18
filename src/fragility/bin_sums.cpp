#include "fragility/bin_sums.hpp"

#include <array>
#include <cmath>

namespace freestand::fragility {

BinSums::BinSums(const Eigen::RowVectorXd& row)
    : n(row(0)),
      still(row(1)),
      over(row(2)),
      moved(row(3)),
      without_ln_im(row(4)),
      ln(row(5)),
      ln2(row(6)),
      ln_im(row(7)),
      ln_im2(row(8)),
      ln_times_ln_im(row(9)),
      moved_in(row.segment<cells>(counts).transpose()),
      still_in(row.segment<cells>(counts + cells).transpose()) {}

Eigen::MatrixXd sums_by_group(const Tally& tally, std::size_t edp, std::size_t bin) {
  const std::size_t groups = tally.layout().groups, capacities = tally.layout().capacity_count[edp];
  Eigen::MatrixXd table(static_cast<Eigen::Index>(groups), BinSums::size + static_cast<Eigen::Index>(capacities));
  for (std::size_t g = 0; g < groups; ++g) {
    const Counts c = tally.counts(edp, bin, g);
    const auto row = static_cast<Eigen::Index>(g);
    table.row(row).head<BinSums::counts>() << static_cast<double>(c.n), static_cast<double>(c.still),
        static_cast<double>(c.over), static_cast<double>(c.moved), static_cast<double>(c.without_ln_im), c.sum_ln,
        c.sum_ln2, c.sum_ln_im, c.sum_ln_im2, c.sum_ln_times_ln_im;
    for (Eigen::Index k = 0; k < BinSums::cells; ++k) {
      const std::size_t cell = bin * TallyLayout::cells_per_bin + static_cast<std::size_t>(k);
      table(row, BinSums::counts + k) = static_cast<double>(tally.moved_in_cell(edp, cell, g));
      table(row, BinSums::counts + BinSums::cells + k) = static_cast<double>(tally.still_in_cell(edp, cell, g));
    }
    for (std::size_t k = 0; k < capacities; ++k)
      table(row, BinSums::size + static_cast<Eigen::Index>(k)) = static_cast<double>(tally.exceeding(edp, bin, g, k));
  }
  return table;
}

double im_of_line(const Options& options, std::size_t bin, double mean) { return options.im_edge[bin] < 0 ? 0 : mean; }

BinLine line_of(const BinSums& s, double im) {
  if (s.without_ln_im > 0 || s.moved < 3 || !(im > 0)) return {};
  const double spread = s.ln_im2 - s.ln_im * s.ln_im / s.moved;
  // The sums are exact to 1e-12 a sample: of intensities that differ by less than 1e-5 they say nothing.
  if (!(spread > 1e-10 * s.moved)) return {};
  return {(s.ln_times_ln_im - s.ln * s.ln_im / s.moved) / spread, std::log(im)};
}

GroupMoments moments(const BinSums& s, const BinLine& line) {
  if (line.slope == 0) return {s.moved, s.ln, s.ln2};
  const double b = line.slope, x = line.ln_im;
  return {s.moved, s.ln - b * (s.ln_im - x * s.moved),
          s.ln2 - 2 * b * (s.ln_times_ln_im - x * s.ln) + b * b * (s.ln_im2 - 2 * x * s.ln_im + x * x * s.moved)};
}

BinSums::InCells ln_im_of_cells(const Tally& tally, std::size_t bin) {
  BinSums::InCells ln_im = BinSums::InCells::Zero();
  for (Eigen::Index k = 0; k < BinSums::cells; ++k) {
    const ImCell cell = tally.im_cell(bin * TallyLayout::cells_per_bin + static_cast<std::size_t>(k));
    if (cell.im_sum > 0) ln_im[k] = std::log(cell.im_sum / static_cast<double>(cell.n));
  }
  return ln_im;
}

namespace {

LineFit fit_on(const BinSums& s, const BinSums::InCells& ln_im, const BinLine& line, double still_threshold,
               std::optional<double> slope) {
  if (line.slope == 0 || s.still == 0 || !(still_threshold > 0)) {
    const GroupMoments m = moments(s, line);
    return {fit_above(m.n, m.sum, m.sum2, s.still, still_threshold), line.slope};
  }
  const double at = line.ln_im;
  std::array<LineCell, BinSums::cells> cells;
  for (Eigen::Index k = 0; k < BinSums::cells; ++k)
    cells[static_cast<std::size_t>(k)] = {ln_im[k] - at, s.moved_in[k], s.still_in[k]};
  return fit_line_above({s.moved, s.ln_im - at * s.moved, s.ln_im2 - 2 * at * s.ln_im + at * at * s.moved, s.ln, s.ln2,
                         s.ln_times_ln_im - at * s.ln},
                        cells, still_threshold, slope);
}

}  // namespace

LineFit law_of(const BinSums& s, const BinSums::InCells& ln_im, double im, double still_threshold) {
  return fit_on(s, ln_im, line_of(s, im), still_threshold, {});
}

LineFit law_along(const BinSums& s, const BinSums::InCells& ln_im, const BinLine& line, double still_threshold) {
  return fit_on(s, ln_im, line, still_threshold, line.slope);
}

}  // namespace freestand::fragility
