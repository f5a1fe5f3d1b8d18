// What the fit of one bin of one EDP is made of: sums over its samples, by group or over resampled groups.
#pragma once

#include <Eigen/Core>

#include "fragility/clusters.hpp"
#include "fragility/line_above.hpp"
#include "fragility/tally.hpp"

namespace freestand::fragility {

// The fields of Counts as real numbers, those of each fine cell of IM that moved, and that stood still; then the samples above each capacity.
struct BinSums {
  static constexpr Eigen::Index cells = TallyLayout::cells_per_bin, counts = 10, size = counts + 2 * cells;
  using InCells = Eigen::Array<double, cells, 1>;
  double n, still, over, moved, without_ln_im, ln, ln2, ln_im, ln_im2, ln_times_ln_im;
  InCells moved_in, still_in;

  explicit BinSums(const Eigen::RowVectorXd& row);
};

// [group, field of BinSums or capacity]
Eigen::MatrixXd sums_by_group(const Tally& tally, std::size_t edp, std::size_t bin);

// Within a bin ln EDP is taken to follow a line over ln IM, so that omega does not grow with the bin's width: demands at
// another IM are moved along it to the IM at which the bin stands.
struct BinLine {
  double slope = 0;
  double ln_im = 0;
};

// The least-squares line of the moved samples, about an IM, as if none had stood still. Slope 0 where IM does not vary, where fewer than three moved,
// or where some did at an IM that is not above 0.
BinLine line_of(const BinSums& sums, double im);

// The IM about which that line goes, where the bin's samples stand at `mean` on the average. 0 in a bin that reaches below 0, and so no line:
// its samples without a ln IM stand still, and shares of still and moved ones are then those of the whole bin, not of one IM.
double im_of_line(const Options& options, std::size_t bin, double mean);

// Of ln EDP less the line, over the moved samples.
GroupMoments moments(const BinSums& sums, const BinLine& line);

// ln of the mean IM of each fine cell; 0 where none is above 0.
BinSums::InCells ln_im_of_cells(const Tally& tally, std::size_t bin);

// The law of the bin about that IM: the line and what scatters about it, beside those that stood still.
LineFit law_of(const BinSums& sums, const BinSums::InCells& ln_im, double im, double still_threshold);
// The same along a line that is known.
LineFit law_along(const BinSums& sums, const BinSums::InCells& ln_im, const BinLine& line, double still_threshold);

}  // namespace freestand::fragility
