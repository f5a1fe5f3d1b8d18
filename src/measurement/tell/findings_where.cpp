#include "measurement/tell/findings_where.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/digits.hpp"

namespace freestand::measurement {
namespace {

// Over all samples of a table.
double root_mean_square(const ErrorTable& table, const std::vector<double>& of_bins) {
  double square = 0, n = 0;
  for (std::size_t b = 0; b < table.count.size(); ++b)
    if (table.count[b] > 0) square += table.count[b] * of_bins[b] * of_bins[b], n += table.count[b];
  return std::sqrt(square / std::max(n, 1.0));
}

struct Peak {
  const ErrorTable* table;
  std::size_t bin;
  double mean;
  double growth() const { return table->growth[bin]; }
  double contrast() const { return growth() / mean; }
  const std::vector<double>& of(Channel channel) const {
    return channel == Channel::slip ? table->slip_growth_m : table->rotation_growth_rad;
  }
  double growth(Channel channel) const { return of(channel)[bin]; }
  double average(Channel channel) const { return root_mean_square(*table, of(channel)); }
  // In which the error changes more there, in noise units.
  Channel channel(const Bench& bench) const {
    const auto units = [&](Channel c) { return bench.noise(c) > 0 ? growth(c) / bench.noise(c) : -1.0; };
    return units(Channel::rotation) > units(Channel::slip) ? Channel::rotation : Channel::slip;
  }
  std::string place() const {
    const std::string& v = table->variable;
    constexpr const char* phases[phase_count] = {
        "while stuck",   "as sliding begins",  "while sliding",       "as sliding turns round",
        "while rocking", "just after impacts", "after coming to rest"};
    if (v == "phase") return phases[bin];
    const double at = table->centre[bin];
    if (v == "direction") return fmt::format("sliding to the {}", at > 0 ? "right" : "left");
    const struct {
      const char *name, *words;
    } words[] = {{"speed_mps", "at slip speeds about {} m/s"}, {"path_m", "when about {} m have been slid"},
                 {"position_m", "at slips about {} m"},        {"normal_g", "under about {} times the weight"},
                 {"time_s", "about {} s after the start"},     {"floor_g", "under a floor of about {} g"}};
    const auto found = std::find_if(std::begin(words), std::end(words), [&](const auto& w) { return w.name == v; });
    return fmt::format(fmt::runtime(found == std::end(words) ? "about {}" : found->words), fmt::format("{:.2g}", at));
  }
};

// The bin that stands out of its table, among those that hold more than 1 % of the samples.
std::optional<Peak> peak_of(const ErrorTable& table) {
  const double mean = root_mean_square(table, table.growth);
  const double n = std::accumulate(table.count.begin(), table.count.end(), 0.0);
  std::optional<std::size_t> most;
  for (std::size_t b = 0; b < table.count.size(); ++b)
    if (table.count[b] > 0.01 * n && !(most && table.growth[b] <= table.growth[*most])) most = b;
  if (!most || mean < 3 || !(table.growth[*most] > 1.8 * mean)) return {};
  return Peak{&table, *most, mean};
}

}  // namespace

// 0.0183 m as a reader wants it: "18.3 mm", "4.2 mrad", "0.31 m/s2".
std::string told(Channel channel, double value) {
  if (channel == Channel::block_acceleration) return three_digits(value) + " m/s2";
  return three_digits(1000 * value) + (channel == Channel::slip ? " mm" : " mrad");
}

const char* word(Channel channel) {
  constexpr const char* words[] = {"slip", "rotation", "acceleration"};
  return words[static_cast<int>(channel)];
}

std::string where_wrong(const Bench& bench, const std::vector<ErrorTable>& tables) {
  std::optional<Peak> phase, most;
  for (const ErrorTable& table : tables) {
    const std::optional<Peak> peak = peak_of(table);
    if (!peak) continue;
    auto& best = table.variable == "phase" ? phase : most;
    if (!best || peak->contrast() > best->contrast()) best = peak;
  }
  if (!phase && !most) return "";
  const Peak& first = phase ? *phase : *most;
  const bool more = phase && most && most->contrast() > phase->contrast();
  const Channel channel = first.channel(bench);
  const double noise = bench.noise(channel), there = first.growth(channel), average = first.average(channel);
  return fmt::format(
      "wrong mostly {}: there the error of the {} changes by {} in 0.1 s, {} on the average ({} and {} noise "
      "units){}",
      first.place(), word(channel), told(channel, there), told(channel, average), three_digits(there / noise),
      three_digits(average / noise),
      more ? fmt::format("; {} by {}", most->place(), told(channel, most->growth(channel))) : "");
}

}  // namespace freestand::measurement
