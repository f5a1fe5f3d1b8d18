#include "measurement/fit/strides.hpp"

#include <algorithm>

#include "measurement/fit/least_squares.hpp"

namespace freestand::measurement {

std::vector<StrideFit> fit_by_strides(const Bench& bench, const std::vector<FitTask>& tasks, std::size_t finals,
                                      const Effort& effort, const Jobs& jobs) {
  auto fits = fit_models(bench, tasks, effort, jobs, mean_stride_scores);
  std::vector<StrideFit> best;
  for (std::size_t i = 0; i < fits.size(); ++i) best.push_back({i, std::move(fits[i])});
  const auto by_score = [](const StrideFit& a, const StrideFit& b) { return a.fit.score < b.fit.score; };
  std::stable_sort(best.begin(), best.end(), by_score);
  best.resize(std::min(best.size(), finals));
  std::vector<ModelFit*> descending;
  for (StrideFit& one : best) descending.push_back(&one.fit);
  descend_by_derivatives(bench, descending, jobs);
  std::stable_sort(best.begin(), best.end(), by_score);
  return best;
}

}  // namespace freestand::measurement
