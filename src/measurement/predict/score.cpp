#include "measurement/predict/score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.hpp"
#include "measurement/predict/placements.hpp"

namespace freestand::measurement {
namespace {

constexpr double no_score = std::numeric_limits<double>::quiet_NaN();
constexpr double ln_ratio_limit = 3;
constexpr double peaks_scatter =
    0.1;  // about a model, at least: of 28 peaks of the report by 0.4, of laboratory repeats by some hundredths
constexpr double stride_s = 1;
constexpr double moving = 8;  // in the noise of a channel

// visit(channel, noise, measured, predicted) for the channels that can be judged.
template <class Visit>
void each_channel(const Bench& bench, const Test& test, const Prediction& prediction, Visit&& visit) {
  for (int c = 0; c < channel_count; ++c) {
    const auto channel = static_cast<Channel>(c);
    if (!history(test, channel).empty() && bench.noise(channel) > 0)
      visit(channel, bench.noise(channel), history(test, channel), prediction.channel(channel));
  }
}

TestError history_error(const Bench& bench, std::size_t i, const Prediction& prediction) {
  double square = 0, relative = 0;
  int channels = 0;
  each_channel(bench, bench.test(i), prediction, [&](Channel, double noise, const auto& measured, const auto& model) {
    double sum = 0, peak = 0;
    for (std::size_t k = 0; k < measured.size(); ++k) {
      const double difference = model[k] - measured[k];
      sum += difference * difference;
      peak = std::max(peak, std::abs(measured[k]));
    }
    const double mean = sum / static_cast<double>(measured.size());
    square += mean / (noise * noise);
    if (peak > moving * noise) relative = std::max(relative, std::sqrt(mean) / peak);
    ++channels;
  });
  TestError error;
  error.noise_units = prediction.failed() ? failed_error : std::sqrt(square / std::max(channels, 1));
  error.noise_units = std::min(error.noise_units, failed_error);
  error.relative = relative;
  error.score = 2 * std::log(std::max(error.noise_units, 1e-3));
  return error;
}

double stride_score(const Bench& bench, const Test& test, const Prediction& prediction) {
  if (prediction.failed()) return std::log(1 + failed_error * failed_error);
  const auto stride = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(stride_s / test.dt_s)));
  double sum = 0, count = 0;
  each_channel(bench, test, prediction, [&](Channel, double noise, const auto& measured, const auto& model) {
    for (std::size_t from = 0; from < measured.size(); from += stride) {
      const std::size_t to = std::min(from + stride, measured.size());
      const double shift = from > 0 ? model[from - 1] - measured[from - 1] : 0;
      double square = 0;
      for (std::size_t k = from; k < to; ++k) square += std::pow((model[k] - measured[k] - shift) / noise, 2);
      sum += std::log(1 + square / static_cast<double>(to - from));
      count += 1;
    }
  });
  return sum / std::max(count, 1.0);
}

struct PeakPair {
  double measured, model, noise, least;
  bool other_way = false;  // both moved, and not to the same side
  double ln() const { return other_way ? -ln_ratio_limit : stabilised(model) - stabilised(measured); }

 private:
  // ln x far above the noise, and x over the noise near it: what scatters by a share of itself and by the noise scatters alike everywhere.
  double stabilised(double x) const {
    const double counts_from = noise / peaks_scatter;
    x = std::max(x, least);
    return std::log((x + std::hypot(x, counts_from)) / 2);
  }
};

std::vector<PeakPair> peak_pairs(const Bench& bench, const Test& test, const Response& r) {
  std::vector<PeakPair> pairs;
  const auto add = [&](const std::optional<double>& measured, double model, Channel channel) {
    const double unit = channel == Channel::block_acceleration ? standard_gravity_mps2 : 1;
    if (measured)
      pairs.push_back(
          {std::abs(*measured), std::abs(model), bench.noise(channel) / unit, least_motion(bench, channel)});
  };
  const Peaks& p = test.peaks;
  add(p.peak_slip_m, r.peak_slip_m, Channel::slip);
  add(p.residual_slip_m, r.residual_slip_m, Channel::slip);
  if (p.residual_slip_m && sides_are_known(bench.data())) {
    PeakPair& remains = pairs.back();
    remains.other_way =
        *p.residual_slip_m * r.residual_slip_m < 0 && std::min(remains.measured, remains.model) > remains.least;
  }
  add(p.peak_rotation_rad, r.peak_rotation_rad, Channel::rotation);
  add(p.peak_acceleration_g, r.peak_acceleration_mps2 / standard_gravity_mps2, Channel::block_acceleration);
  return pairs;
}

double limited_ln(const PeakPair& pair, const Prediction& prediction) {
  return prediction.failed() ? -ln_ratio_limit : std::clamp(pair.ln(), -ln_ratio_limit, ln_ratio_limit);
}

bool falls(const Prediction& prediction) { return prediction.response.outcome == Outcome::overturned; }

// One fell and the other is known to have stood.
bool parted_by_a_fall(const Test& test, const Prediction& prediction) {
  return test.peaks.overturned && (*test.peaks.overturned != falls(prediction));
}

bool noise_is_stated(const Bench& bench) {
  for (int c = 0; c < channel_count; ++c)
    if (bench.noise(static_cast<Channel>(c)) > 0) return true;
  return false;
}

TestError peak_error(const Bench& bench, std::size_t i, const Prediction& prediction) {
  const Test& test = bench.test(i);
  TestError error;
  for (const double ratio : ln_ratios(bench, i, prediction)) error.score += ratio * ratio;
  const auto in_noise_units = [&](double e) { return noise_is_stated(bench) ? e : no_score; };
  if (parted_by_a_fall(test, prediction))
    return {.score = error.score, .noise_units = in_noise_units(failed_error), .relative = 1};
  if (fell(test)) return {.score = error.score, .noise_units = in_noise_units(0)};
  const auto pairs = peak_pairs(bench, test, prediction.response);
  const auto n = static_cast<double>(std::max<std::size_t>(pairs.size(), 1));
  double square = 0;
  for (const PeakPair& pair : pairs) {
    const double side = pair.other_way ? -1 : 1;
    const double missed = pair.measured > pair.least ? std::abs(side * pair.model / pair.measured - 1)
                                                     : (pair.model > pair.least ? 1.0 : 0.0);
    error.relative = std::max(error.relative, missed);
    square += std::pow((side * pair.model - pair.measured) / pair.noise, 2) / n;
  }
  error.noise_units = std::isfinite(square) ? std::sqrt(square) : no_score;
  return error;
}

}  // namespace

std::vector<double> ln_ratios(const Bench& bench, std::size_t i, const Prediction& prediction) {
  const Test& test = bench.test(i);
  if (fell(test)) return {prediction.failed() || !falls(prediction) ? -ln_ratio_limit : 0};
  const auto pairs = peak_pairs(bench, test, prediction.response);
  std::vector<double> ratios;
  for (const PeakPair& pair : pairs)
    ratios.push_back((parted_by_a_fall(test, prediction) ? ln_ratio_limit : limited_ln(pair, prediction)) /
                     std::sqrt(static_cast<double>(pairs.size())));
  return ratios;
}

void TellingTests::add(std::span<const double> ln_ratios) {
  if (ln_ratios.empty()) return;
  const auto telling = std::ranges::count_if(ln_ratios, [](double ratio) { return ratio != 0; });
  const double share = static_cast<double>(telling) / static_cast<double>(ln_ratios.size());
  shares += share, squares += share * share;
}

TellingTests telling_tests(const Bench& bench, const std::vector<std::size_t>& tests, const ModelSpec& model,
                           const Values& x) {
  TellingTests telling;
  for (const std::size_t i : tests) telling.add(ln_ratios(bench, i, predict(model, bench.test(i), x)));
  return telling;
}

bool sides_are_known(const Dataset& data) {
  return std::any_of(data.tests.begin(), data.tests.end(),
                     [](const Test& test) { return test.peaks.residual_slip_m.value_or(0) < 0; });
}

bool fell(const Test& test) { return test.peaks.overturned.value_or(false); }

bool peaks_compare(const Test& test, const Response& model) {
  return test.has_history() || !(fell(test) || model.outcome == Outcome::overturned);
}

Kind kind(const Test& test) {
  if (test.has_history()) return Kind::history;
  const Peaks& p = test.peaks;
  return p.peak_slip_m || p.residual_slip_m || p.peak_rotation_rad || p.peak_acceleration_g ? Kind::peaks
                                                                                            : Kind::outcome;
}

Kind kind_of_set(const Bench& bench) {
  const auto tests = tests_of(bench.data(), Role::calibration);
  return tests.empty() ? Kind::history : kind(bench.test(tests.front()));
}

double least_motion(const Bench& bench, Channel channel) {
  const double unit = channel == Channel::block_acceleration ? standard_gravity_mps2 : 1;
  if (bench.noise(channel) > 0) return bench.noise(channel) / unit;
  double greatest = 0;
  const auto see = [&](const std::optional<double>& peak) {
    greatest = std::max(greatest, std::abs(peak.value_or(0)));
  };
  for (const std::size_t i : tests_of(bench.data(), Role::calibration)) {
    if (fell(bench.test(i))) continue;  // its peaks may hold the fall
    const Peaks& p = bench.test(i).peaks;
    if (channel == Channel::slip)
      see(p.peak_slip_m), see(p.residual_slip_m);
    else
      see(channel == Channel::rotation ? p.peak_rotation_rad : p.peak_acceleration_g);
  }
  return std::max(1e-6, 1e-3 * greatest);
}

bool moves(const Bench& bench, std::size_t i, Channel channel) {
  const auto& samples = history(bench.test(i), channel);
  return std::any_of(samples.begin(), samples.end(),
                     [&](double s) { return std::abs(s) > moving * bench.noise(channel); });
}

bool moves(const Bench& bench, std::size_t i) {
  return moves(bench, i, Channel::slip) || moves(bench, i, Channel::rotation);
}

TestError outcome_error(const Test& test, double probability) {
  const double y = test.peaks.overturned.value_or(false) ? 1 : 0;
  return {.score = (probability - y) * (probability - y),
          .noise_units = no_score,
          .relative = no_score,
          .probability = probability};
}

TestError test_error(const Bench& bench, std::size_t i, const Prediction& prediction) {
  return kind(bench.test(i)) == Kind::history ? history_error(bench, i, prediction) : peak_error(bench, i, prediction);
}

TestError test_error(const Bench& bench, std::size_t i, const ModelSpec& model, std::span<const double> x) {
  return test_errors(bench, {i}, model, x).front();
}

namespace {

std::vector<const Test*> those(const Bench& bench, const std::vector<std::size_t>& tests) {
  std::vector<const Test*> all;
  for (const std::size_t i : tests) all.push_back(&bench.test(i));
  return all;
}

}  // namespace

std::vector<std::vector<TestError>> test_errors(const Bench& bench, const std::vector<std::size_t>& tests,
                                                const ModelSpec& model, const std::vector<Values>& points) {
  std::vector<std::vector<TestError>> errors(points.size(), std::vector<TestError>(tests.size()));
  std::vector<std::size_t> others, places, outcomes, outcome_places;
  for (std::size_t k = 0; k < tests.size(); ++k) {
    const bool outcome = kind(bench.test(tests[k])) == Kind::outcome;
    (outcome ? outcomes : others).push_back(tests[k]);
    (outcome ? outcome_places : places).push_back(k);
  }
  predict(model, those(bench, others), points, [&](std::size_t point, std::size_t k, const Prediction& prediction) {
    errors[point][places[k]] = test_error(bench, others[k], prediction);
  });
  for (std::size_t point = 0; point < points.size(); ++point) {
    const auto probabilities = overturning_probabilities(bench, outcomes, model, points[point]);
    for (std::size_t k = 0; k < outcomes.size(); ++k)
      errors[point][outcome_places[k]] = outcome_error(bench.test(outcomes[k]), probabilities[k]);
  }
  return errors;
}

std::vector<TestError> test_errors(const Bench& bench, const std::vector<std::size_t>& tests, const ModelSpec& model,
                                   std::span<const double> x) {
  return test_errors(bench, tests, model, std::vector<Values>{{x.begin(), x.end()}}).front();
}

std::vector<double> mean_scores(const Bench& bench, const std::vector<std::size_t>& tests, const ModelSpec& model,
                                const std::vector<Values>& points) {
  std::vector<double> means;
  for (const auto& errors : test_errors(bench, tests, model, points)) {
    double sum = 0;
    for (const TestError& error : errors) sum += error.score;
    means.push_back(sum / static_cast<double>(std::max<std::size_t>(tests.size(), 1)));
  }
  return means;
}

double mean_score(const Bench& bench, const std::vector<std::size_t>& tests, const ModelSpec& model,
                  std::span<const double> x) {
  return mean_scores(bench, tests, model, {Values(x.begin(), x.end())}).front();
}

std::vector<double> mean_stride_scores(const Bench& bench, const std::vector<std::size_t>& tests,
                                       const ModelSpec& model, const std::vector<Values>& points) {
  std::vector<double> means(points.size());
  predict(model, those(bench, tests), points, [&](std::size_t point, std::size_t k, const Prediction& prediction) {
    means[point] += stride_score(bench, bench.test(tests[k]), prediction);
  });
  for (double& mean : means) mean /= static_cast<double>(std::max<std::size_t>(tests.size(), 1));
  return means;
}

double explained_error(const Bench& bench, std::size_t i, const Prediction& prediction, const Spread& spread) {
  double square = 0;
  int channels = 0;
  if (prediction.failed()) return failed_error;
  each_channel(bench, bench.test(i), prediction,
               [&](Channel channel, double noise, const auto& measured, const auto& model) {
                 const auto& variance = spread[static_cast<std::size_t>(channel)];
                 double sum = 0;
                 for (std::size_t k = 0; k < measured.size(); ++k)
                   sum += std::pow(model[k] - measured[k], 2) / (noise * noise + variance[k]);
                 square += sum / static_cast<double>(measured.size());
                 ++channels;
               });
  return std::sqrt(square / std::max(channels, 1));
}

namespace {

// besides(channel): what is added to the mean square of each.
template <class Besides>
double root_mean_square(const Bench& bench, const Spread& spread, Besides&& besides) {
  double square = 0;
  int channels = 0;
  for (std::size_t c = 0; c < spread.size(); ++c) {
    const auto channel = static_cast<Channel>(c);
    const double noise = bench.noise(channel);
    if (spread[c].empty() || !(noise > 0)) continue;
    double sum = 0;
    for (const double v : spread[c]) sum += v / (noise * noise);
    square += besides(channel) + sum / static_cast<double>(spread[c].size());
    ++channels;
  }
  return std::sqrt(square / std::max(channels, 1));
}

}  // namespace

double expected_error(const Bench& bench, const Spread& spread) {
  return root_mean_square(bench, spread, [&](Channel channel) { return std::pow(bench.sensor(channel).size(), 2); });
}

double size_of(const Bench& bench, const Spread& spread) {
  return root_mean_square(bench, spread, [](Channel) { return 0.0; });
}

std::vector<std::size_t> tests_of(const Dataset& data, Role role) {
  std::vector<std::size_t> tests;
  for (std::size_t i = 0; i < data.tests.size(); ++i)
    if (data.tests[i].role == role) tests.push_back(i);
  return tests;
}

}  // namespace freestand::measurement
