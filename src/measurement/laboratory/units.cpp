#include "measurement/laboratory/units.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "measurement/fit/own_numbers.hpp"
#include "measurement/laboratory/plausible.hpp"
#include "measurement/laboratory/timing.hpp"
#include "measurement/levels.hpp"
#include "measurement/search.hpp"

namespace freestand::measurement {

namespace {

constexpr double ratios_of_lengths[] = {10, 100, 1000, 2.54, 25.4, 39.37, 12, 3.281};
constexpr double ratios_of_angles[] = {57.296};

// Either way round.
bool is_near(double factor, double ratio) {
  constexpr double told_to = 0.05;
  return factor > 0 && std::abs(std::abs(std::log(factor)) - std::log(ratio)) < told_to;
}

// Sum of the squares that the model leaves of a channel with the friction of this test that suits it best.
double left_with_own_friction(const Bench& bench, std::size_t i, Channel channel, const ModelFit& fit) {
  constexpr int budget = 60;
  ModelSpec model = fit.model;
  model.friction_factor = {.free = static_cast<int>(fit.x.size())};
  const auto& seen = history(bench.test(i), channel);
  const Objective left = [&](std::span<const double> own) {
    Values x = fit.x;
    x.push_back(own[0]);
    const Prediction given = predict(model, bench.test(i), x);
    if (given.failed()) return 1e300;
    double sum = 0;
    for (std::size_t k = 0; k < seen.size(); ++k) sum += std::pow(seen[k] - given.channel(channel)[k], 2);
    return sum;
  };
  return simplex({friction_of_one_test}, left, {1.0}, 0.1, budget).score;
}

constexpr double least_score = 1e-12;  // of peaks that a model has made, to the last digits

void multiply(std::optional<double>& peak, double factor) {
  if (peak) *peak *= factor;
}
// What peaks would be if what was written is to be multiplied by that: slips, or rotations.
Dataset read_as(const Dataset& data, Channel channel, double factor) {
  Dataset other = data;
  (channel == Channel::rotation ? other.noise.rotation_rad : other.noise.slip_m) *= factor;
  for (Test& test : other.tests) {
    if (channel == Channel::rotation) multiply(test.peaks.peak_rotation_rad, factor);
    if (channel == Channel::slip) multiply(test.peaks.peak_slip_m, factor);
    if (channel == Channel::slip) multiply(test.peaks.residual_slip_m, factor);
  }
  return other;
}

// Tests with a peak that is told from standing still.
std::size_t peaks_of_motion(const Bench& bench, Channel channel) {
  const double least = least_motion(bench, channel);
  return static_cast<std::size_t>(std::ranges::count_if(bench.data().tests, [&](const Test& test) {
    const Peaks& p = test.peaks;
    return channel == Channel::rotation
               ? p.peak_rotation_rad.value_or(0) > least
               : std::max(p.peak_slip_m.value_or(0), std::abs(p.residual_slip_m.value_or(0))) > least;
  }));
}

}  // namespace

bool is_ratio_of_units(double factor) {
  const auto near = [&](double ratio) { return is_near(factor, ratio); };
  return std::ranges::any_of(ratios_of_lengths, near) || std::ranges::any_of(ratios_of_angles, near);
}

bool is_in_a_unit(double factor) { return is_near(factor, 1) || is_ratio_of_units(factor); }

std::vector<OtherUnit> other_units(const Bench& bench, const ModelFit& fit, const std::vector<bool>& told) {
  constexpr double far = 8, closer = 4, right = 3;  // noise units
  std::vector<double> errors;
  for (const TestError& error : test_errors(bench, tests_of(bench.data(), Role::calibration), fit.model, fit.x))
    errors.push_back(error.noise_units);
  std::nth_element(errors.begin(), errors.begin() + static_cast<long>(errors.size() / 2), errors.end());
  if (!(errors[errors.size() / 2] < right)) return {};
  std::vector<OtherUnit> found;
  for (std::size_t i = 0; i < bench.size(); ++i) {
    const Test& test = bench.test(i);
    if (!test.has_history()) continue;
    const Prediction model = predict(fit.model, test, fit.x);
    for (const Channel channel : {Channel::slip, Channel::rotation}) {
      const auto &seen = history(test, channel), &given = model.channel(channel);
      const double noise = bench.noise(channel);
      if (seen.empty() || model.failed() || noise <= 0) continue;
      if (channel == Channel::slip && told[i]) continue;
      double sg = 0, gg = 0, off = 0, left = 0;
      for (std::size_t k = 0; k < seen.size(); ++k)
        sg += seen[k] * given[k], gg += given[k] * given[k], off += std::pow(seen[k] - given[k], 2);
      const double factor = gg > 0 ? sg / gg : 1;
      for (std::size_t k = 0; k < seen.size(); ++k) left += std::pow(seen[k] - factor * given[k], 2);
      const double n = static_cast<double>(seen.size()), units = noise * std::max(factor, 1.0) * std::sqrt(n);
      if (!is_ratio_of_units(factor) || std::sqrt(off) < far * noise * std::sqrt(n) || std::sqrt(left) > closer * units)
        continue;
      if (left_with_own_friction(bench, i, channel, fit) < left) continue;  // another friction explains it better
      found.push_back({i, fmt::format("{} of test {} is {:.3g} times what the model gives, all along: is it in {}?{}",
                                      name(channel), test.id, factor, channel == Channel::slip ? "metres" : "radians",
                                      held_out_note(bench.data(), {test.id}))});
    }
  }
  return found;
}

UnitOfPeaks peaks_in_another_unit(const Bench& bench, const ModelFit& base, double least_left_out, const Effort& effort,
                                  const Jobs& jobs) {
  struct Reading {
    Channel channel = Channel::slip;
    double factor = 1, left_out;
  } best{.left_out = least_left_out};
  double tried = 0;
  for (const Channel channel : {Channel::slip, Channel::rotation}) {
    const std::size_t moved = peaks_of_motion(bench, channel);
    if (moved == 0) continue;
    const std::span<const double> ratios =
        channel == Channel::rotation ? std::span<const double>(ratios_of_angles) : ratios_of_lengths;
    std::vector<double> factors;
    for (const double ratio : ratios) factors.insert(factors.end(), {ratio, 1 / ratio});
    for (const double factor : factors) {
      ++tried;
      const Dataset data = read_as(bench.data(), channel, factor);
      const Bench other(data, 0);
      if (peaks_of_motion(other, channel) < moved) continue;  // what is no motion is met by standing still
      ModelFit fit = fit_models(other, {{.model = base.model, .starts = {base.x}}}, effort, jobs)[0];
      if (fit.score >= best.left_out) continue;  // nor is it less of tests left out
      leave_out(other, {&fit}, effort, jobs);
      if (fit.mean_left_out() < best.left_out) best = {channel, factor, fit.mean_left_out()};
    }
  }
  const auto n = static_cast<double>(base.left_out.size());
  if (best.factor == 1 ||
      tried * gsl_cdf_fdist_Q(least_left_out / std::max(best.left_out, least_score), n, n) > chance_level)
    return {};
  const bool slips = best.channel == Channel::slip;
  return {fmt::format("if the {} are {:.3g} times what is written, the model by itself misses tests left out by {:.2g} "
                      "(ln), and the best of all that was tried by {:.2g} as they stand: are they in {}?",
                      slips ? "slips" : "rotations", best.factor, std::sqrt(best.left_out), std::sqrt(least_left_out),
                      slips ? "metres" : "radians"),
          best.factor};
}

bool UnitOfPeaks::may_be_physical() const { return std::abs(std::log(factor)) <= std::log(factor_of_springs); }

}  // namespace freestand::measurement
