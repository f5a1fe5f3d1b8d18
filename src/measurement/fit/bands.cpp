#include "measurement/fit/bands.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace freestand::measurement {
namespace {

constexpr std::size_t predictions = 40;
constexpr double reach = 1.645;  // of a normal deviate in 90 of 100

// Of so many equally likely values as many lie below it, at `share` of their number and one more: sorted as far as is needed.
double at_share(std::vector<double>& values, double share) {
  const double place = share * (static_cast<double>(values.size()) + 1) - 1;
  const auto k = static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + static_cast<long>(k), values.end());
  const double low = values[k];
  if (k + 1 == values.size()) return low;
  const double high = *std::min_element(values.begin() + static_cast<long>(k) + 1, values.end());
  return std::lerp(low, high, std::clamp(place - static_cast<double>(k), 0.0, 1.0));
}

}  // namespace

std::vector<Bands> predicted_bands(const Bench& bench, const ModelSpec& model, const Posterior& posterior,
                                   const Jobs& jobs) {
  std::vector<Bands> all(bench.size());
  if (posterior.draws.empty()) return all;
  const auto answers = jobs("bands", bench.size(), [&](std::size_t i) {
    const Test& test = bench.test(i);
    Values ends;
    if (!test.has_history()) return ends;
    std::vector<Asked> asked;
    for (std::size_t k = 0; k < predictions; ++k) {
      const Drawn drawn = drawn_in_laboratory(model, posterior, k, predictions);
      const auto& replays = bench.replays(i);
      const FloorMotion* motion = replays.empty() ? nullptr : &replays[k % replays.size()];
      asked.push_back({drawn.model, test, drawn.x, motion});
    }
    const auto [middle_model, middle_row] = drawn_in_laboratory(model, posterior, 0, 1);
    const Spread unread = bench.unread_spread(middle_model, i, middle_row, predict(middle_model, test, middle_row));
    std::vector<Prediction> all_of_them = predict(asked);
    std::erase_if(all_of_them, [](const Prediction& one) { return one.failed(); });
    for (int c = 0; c < channel_count && all_of_them.size() > 1; ++c) {
      const auto channel = static_cast<Channel>(c);
      const double sensor = reach * bench.noise(channel) * bench.sensor(channel).size();
      std::vector<double> here(all_of_them.size());
      for (std::size_t t = 0; t < history(test, channel).size(); ++t) {
        for (std::size_t k = 0; k < here.size(); ++k) here[k] = all_of_them[k].channel(channel)[t];
        double sum = 0;
        for (const double value : here) sum += value;
        const double middle = at_share(here, 0.5), lower = at_share(here, 0.05), upper = at_share(here, 0.95);
        const double beside = std::hypot(sensor, reach * std::sqrt(unread[static_cast<std::size_t>(c)][t]));
        ends.push_back(middle - std::hypot(middle - lower, beside));
        ends.push_back(sum / static_cast<double>(here.size()));
        ends.push_back(middle + std::hypot(upper - middle, beside));
      }
    }
    return ends;
  });
  for (std::size_t i = 0; i < bench.size(); ++i) {
    if (answers[i].empty()) continue;
    all[i].resize(channel_count);
    auto at = answers[i].begin();
    for (int c = 0; c < channel_count; ++c) {
      Band& band = all[i][static_cast<std::size_t>(c)];
      for (std::size_t t = 0; t < history(bench.test(i), static_cast<Channel>(c)).size(); ++t) {
        band.lower.push_back(*at++);
        band.mean.push_back(*at++);
        band.upper.push_back(*at++);
      }
    }
  }
  return all;
}

TestError error_of_mean(const Bench& bench, std::size_t test, const Bands& bands) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (bands.empty()) return {unknown, unknown, unknown, unknown};
  const auto mean = [&](Channel channel) { return bands[static_cast<std::size_t>(channel)].mean; };
  return test_error(bench, test,
                    Prediction{.response = {},
                               .slip_m = mean(Channel::slip),
                               .rotation_rad = mean(Channel::rotation),
                               .block_acceleration_mps2 = mean(Channel::block_acceleration)});
}

double share_within(const Bench& bench, const Test& test, const Bands& bands) {
  double held = 0, count = 0;
  for (std::size_t c = 0; c < bands.size(); ++c) {
    const auto& measured = history(test, static_cast<Channel>(c));
    if (bench.noise(static_cast<Channel>(c)) <= 0) continue;  // a channel of no stated noise has no band
    for (std::size_t k = 0; k < measured.size(); ++k) held += bands[c].holds(k, measured[k]), ++count;
  }
  return count > 0 ? held / count : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace freestand::measurement
