#include "measurement/tell/compare.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.hpp"
#include "base/units.hpp"
#include "measurement/data/smooth.hpp"
#include "measurement/levels.hpp"
#include "measurement/tell/findings.hpp"

namespace freestand::measurement {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t bins = 10;
constexpr double half_smoothing_s = 0.03;  // of the smoothing that tells speed and direction

ChannelError channel_error(Channel channel, double noise, const std::vector<double>& measured,
                           const std::vector<double>& model) {
  ChannelError error{.channel = channel};
  double square = 0, peak = 0, lagged = 0, centred = 0;
  const auto n = static_cast<double>(measured.size());
  for (std::size_t k = 0; k < measured.size(); ++k) {
    error.bias += (model[k] - measured[k]) / n;
    square += std::pow(model[k] - measured[k], 2) / n;
    peak = std::max(peak, std::abs(measured[k]));
  }
  for (std::size_t k = 0; k < measured.size(); ++k) {
    const double r = model[k] - measured[k] - error.bias;
    centred += r * r;
    if (k > 0) lagged += r * (model[k - 1] - measured[k - 1] - error.bias);
  }
  error.noise_units = noise > 0 ? std::sqrt(square) / noise : unknown;
  error.relative = peak > 0 ? std::sqrt(square) / peak : unknown;
  error.autocorrelation = centred > 0 ? lagged / centred : 0;
  return error;
}

// One sample of a history with what it is put into bins by.
struct Sample {
  double residual, growth, slip_growth_m, rotation_growth_rad;
  Phase phase;
  std::vector<double> at;
};

struct Variable {
  const char *name, *unit;
};
constexpr Variable variables[] = {{"speed_mps", "m/s"}, {"path_m", "m"}, {"position_m", "m"}, {"direction", "1"},
                                  {"normal_g", "g"},    {"time_s", "s"}, {"floor_g", "g"}};
constexpr std::size_t of_slip = 4;  // the first of them

// Without slip: by rotation alone, with speed, path, position and direction of slip at zero.
void add_samples(const Bench& bench, const TestComparison& c, std::vector<Sample>& samples) {
  const Test& test = bench.test(c.test);
  const bool slides = !test.slip_m.empty() && bench.noise(Channel::slip) > 0;
  if (!slides && (test.rotation_rad.empty() || bench.noise(Channel::rotation) <= 0)) return;
  const Smooth motion = slides ? smooth(test.slip_m, test.dt_s, half_smoothing_s) : Smooth{};
  const double least = 4 * bench.noise(Channel::slip) * rate_noise(test.dt_s, half_smoothing_s);
  const std::vector<Phase> phase = phases(bench, test);
  const auto lag = std::max<std::size_t>(1, static_cast<std::size_t>(0.1 / test.dt_s));
  const auto missed = [&](Channel channel, std::size_t k) {
    const auto& measured = history(test, channel);
    return measured.empty() || bench.noise(channel) <= 0 ? 0 : c.model.channel(channel)[k] - measured[k];
  };
  const auto residual = [&](std::size_t k) {
    const double slip = slides ? missed(Channel::slip, k) / bench.noise(Channel::slip) : 0;
    const double turn = missed(Channel::rotation, k);
    return std::abs(turn) > std::abs(slip) * bench.noise(Channel::rotation) ? turn / bench.noise(Channel::rotation)
                                                                            : slip;
  };
  const auto growth = [&](auto&& of, std::size_t k) { return k < lag ? 0 : of(k) - of(k - lag); };
  double path = 0;
  for (std::size_t k = 0; k < phase.size(); ++k) {
    const double t = static_cast<double>(k) * test.dt_s, rate = slides ? motion.firm_rate(k) : 0,
                 speed = std::abs(rate);
    const bool slips = slides && speed > least;
    if (slips) path += speed * test.dt_s;
    const double v = test.has_vertical() ? vertical_acceleration({&test.motion, 1, 1, 1}, t) : 0;
    samples.push_back({residual(k),
                       growth(residual, k),
                       growth([&](std::size_t i) { return missed(Channel::slip, i); }, k),
                       growth([&](std::size_t i) { return missed(Channel::rotation, i); }, k),
                       phase[k],
                       {speed, path, slides ? motion.value[k] : 0, slips ? std::copysign(1.0, rate) : 0.0,
                        1 + v / standard_gravity_mps2, t,
                        std::abs(horizontal_acceleration(test.shaking(), t)) / standard_gravity_mps2}});
  }
}

std::vector<double> edges(const std::vector<Sample>& samples, std::size_t variable) {
  if (variable == 3) return {-1.5, -0.5, 0.5, 1.5};
  double low = samples.front().at[variable], high = low;
  for (const Sample& s : samples) {
    low = std::min(low, s.at[variable]);
    high = std::max(high, s.at[variable]);
  }
  std::vector<double> edge;
  for (std::size_t k = 0; k <= bins; ++k) edge.push_back(low + (high - low) * static_cast<double>(k) / bins);
  edge.back() += 1e-9 + 1e-9 * std::abs(high);
  return edge;
}

// bin_of(sample): its bin.
template <class BinOf>
void fill(ErrorTable& table, std::size_t count, const std::vector<Sample>& samples, BinOf&& bin_of) {
  for (auto* column :
       {&table.count, &table.noise_units, &table.growth, &table.slip_growth_m, &table.rotation_growth_rad, &table.bias})
    column->assign(count, 0.0);
  for (const Sample& s : samples) {
    const std::size_t b = std::min(bin_of(s), count - 1);
    ++table.count[b];
    table.noise_units[b] += s.residual * s.residual;
    table.growth[b] += s.growth * s.growth;
    table.slip_growth_m[b] += s.slip_growth_m * s.slip_growth_m;
    table.rotation_growth_rad[b] += s.rotation_growth_rad * s.rotation_growth_rad;
    table.bias[b] += s.residual;
  }
  for (std::size_t b = 0; b < count; ++b) {
    const double n = table.count[b] > 0 ? table.count[b] : unknown;
    for (auto* square : {&table.noise_units, &table.growth, &table.slip_growth_m, &table.rotation_growth_rad})
      (*square)[b] = std::sqrt((*square)[b] / n);
    table.bias[b] /= n;
  }
}

std::vector<ErrorTable> tables(const Bench& bench, const std::vector<TestComparison>& tests, Role role) {
  std::vector<Sample> samples;
  for (const TestComparison& c : tests)
    if (bench.test(c.test).role == role && !c.model.failed() && !(c.expected > drowned)) add_samples(bench, c, samples);
  std::vector<ErrorTable> all;
  if (samples.empty()) return all;
  ErrorTable by_phase{.variable = "phase", .unit = "1"};
  for (int p = 0; p < phase_count; ++p) by_phase.label.push_back(name(static_cast<Phase>(p)));
  fill(by_phase, phase_count, samples, [](const Sample& s) { return static_cast<std::size_t>(s.phase); });
  all.push_back(std::move(by_phase));
  const bool slides = std::any_of(tests.begin(), tests.end(),
                                  [&](const TestComparison& c) { return !bench.test(c.test).slip_m.empty(); });
  for (std::size_t v = slides ? 0 : of_slip; v < std::size(variables); ++v) {
    ErrorTable table{.variable = variables[v].name, .unit = variables[v].unit};
    table.edge = edges(samples, v);
    for (std::size_t b = 0; b + 1 < table.edge.size(); ++b)
      table.centre.push_back(0.5 * (table.edge[b] + table.edge[b + 1]));
    fill(table, table.centre.size(), samples, [&](const Sample& s) {
      const auto above = std::upper_bound(table.edge.begin(), table.edge.end(), s.at[v]);
      return static_cast<std::size_t>(std::max<long>(above - table.edge.begin(), 1) - 1);
    });
    all.push_back(std::move(table));
  }
  return all;
}

std::vector<std::size_t> worst_histories(const Bench& bench, const std::vector<TestComparison>& tests) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < tests.size(); ++i)
    if (bench.test(tests[i].test).has_history()) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return tests[a].error.noise_units > tests[b].error.noise_units;
  });
  order.resize(std::min<std::size_t>(order.size(), 5));
  return order;
}

}  // namespace

const char* name(Phase phase) {
  constexpr const char* names[] = {"stuck", "onset", "slipping", "reversal", "rocking", "after impact", "at rest"};
  return names[static_cast<int>(phase)];
}

std::vector<Phase> phases(const Bench& bench, const Test& test) {
  const bool slides = !test.slip_m.empty();
  const std::size_t n = std::max(test.slip_m.size(), test.rotation_rad.size());
  const auto near = std::max<std::size_t>(1, static_cast<std::size_t>(0.1 / test.dt_s));
  const Smooth motion = slides ? smooth(test.slip_m, test.dt_s, half_smoothing_s) : Smooth{};
  const double least = 4 * bench.noise(Channel::slip) * rate_noise(test.dt_s, half_smoothing_s);
  std::vector<Phase> phase(n, Phase::stuck);
  std::size_t onset = n, last_moving = 0, impact = n, last_stuck_before = 0;
  double last_direction = 0, last_side = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double turn = test.rotation_rad.empty() ? 0 : test.rotation_rad[k];
    const bool rocks = std::abs(turn) > 5 * bench.noise(Channel::rotation) && bench.noise(Channel::rotation) > 0;
    const double rate = slides ? motion.firm_rate(k) : 0,
                 direction = slides && std::abs(rate) > least ? std::copysign(1.0, rate) : 0;
    if (rocks) {
      if (last_side * turn < 0) impact = k;
      last_side = turn;
      phase[k] = impact < n && k < impact + near ? Phase::after_impact : Phase::rocking;
    } else if (direction != 0) {
      const bool turned = last_direction * direction < 0 && k < last_moving + near;
      if (k == 0 || last_stuck_before + 1 == k) onset = k;
      phase[k] = turned || (onset < n && k < onset + near && last_direction * direction < 0) ? Phase::reversal
                 : onset < n && k < onset + near                                             ? Phase::onset
                                                                                             : Phase::slipping;
    }
    if (direction != 0) last_direction = direction;
    if (rocks || direction != 0)
      last_moving = k;
    else
      last_stuck_before = k;
  }
  for (std::size_t k = last_moving + 1; k < n; ++k) phase[k] = Phase::at_rest;
  return phase;
}

TestComparison compare_test(const Bench& bench, std::size_t i, const ModelSpec& model, std::span<const double> x,
                            Spread spread, const Spread& unread) {
  TestComparison c{.test = i, .explained = unknown, .expected = unknown, .unread = unknown};
  const Test& test = bench.test(i);
  c.model = predict(model, test, x);
  c.error = kind(test) == Kind::outcome ? test_error(bench, i, model, x) : test_error(bench, i, c.model);
  if (!test.has_history()) return c;
  c.spread = std::move(spread);
  c.explained = explained_error(bench, i, c.model, c.spread);
  c.expected = expected_error(bench, c.spread);
  c.unread = size_of(bench, unread);
  for (int k = 0; k < channel_count; ++k) {
    const auto channel = static_cast<Channel>(k);
    if (!history(test, channel).empty())
      c.channels.push_back(
          channel_error(channel, bench.noise(channel), history(test, channel), c.model.channel(channel)));
  }
  return c;
}

void give_own_friction(const Bench& bench, const ModelSpec& of_all, const Values& x, double friction_scatter,
                       double freedom, TestComparison& c) {
  constexpr int budget = 40;
  const double beyond = gsl_cdf_tdist_Qinv(gsl_cdf_ugaussian_Q(fault_deviations), freedom),
               once = std::exp(friction_scatter), most = std::min(2.0, std::exp(beyond * friction_scatter));
  const Free factor = {
      .name = "factor", .lower = 1 / most, .upper = most, .low = 1 / most, .high = most, .logarithmic = true};
  ModelSpec model = of_all;
  model.friction_factor = {.free = static_cast<int>(x.size())};
  const Objective left = [&](std::span<const double> own) {
    Values with_own = x;
    with_own.push_back(own[0]);
    return explained_error(bench, c.test, predict(model, bench.test(c.test), with_own), c.spread);
  };
  Fitted best{{1}, left(Values{1})};
  for (const double start : {1 / once, 1.0, once}) {
    Fitted found = simplex({factor}, left, {start}, 0.1, budget);
    if (found.score < best.score) best = std::move(found);
  }
  c.own_friction = best.x[0];
  c.explained = best.score;
}

Comparison compare(const Bench& bench, const ModelSpec& model, std::span<const double> x,
                   std::vector<TestComparison> tests, const Quality& quality,
                   const std::optional<OutcomeMisfit>& misfit) {
  Comparison comparison;
  comparison.misfit = misfit;
  comparison.tests = std::move(tests);
  comparison.worst = worst_histories(bench, comparison.tests);
  comparison.calibration = tables(bench, comparison.tests, Role::calibration);
  comparison.holdout = tables(bench, comparison.tests, Role::holdout);
  comparison.findings = findings(bench, model, x, comparison, quality);
  return comparison;
}

namespace {

// What a sensor shows as the peak of a slip: mean and standard deviation of its logarithm.
struct ShownPeak {
  double ln = 0, deviation_ln = 0;
};

ShownPeak shown_peak(const std::vector<double>& slip, double noise, std::uint64_t key) {
  constexpr int draws = 64, far = 6;  // no noise reaches as far
  double peak = 0, sum = 0, square = 0;
  for (const double s : slip) peak = std::max(peak, std::abs(s));
  for (int draw = 0; draw < draws; ++draw) {
    double most = 0;
    for (std::size_t k = 0; k < slip.size(); ++k)
      if (std::abs(slip[k]) > peak - 2 * far * noise)
        most = std::max(
            most, std::abs(slip[k] + noise * random::standard_normal(1 + static_cast<std::uint64_t>(draw), k, key)));
    sum += std::log(most) / draws;
    square += std::log(most) * std::log(most) / draws;
  }
  return {sum, std::sqrt(std::max(square - sum * sum, 0.0))};
}

}  // namespace

PeakRatio peak_ratio(const Bench& bench, const std::vector<TestComparison>& tests, std::optional<Role> role) {
  std::vector<double> ln, deviation;
  std::vector<std::string> ids;
  PeakRatio ratio{.bias_ln = unknown, .scatter_ln = unknown};
  const double noise = bench.noise(Channel::slip) * bench.sensor(Channel::slip).size();
  for (const TestComparison& c : tests) {
    const Test& test = bench.test(c.test);
    if ((role && test.role != *role) || !peaks_compare(test, c.model.response)) continue;
    double measured = test.peaks.peak_slip_m.value_or(0);
    for (const double slip : test.slip_m) measured = std::max(measured, std::abs(slip));
    const double model = c.model.response.peak_slip_m;
    if (!(measured > 8 * noise) || c.model.failed()) continue;
    if (!(model > 0)) {
      ++ratio.still;
      continue;
    }
    ShownPeak shown{std::log(model), noise / measured};
    if (!test.slip_m.empty() && noise > 0) {
      shown = shown_peak(c.model.slip_m, noise, random::stable_hash(test.id));
      double floor = 0;  // variance
      if (!c.spread.empty())
        for (const double variance : c.spread[static_cast<std::size_t>(Channel::slip)])
          floor = std::max(floor, variance);
      shown.deviation_ln = std::hypot(shown.deviation_ln, std::sqrt(floor) / measured);
    }
    ln.push_back(shown.ln - std::log(measured));
    deviation.push_back(shown.deviation_ln);
    ids.push_back(test.id);
    ratio.noise_ln += shown.deviation_ln * shown.deviation_ln;
  }
  ratio.count = ln.size();
  if (ln.size() < 2) return ratio;
  const auto n = static_cast<double>(ln.size());
  ratio.noise_ln = std::sqrt(ratio.noise_ln / n);
  ratio.bias_ln = ratio.scatter_ln = 0;
  for (const double value : ln) ratio.bias_ln += value / n;
  for (const double value : ln) ratio.scatter_ln += std::pow(value - ratio.bias_ln, 2) / (n - 1);
  ratio.scatter_ln = std::sqrt(ratio.scatter_ln);
  if (const auto odd = odd_one(ln)) {
    const double scatter = std::hypot(odd->scatter_of_others, deviation[odd->which]);
    if (2 * n * gsl_cdf_ugaussian_Q(std::abs(odd->off) / scatter) < chance_level)
      ratio.odd = odd, ratio.odd_test = ids[odd->which];
  }
  if (ratio.count > 2) ratio.within_ln = gsl_cdf_tdist_Pinv(0.975, n - 1) * ratio.scatter_ln / std::sqrt(n);
  return ratio;
}

bool PeakRatio::biased() const {
  const double of_noise = 1.96 * noise_ln / std::sqrt(static_cast<double>(count));
  return std::abs(bias_ln) > std::max({within_ln, of_noise, 0.03});
}

}  // namespace freestand::measurement
