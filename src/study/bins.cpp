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

// Intensities that lie nearer to one another are one: what a record is scaled to comes back to some 1e-12 of it.
constexpr double one_value = 1e-9;

bool are_one(double below, double above) { return above - below <= one_value * std::abs(above); }

// Edge i of `count` bins, between the neighbours of the sorted values that it parts: the nearest that differ.
double of_count(const std::vector<double>& sorted, int count, int i) {
  const auto position = static_cast<std::ptrdiff_t>(std::llround(static_cast<double>(sorted.size()) * i / count));
  const auto n = static_cast<std::ptrdiff_t>(sorted.size());
  const auto parts = [&](std::ptrdiff_t k) {
    return k > 0 && k < n && !are_one(sorted[static_cast<std::size_t>(k - 1)], sorted[static_cast<std::size_t>(k)]);
  };
  for (std::ptrdiff_t off = 0; off < n; ++off)
    for (const std::ptrdiff_t k : {position - off, position + off})
      if (parts(k)) return 0.5 * (sorted[static_cast<std::size_t>(k - 1)] + sorted[static_cast<std::size_t>(k)]);
  return sorted.front();
}

// Edges on values that come again and again part them by the last digits of each: they go below all of these.
void off_values(std::vector<double>& edges, const std::vector<double>& sorted) {
  for (double& edge : edges) {
    const double reach = one_value * std::abs(edge);
    const auto near = std::lower_bound(sorted.begin(), sorted.end(), edge - reach);
    if (near != sorted.end() && *near < edge && std::upper_bound(near, sorted.end(), edge + reach) - near > 1)
      edge -= reach;
  }
}

}  // namespace

std::vector<double> bin_edges(const BinsPart& bins, std::vector<double> values) {
  std::vector<double> edges = bins.edges;
  const bool log = bins.count > 0 && bins.spacing == Spacing::log;
  std::erase_if(values, [log](double x) { return !std::isfinite(x) || (log && x <= 0); });
  std::sort(values.begin(), values.end());
  if (!edges.empty()) {
    off_values(edges, values);
    return edges;
  }
  if (values.empty())
    throw Error(fmt::format("bins cannot be made (no sample has a {} value): give edges, or another intensity measure",
                            log ? "positive" : "finite"),
                Exit::data);
  const double least = values.front(), greatest = values.back();
  if (bins.width > 0) {
    edges = of_width(bins.width, values);
    off_values(edges, values);
    return edges;
  }
  if (are_one(least, greatest)) {
    const double margin = std::max(1e-9, 1e-6 * std::abs(least));
    return {least - margin, least + margin};
  }
  edges = {least};
  for (int i = 1; i < bins.count; ++i) {
    const double part = static_cast<double>(i) / bins.count;
    const double edge = bins.spacing == Spacing::equal_count ? of_count(values, bins.count, i)
                        : log                                ? least * std::pow(greatest / least, part)
                                                             : least + (greatest - least) * part;
    if (edge > edges.back() && edge < greatest) edges.push_back(edge);
  }
  edges.push_back(greatest);
  if (bins.spacing != Spacing::equal_count) off_values(edges, values);
  return edges;
}

}  // namespace freestand::study
