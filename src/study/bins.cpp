#include "study/bins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>

namespace freestand::study {
namespace {

// As many as `count` may be; few samples fill fewer, but a trial of some may leave bins empty.
constexpr double most_bins = 1000, most_bins_of_few = 100;

std::vector<double> of_width(double width, const std::vector<double>& sorted) {
  const double least = sorted.front(), greatest = sorted.back(), values = static_cast<double>(sorted.size());
  const double first = std::floor(least / width), last = std::floor(greatest / width) + 1;
  const double most = std::clamp(values, most_bins_of_few, most_bins);
  const double count = last - first;  // no number where the ends are beyond all numbers
  if (!(count <= most))
    throw Error(
        fmt::format("a width of {} makes {} bins (values reach from {:.4g} to {:.4g}, and {}): choose a "
                    "width of at least {:.1g}, or count",
                    sampling::number_text(width), std::isfinite(count) ? fmt::format("{:.6g}", count) : "countless",
                    least, greatest,
                    most < most_bins ? fmt::format("{} samples do not fill so many", sorted.size())
                                     : fmt::format("no more than {} are held", most_bins),
                    2 * (greatest - least) / most));
  std::vector<double> edges;
  for (double i = first; i <= last; ++i) edges.push_back(i * width);
  return edges;
}

// Edge i of `count` bins, between the neighbours of the sorted values that it parts.
double of_count(const std::vector<double>& sorted, int count, int i) {
  const double position = static_cast<double>(sorted.size()) * i / count;
  const auto above = std::min(static_cast<std::size_t>(std::llround(position)), sorted.size() - 1);
  return above == 0 ? sorted.front() : 0.5 * (sorted[above - 1] + sorted[above]);
}

}  // namespace

std::vector<double> bin_edges(const BinsPart& bins, std::vector<double> values) {
  if (!bins.edges.empty()) return bins.edges;
  const bool log = bins.count > 0 && bins.spacing == Spacing::log;
  std::erase_if(values, [log](double x) { return !std::isfinite(x) || (log && x <= 0); });
  if (values.empty())
    throw Error(fmt::format("bins cannot be made (no sample has a {} value): give edges, or another intensity measure",
                            log ? "positive" : "finite"),
                Exit::data);
  std::sort(values.begin(), values.end());
  const double least = values.front(), greatest = values.back();
  if (bins.width > 0) return of_width(bins.width, values);
  if (least == greatest) {
    const double margin = std::max(1e-9, 1e-6 * std::abs(least));
    return {least - margin, least + margin};
  }
  std::vector<double> edges = {least};
  for (int i = 1; i < bins.count; ++i) {
    const double part = static_cast<double>(i) / bins.count;
    const double edge = bins.spacing == Spacing::equal_count ? of_count(values, bins.count, i)
                        : log                                ? least * std::pow(greatest / least, part)
                                                             : least + (greatest - least) * part;
    if (edge > edges.back() && edge < greatest) edges.push_back(edge);
  }
  edges.push_back(greatest);
  return edges;
}

}  // namespace freestand::study
