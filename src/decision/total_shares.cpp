#include "decision/total_shares.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace freestand::decision {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
constexpr double sum_scale = 1 << 20;
constexpr std::size_t words_of_sums = 4;

// Of pairs by the group of the sample; of those by the group of the redrawn one, where that is another.
constexpr std::size_t first_side = 0, other_side = 1, sides = 2;

}  // namespace

TotalTally::TotalTally(std::size_t parameters, std::vector<Answer> answers, const fragility::LeaveOutGroups& groups)
    : answers_(std::move(answers)),
      groups_(groups),
      words_(parameters * answers_.size() * static_cast<std::size_t>(groups_.count()) * sides * words_of_sums, 0) {}

std::size_t TotalTally::place(std::size_t parameter, std::size_t answer, std::size_t group, std::size_t side) const {
  const std::size_t row = (parameter * answers_.size() + answer) * static_cast<std::size_t>(groups_.count()) + group;
  return (row * sides + side) * words_of_sums;
}

void TotalTally::add(std::size_t parameter, int group, int group_again, std::span<const double> value,
                     std::span<const double> again) {
  for (std::size_t a = 0; a < answers_.size(); ++a) {
    const double y = value[a], z = again[a];
    if (std::isnan(y) || std::isnan(z)) continue;
    const std::int64_t sums[] = {1, std::llround((y - z) * (y - z) * sum_scale), std::llround((y + z) * sum_scale),
                                 std::llround((y * y + z * z) * sum_scale)};
    for (std::size_t i = 0; i < words_of_sums; ++i) {
      words_[place(parameter, a, static_cast<std::size_t>(group), first_side) + i] += sums[i];
      if (group_again != group)
        words_[place(parameter, a, static_cast<std::size_t>(group_again), other_side) + i] += sums[i];
    }
  }
}

TotalTally::Sums TotalTally::read(std::size_t at) const {
  const auto number = [&](std::size_t i) { return static_cast<double>(words_[at + i]); };
  return {number(0), number(1) / sum_scale, number(2) / sum_scale, number(3) / sum_scale};
}

TotalTally::Sums TotalTally::all(std::size_t parameter, std::size_t answer) const {
  Sums sums;
  for (std::size_t g = 0; g < static_cast<std::size_t>(groups_.count()); ++g) {
    const Sums one = read(place(parameter, answer, g, first_side));
    sums = {sums.n + one.n, sums.differences + one.differences, sums.sum + one.sum, sums.squares + one.squares};
  }
  return sums;
}

double TotalTally::rarer(std::size_t parameter, std::size_t answer) const {
  const Sums sums = all(parameter, answer);
  return 0.5 * std::min(sums.sum, 2 * sums.n - sums.sum);
}

TotalShare TotalTally::share(std::size_t parameter, std::size_t answer, double confidence) const {
  const auto of = [](const Sums& sums) {
    const double values = 2 * sums.n, mean = sums.sum / values;
    const double variance = sums.squares / values - mean * mean;
    return sums.n < 2 || !(variance > 0) ? undefined : sums.differences / values / variance;
  };
  const auto groups = static_cast<std::size_t>(groups_.count());
  const Sums whole = all(parameter, answer);
  fragility::LeftOut left_out(2);
  for (std::size_t g = 0; g < groups; ++g) {
    Sums rest = whole;
    for (const std::size_t side : {first_side, other_side}) {
      const Sums one = read(place(parameter, answer, g, side));
      rest = {rest.n - one.n, rest.differences - one.differences, rest.sum - one.sum, rest.squares - one.squares};
    }
    if (rest.n < whole.n) left_out[static_cast<std::size_t>(groups_.stratum(static_cast<int>(g)))].push_back(of(rest));
  }
  return {fragility::jackknife_share(of(whole), left_out, confidence), static_cast<std::int64_t>(whole.n)};
}

}  // namespace freestand::decision
