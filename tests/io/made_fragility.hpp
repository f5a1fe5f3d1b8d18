// A made-up result with every part that fragility.h5 has.
#pragma once

#include <vector>

#include "fragility/result.hpp"

namespace freestand::test {

inline fragility::EdpResult continuous_edp() {
  fragility::EdpResult edp;
  edp.name = "delta";
  edp.unit = "m";
  edp.symbol = "Δ";
  edp.bins.resize(3);
  for (int i = 0; i < 3; ++i) edp.bins[static_cast<std::size_t>(i)].n = 100 + i;
  edp.bins[0].lambda = 0.25;
  edp.bins[0].status = fragility::BinStatus::fitted;
  edp.bins[1].lambda = 1.25;
  edp.bins[1].status = fragility::BinStatus::rejected;
  edp.bins[1].p_over = 0.1;
  edp.capacity = {0.5, 2};
  edp.surface.probability = {0, 0.125, 1, 1.125, 2, 2.125};
  edp.surface.lower = std::vector<double>(6, 8);
  edp.surface.upper = std::vector<double>(6, 9);
  edp.surface.empirical = {0, 0, 0, 0, fragility::unknown, 0.5};
  edp.surface.least = edp.surface.most = edp.surface.empirical;
  edp.surface.empirical_lower = {0, 0, 0, 0, fragility::unknown, 0.25};
  edp.surface.empirical_upper = {0.1, 0.1, 0.1, 0.1, fragility::unknown, 0.75};
  for (int i = 0; i < 12; ++i) edp.surface.resampled.push_back(i / 16.0);  // [2, 3, 2]
  for (int i = 0; i < 18; ++i) edp.surface.left_out.push_back(i / 32.0);   // [3, 3, 2]
  edp.distribution = {{-1, 0, 1}, {1, 2, 3, 4, 5, 6}};
  edp.axes = {
      {"friction_mu_k", "1", {0, 1, 2}, {0.5, 1.5}, {}, std::vector<double>(12, 1), std::vector<double>(12, 2), {}}};
  for (int i = 0; i < 12; ++i) edp.axes[0].probability.push_back(i);
  edp.axes[0].n = {0, 1, 2, 3, 4, 5};
  edp.regressions.slope = 3.5;
  for (const double median : {1.5, 2.5}) {
    fragility::FragilityFunction curve;
    curve.median = median;
    curve.adequate = true;
    curve.grid = {1, 2, 3};
    curve.probability = {0.25, 0.5, median};
    curve.lower = {0, 0, 0};
    curve.upper = {1, 1, 1};
    curve.resampled_median = {1, 2};
    curve.resampled_dispersion = {0.5, median};
    curve.left_out_median = {1, median, 3};
    curve.left_out_dispersion = {0.25, 0.5, 0.75};
    edp.functions.push_back(curve);
  }
  return edp;
}

inline fragility::Result example() {
  fragility::Result result;
  result.im_name = "pga";
  result.im_unit = "g";
  result.im_edge = {0, 1, 2, 4};
  result.im = {0.5, 1.25, 3};  // not their middles
  result.outcome_counts = {1, 2, 3, 4, 5, 6};
  result.samples = 21;
  result.resamples = 2;
  result.left_out_records = 2;
  fragility::EdpResult binary;
  binary.name = "overturned";
  binary.unit = "1";
  binary.symbol = "O";
  binary.binary = true;
  binary.bins.resize(3);
  binary.capacity = {0.5};
  binary.surface.probability = binary.surface.lower = binary.surface.upper = binary.surface.empirical = {0, 0.5, 1};
  binary.surface.least = binary.surface.most = {0, 0.5, 1};
  binary.surface.empirical_lower = binary.surface.empirical_upper = {0, 0.5, 1};
  result.edps = {continuous_edp(), binary};
  result.overturning.median = 1.5;
  result.overturning.dispersion = 0.5;
  result.overturning.penalised = true;
  result.overturning.im_least = 0.25;
  result.overturning.im_most = 1.25;
  result.overturning.extrapolated = true;
  result.overturning.misfit = 0.125;
  result.overturning.misfit_im = 0.75;
  result.overturning.grid = {1, 2};
  result.overturning.probability = {0.25, 0.75};
  result.overturning.lower = {0, 0};
  result.overturning.upper = {1, 1};
  result.overturning.resampled_median = {1, 1.5};
  result.overturning.resampled_dispersion = {0.5, 0.75};
  result.overturning.left_out_median = {1, 1.25, 1.5};
  result.overturning.left_out_dispersion = {0.5, 0.625, 0.75};
  result.warnings = {"one thing.", "another thing."};
  return result;
}

}  // namespace freestand::test
