// surface.csv: every point of every surface, over the intensity alone and over second axes; least and most: what `empirical` would be if
// all samples that failed had stayed below, or lain above.
#include <fmt/format.h>

#include "io/csv_cell.hpp"
#include "io/fragility_file.hpp"

namespace freestand::io {
namespace {

using fragility::AxisSurface;
using fragility::BinStatus;
using fragility::EdpResult;
using fragility::Result;

// im_name to unit: what stands before the capacity.
std::string row_start(const Result& result, const EdpResult& edp, std::size_t bin) {
  return fmt::format("{},{},{},{},{},{},{}", cell(im_text(result)), cell(result.im_unit), cell(result.im[bin]),
                     cell(result.im_edge[bin]), cell(result.im_edge[bin + 1]), cell(edp.name), cell(edp.unit));
}

std::string over_intensity(const Result& result, const EdpResult& edp) {
  std::string text;
  for (std::size_t i = 0; i < edp.bins.size(); ++i)
    for (std::size_t k = 0; k < edp.capacity.size(); ++k) {
      const std::size_t at = i * edp.capacity.size() + k;
      const auto bound = [at](const std::vector<double>& values) { return values.empty() ? "" : cell(values[at]); };
      text += fmt::format("{},{},,,,,,{},{},{},{},{},{},{},{}\n", row_start(result, edp, i), cell(edp.capacity[k]),
                          edp.bins[i].n, cell(edp.surface.probability[at]), cell(edp.surface.lower[at]),
                          cell(edp.surface.upper[at]), cell(edp.surface.empirical[at]), name(edp.bins[i].status),
                          bound(edp.surface.least), bound(edp.surface.most));
    }
  return text;
}

// A cell is counted, never fitted; one with too few samples is empty.
std::string over_axis(const Result& result, const EdpResult& edp, const AxisSurface& axis) {
  std::string text;
  for (std::size_t i = 0; i < edp.bins.size(); ++i)
    for (std::size_t j = 0; j < axis.centre.size(); ++j)
      for (std::size_t k = 0; k < edp.capacity.size(); ++k) {
        const std::size_t at_cell = i * axis.centre.size() + j, at = at_cell * edp.capacity.size() + k;
        const std::string probability = cell(axis.probability[at]);
        text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},,\n", row_start(result, edp, i),
                            cell(edp.capacity[k]), cell(axis.name), cell(axis.unit), cell(axis.centre[j]),
                            cell(axis.edge[j]), cell(axis.edge[j + 1]), axis.n[at_cell], probability,
                            cell(axis.lower[at]), cell(axis.upper[at]), probability,
                            name(probability.empty() ? BinStatus::too_few : BinStatus::counts_only));
      }
  return text;
}

}  // namespace

std::string im_text(const Result& result) {
  return result.im_period_s ? fmt::format("{}:{}", result.im_name, *result.im_period_s) : result.im_name;
}

std::string surface_csv(const Result& result) {
  std::string text =
      "im_name,im_unit,im,im_lower,im_upper,edp,unit,capacity,axis,axis_unit,axis_value,axis_lower,axis_upper,n,"
      "probability,lower,upper,empirical,status,least,most\n";
  for (const EdpResult& edp : result.edps) {
    text += over_intensity(result, edp);
    for (const AxisSurface& axis : edp.axes) text += over_axis(result, edp, axis);
  }
  return text;
}

}  // namespace freestand::io
