#include "measurement/fit/bands.hpp"

#include <cmath>
#include <limits>

namespace freestand::measurement {
namespace {

constexpr std::size_t predictions = 40;  // their standard deviation is known to a ninth
constexpr double reach = 1.645;          // of a normal deviate in 90 of 100

}  // namespace

std::vector<Bands> predicted_bands(const Bench& bench, const ModelSpec& model, const Posterior& posterior,
                                   const Jobs& jobs) {
  std::vector<Bands> all(bench.size());
  if (posterior.draws.empty()) return all;
  const auto answers = jobs("bands", bench.size(), [&](std::size_t i) {
    const Test& test = bench.test(i);
    Values ends;
    if (!test.has_history()) return ends;
    Prediction first;
    std::vector<Values> mean(channel_count), square(channel_count);  // of the differences from the first
    double count = 0;
    for (std::size_t k = 0; k < predictions; ++k) {
      const auto& replays = bench.replays(i);
      const FloorMotion* motion = replays.empty() ? nullptr : &replays[k % replays.size()];
      Prediction one = predict(model, test, spread_row(posterior.draws, k, predictions), motion);
      if (one.failed()) continue;
      if (count++ == 0) first = one;
      for (int c = 0; c < channel_count; ++c) {
        const auto channel = static_cast<Channel>(c);
        const std::size_t n = history(test, channel).size();
        auto &m = mean[static_cast<std::size_t>(c)], &s = square[static_cast<std::size_t>(c)];
        m.resize(n), s.resize(n);
        for (std::size_t t = 0; t < n; ++t) {
          const double d = one.channel(channel)[t] - first.channel(channel)[t];
          m[t] += d, s[t] += d * d;
        }
      }
    }
    for (int c = 0; c < channel_count && count > 1; ++c) {
      const auto channel = static_cast<Channel>(c);
      const double noise = bench.noise(channel);
      for (std::size_t t = 0; t < history(test, channel).size(); ++t) {
        const double m = mean[static_cast<std::size_t>(c)][t] / count;
        const double variance = (square[static_cast<std::size_t>(c)][t] - count * m * m) / (count - 1);
        const double middle = first.channel(channel)[t] + m,
                     half = reach * std::sqrt(std::max(variance, 0.0) + noise * noise);
        ends.push_back(middle - half);
        ends.push_back(middle + half);
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
        band.upper.push_back(*at++);
      }
    }
  }
  return all;
}

double share_within(const Test& test, const Bands& bands) {
  double held = 0, count = 0;
  for (std::size_t c = 0; c < bands.size(); ++c) {
    const auto& measured = history(test, static_cast<Channel>(c));
    for (std::size_t k = 0; k < measured.size(); ++k) held += bands[c].holds(k, measured[k]), ++count;
  }
  return count > 0 ? held / count : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace freestand::measurement
