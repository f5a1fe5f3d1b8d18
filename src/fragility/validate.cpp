#include "fragility/validate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>
#include <set>

#include "fragility/intervals.hpp"

namespace freestand::fragility {
namespace {

class Problems {
 public:
  void expect(bool good, const std::string& text) {
    if (!good) text_ += (text_.empty() ? "" : "\n") + text;
  }
  void raise() const {
    if (!text_.empty()) throw Error(text_);
  }

 private:
  std::string text_;
};

bool increasing(const std::vector<double>& values) {
  const bool finite = std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
  return finite && std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
}

void check_edp(const EdpOptions& edp, Problems& problems) {
  problems.expect(!edp.name.empty(), "a demand parameter has no name (fragility: edp): name it");
  problems.expect(edp.still_threshold >= 0 && std::isfinite(edp.still_threshold),
                  fmt::format("still threshold {} of {} is not usable (negative or not a number): give 0 or more",
                              edp.still_threshold, edp.name));
  if (edp.binary) return;
  problems.expect(!edp.capacities.empty(),
                  fmt::format("no capacities for {} (a surface needs them): list them under capacities", edp.name));
  problems.expect(
      increasing(edp.capacities) && (edp.capacities.empty() || edp.capacities.front() > edp.still_threshold),
      fmt::format("capacities of {} are not usable (they must increase and lie above {}): correct the list", edp.name,
                  edp.still_threshold));
}

}  // namespace

void validate(const Options& o) {
  Problems problems;
  problems.expect(
      o.im_edge.size() >= 2 && increasing(o.im_edge),
      fmt::format("bin edges of {} are not usable (at least two, increasing): correct the list", o.im_name));
  problems.expect(!o.edps.empty(), "no demand parameter (fragility: edp is empty): name at least one");
  std::set<std::string> names;
  for (const EdpOptions& edp : o.edps) {
    check_edp(edp, problems);
    problems.expect(names.insert(edp.name).second,
                    fmt::format("{} is asked for twice (fragility: edp): keep one", edp.name));
  }
  for (const AxisOptions& axis : o.axes)
    problems.expect(
        axis.edge.size() >= 2 && increasing(axis.edge),
        fmt::format("edges of axis {} are not usable (at least two, increasing): correct the list", axis.name));
  problems.expect(
      o.minimum_samples >= least_minimum_samples,
      fmt::format("minimum of {} samples a bin is not usable (a fit needs two): give 2 or more", o.minimum_samples));
  problems.expect(o.resamples >= least_resamples && o.resamples <= most_resamples,
                  fmt::format("{} resamples are not usable ({} to {}): 500 is usual", o.resamples, least_resamples,
                              most_resamples));
  problems.expect(o.confidence > 0 && o.confidence < 1,
                  fmt::format("confidence {} is not usable (between 0 and 1): 0.95 is usual", o.confidence));
  problems.expect(
      o.false_discovery > 0 && o.false_discovery < 1,
      fmt::format("false discovery rate {} is not usable (between 0 and 1): 0.05 is usual", o.false_discovery));
  problems.raise();
}

std::vector<double> equal_width_edges(double low, double high, int count) {
  if (count < 1 || !(low < high) || !std::isfinite(low) || !std::isfinite(high))
    throw Error(fmt::format("no bins ({} between {} and {}): give at least one bin and a range", count, low, high));
  std::vector<double> edge;
  for (int i = 0; i <= count; ++i) edge.push_back(i == count ? high : low + (high - low) * i / count);
  return edge;
}

std::vector<double> equal_count_edges(std::vector<double> values, int count) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  std::sort(values.begin(), values.end());
  if (count < 1 || values.empty() || values.front() == values.back())
    throw Error(fmt::format("no bins ({} of equal count from {} values, all of them the same): sweep the intensity",
                            count, values.size()));
  std::vector<double> edge;
  for (int i = 0; i <= count; ++i) {
    const double next = sorted_quantile(values, static_cast<double>(i) / count);
    if (edge.empty() || next > edge.back()) edge.push_back(next);
  }
  return edge;
}

}  // namespace freestand::fragility
