#include "measurement/laboratory/quality.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

#include "measurement/data/resolution.hpp"
#include "measurement/laboratory/laboratory.hpp"
#include "measurement/laboratory/plausible.hpp"
#include "measurement/laboratory/plausible_offsets.hpp"
#include "measurement/laboratory/timing.hpp"
#include "measurement/laboratory/units.hpp"
#include "measurement/levels.hpp"

namespace freestand::measurement {
namespace {

constexpr double much_closer = 1.0;  // of the mean score: the error falls to 60 %

// A data set like this one, but for its signs and times.
Dataset changed(const Dataset& data, bool mirror_slip, bool mirror_rotation, double late_s) {
  Dataset other = data;
  for (Test& test : other.tests)
    for (std::vector<double>* samples : {&test.slip_m, &test.rotation_rad, &test.block_acceleration_mps2}) {
      const bool mirror = samples == &test.rotation_rad ? mirror_rotation : mirror_slip;
      if (mirror)
        for (double& s : *samples) s = -s;
      const std::vector<double> before = *samples;
      const auto n = static_cast<int>(before.size());
      const int late = test.dt_s > 0 ? static_cast<int>(std::lround(late_s / test.dt_s)) : 0;
      for (int i = 0; i < n; ++i)
        (*samples)[static_cast<std::size_t>(i)] = before[static_cast<std::size_t>(std::clamp(i + late, 0, n - 1))];
    }
  return other;
}

// Tests of a set to which the same is to be said.
std::string together(const std::vector<std::string>& ids, const char* one, const char* several) {
  return fmt::format("{} {} {}", ids.size() > 1 ? "tests" : "test", listed(ids), ids.size() > 1 ? several : one);
}

bool has(const Bench& bench, Channel channel) {
  return std::any_of(bench.data().tests.begin(), bench.data().tests.end(),
                     [&](const Test& test) { return !history(test, channel).empty(); });
}

// A sensor that is there and alive.
bool tells(const Bench& bench, const Test& test, Channel channel) {
  const auto& samples = history(test, channel);
  return bench.noise(channel) > 0 &&
         std::any_of(samples.begin(), samples.end(), [&](double s) { return s != samples[0]; });
}

// Does a reading lie further off than the furthest of so many by noise and drift alone, but for one test in twenty?
bool above_the_noise(const Bench& bench, const Test& test, Channel channel) {
  const auto& samples = history(test, channel);
  const auto n = static_cast<double>(samples.size());
  const Sensor& sensor = bench.sensor(channel);
  const double scatter = std::hypot(std::max(sensor.size(), 1.0), sensor.drift_per_s * n * test.dt_s);
  return greatest(samples) > gsl_cdf_ugaussian_Qinv(chance_level / (2 * n)) * scatter * bench.noise(channel);
}

void look_at_channel(const Bench& bench, Channel channel, Quality& quality) {
  std::vector<std::string> lack, dead, cut, unknown;
  for (std::size_t i = 0; i < bench.size(); ++i) {
    const Test& test = bench.test(i);
    const auto& samples = history(test, channel);
    if (!test.has_history()) continue;
    if (samples.empty()) {
      lack.push_back(test.id);
      if (channel != Channel::block_acceleration && !moves(bench, i)) unknown.push_back(test.id);
    } else if (std::all_of(samples.begin(), samples.end(), [&](double s) { return s == samples[0]; })) {
      dead.push_back(test.id);
    } else if (cut_off(samples, bench.noise(channel))) {
      cut.push_back(test.id);
      quality.wrong_numbers += test.role == Role::calibration && bench.noise(channel) > 0;
    }
  }
  if (!cut.empty())
    quality.findings.push_back(
        fmt::format("{} of {} at its extreme value for several samples: the sensor looks clipped", name(channel),
                    together(cut, "stays", "stays")));
  if (!dead.empty())
    quality.findings.push_back(fmt::format("{} of {}, where a sensor shows its noise: is it alive?", name(channel),
                                           together(dead, "is one number throughout", "is one number throughout")));
  if (!lack.empty() && has(bench, channel))
    quality.findings.push_back(fmt::format(
        "{} {}, which other tests have: errors are of the other channels alone{}", together(lack, "lacks", "lack"),
        name(channel), unknown.empty() ? "" : fmt::format(", and whether {} moved is not known", listed(unknown))));
}

void look_at_channels(const Bench& bench, Quality& quality) {
  const bool histories = std::any_of(bench.data().tests.begin(), bench.data().tests.end(),
                                     [](const Test& test) { return test.has_history(); });
  if (histories && !has(bench, Channel::slip))
    quality.findings.push_back(
        "slip was not measured: models are judged by the rotation alone, friction is told by it as far as it depends "
        "on friction, none can be recovered from the motion, and the clocks of floor and response are not checked by "
        "slips");
  for (int c = 0; c < channel_count; ++c) look_at_channel(bench, static_cast<Channel>(c), quality);
  std::vector<std::string> still;
  bool slips = false, turns = false;
  for (std::size_t i = 0; i < bench.size(); ++i) {
    const Test& test = bench.test(i);
    if (!test.has_history()) continue;
    quality.moving += moves(bench, i);
    const bool slip = tells(bench, test, Channel::slip), turn = tells(bench, test, Channel::rotation);
    if (!(slip || turn)) continue;
    if (slip && above_the_noise(bench, test, Channel::slip)) continue;
    if (turn && above_the_noise(bench, test, Channel::rotation)) continue;
    if ((!slip && has(bench, Channel::slip)) || (!turn && has(bench, Channel::rotation))) continue;
    still.push_back(test.id);
    slips |= slip, turns |= turn;
  }
  if (still.empty()) return;
  const char* what = slips && turns ? "friction and slenderness" : slips ? "friction" : "slenderness";
  quality.findings.push_back(
      together(still, "shows no motion above the noise: it bounds", "show no motion above the noise: they bound") +
      fmt::format(" {} from below, and {} nothing else", what, still.size() > 1 ? "say" : "says"));
}

// A sensor that is not as stated, with its numbers.
void look_at_sensors(const Bench& bench, Quality& quality) {
  for (const Channel channel : {Channel::slip, Channel::rotation, Channel::block_acceleration}) {
    const Sensor& sensor = bench.sensor(channel);
    const double noise = bench.noise(channel);
    if (noise <= 0 && has(bench, channel) && (bench.noise(Channel::slip) > 0 || bench.noise(Channel::rotation) > 0))
      quality.findings.push_back(
          fmt::format("{0} is measured, and counts for nothing, since its noise is not stated (noise: {{{0}: ...}} of "
                      "the data set)",
                      name(channel)));
    const char* unit = channel == Channel::slip ? "m" : channel == Channel::rotation ? "rad" : "m/s2";
    constexpr double worth_a_word = 0.1;  // a size that is nearer to what is stated changes no error in its first digit
    double step = 0;
    for (const std::size_t i : tests_of(bench.data(), Role::calibration))
      step = std::max(step, resolution(readings(bench.test(i), channel)));
    const bool different = std::abs(std::log(sensor.size())) > worth_a_word;
    if (different && noise * sensor.size() < 1.001 * step / std::sqrt(12.0))
      quality.findings.push_back(
          fmt::format("{} is read in steps of {:.2g} {}, and so scatters by {:.2g}, {:.2g} times what is stated: "
                      "models are judged by that",
                      name(channel), step, unit, noise * sensor.size(), sensor.size()));
    else if (different || sensor.coloured > worth_a_word * sensor.size())
      quality.findings.push_back(fmt::format(
          "{} scatters by {:.2g} {} where nothing moves, {:.2g} times what is stated{}: models are judged by that",
          name(channel), noise * sensor.size(), unit, sensor.size(),
          sensor.coloured > 0 ? fmt::format(", and {:.2g} {} of it are correlated over {:.2g} s",
                                            noise * sensor.coloured, unit, sensor.correlation_s)
                              : ""));
    if (sensor.drift_per_s > 0)
      quality.findings.push_back(
          fmt::format("{} drifts away from zero by {:.2g} {}/s (standard deviation over the tests): models are judged "
                      "with that allowed for",
                      name(channel), noise * sensor.drift_per_s, unit));
  }
}

std::string check_clock(const std::string& whose, double late_s) {
  return clock_sentence(whose + " is stamped", late_s) + ": check the clocks of the channels";
}

constexpr const char* check_sign = "looks mirrored: check the sign of slip_m against that of the floor";

// A clock is off by one time: what swings, as contents and legs do, fits the floor nearly as well at others. And of so many lags one fits short
// slips by chance: what is less sure is left to the fits.
bool at_fault(const Timing& timing) {
  return timing.wrong() && timing.p < chance_level && (timing.mirrored || timing.known());
}

struct SlipsSeen {
  bool settled = false;               // enough tests could be judged, so that no model is needed
  std::vector<bool> in_another_unit;  // of each test
};

// So small a factor that springs make it, others in each test, is a unit where most of the other tests are in a unit too, be it the right one.
bool may_be_physical(const std::vector<SlipScale>& scales, std::size_t i) {
  if (std::abs(std::log(scales[i].factor)) > std::log(factor_of_springs)) return false;
  std::size_t others = 0, in_a_unit = 0;
  for (std::size_t j = 0; j < scales.size(); ++j) {
    if (j == i || !scales[j].judged) continue;
    ++others;
    in_a_unit += is_in_a_unit(scales[j].factor);
  }
  return 2 * in_a_unit <= others;
}

// Signs, clocks, units and files of the slips by themselves.
SlipsSeen look_at_slips(const Bench& bench, Quality& quality) {
  std::vector<std::size_t> wrong, mirrored;
  std::vector<double> late;  // [s]; of tests that are wrong
  std::vector<double> each;  // of all that are off by more than a sample
  std::size_t judged = 0;
  const auto tests = tests_of(bench.data(), Role::calibration);
  std::vector<Timing> timings;
  for (std::size_t i = 0; i < bench.size(); ++i) {
    const double dt = bench.test(i).dt_s;
    timings.push_back(dt > 0 ? slip_timing(bench, i, static_cast<int>(longest_lag_s / dt)) : Timing{});
    if (dt <= 0) continue;
    const Timing far = slip_timing(bench, i, static_cast<int>(longest_lag_of_known_sign_s / dt), true);
    if (at_fault(far) && far.gain > timings.back().gain) timings.back() = far;
  }
  std::vector<std::string> in_units;
  SlipsSeen seen{false, std::vector<bool>(bench.size(), false)};
  double largest = 1;  // factor
  const auto others = floors_of_others(bench);
  std::vector<SlipScale> scales;
  for (std::size_t i = 0; i < bench.size(); ++i) scales.push_back(slip_scale(bench, i));
  for (std::size_t i = 0; i < others.size(); ++i) {
    const Test& test = bench.test(i);
    const SlipScale& scale = scales[i];
    if (scale.is_a_unit() && !may_be_physical(scales, i) && scale.gain > std::max(timings[i].gain, others[i].gain)) {
      timings[i] = {};
      in_units.push_back(test.id);
      seen.in_another_unit[i] = true;
      if (std::abs(std::log(scale.factor)) > std::abs(std::log(largest))) largest = scale.factor;
      quality.wrong_numbers += test.role == Role::calibration;
      continue;
    }
    if (!others[i].likelier() || others[i].gain < timings[i].gain) continue;
    timings[i] = {};  // no clock brings it to a floor that is another's
    quality.doubtful += test.role == Role::calibration;
    quality.findings.push_back(fmt::format(
        "the slip of test {} fits the floor of {} better than its own (u'' + a scatters {:.2g} times "
        "less): were files exchanged?{}",
        test.id, bench.test(others[i].test).id, std::sqrt(others[i].gain), held_out_note(bench.data(), {test.id})));
  }
  if (2 * in_units.size() > bench.size())
    timings.assign(bench.size(), {});  // the others' clocks and signs are no surer
  if (!in_units.empty())
    quality.findings.push_back(
        fmt::format("slip_m of {} goes with the floor if it is {:.3g} times what is measured: is it in metres?{}",
                    listed(in_units), largest, held_out_note(bench.data(), in_units)));
  const auto say = [&](std::size_t i) {
    const Test& test = bench.test(i);
    const std::string whose = "the slip of test " + test.id;
    quality.findings.push_back((timings[i].mirrored ? fmt::format("{} {}", whose, check_sign)
                                                    : check_clock(whose, timings[i].late_steps * test.dt_s)) +
                               held_out_note(bench.data(), {test.id}));
  };
  for (const std::size_t i : tests) {
    const double dt = bench.test(i).dt_s;
    judged += timings[i].judged();
    if (timings[i].judged() && !timings[i].mirrored && std::abs(timings[i].late_steps) > 1)
      each.push_back(timings[i].late_steps * dt);
    if (!at_fault(timings[i])) continue;
    wrong.push_back(i);
    if (timings[i].mirrored) mirrored.push_back(i);
    late.push_back(timings[i].late_steps * dt);
  }
  quality.doubtful += wrong.size();
  const auto most = [&](std::size_t count) { return count > 1 && 10 * count >= 7 * judged; };
  if (most(mirrored.size())) {
    quality.mirrored_slip = true;
    quality.findings.push_back(fmt::format("the slip {}", check_sign));
  } else if (most(wrong.size())) {
    std::nth_element(late.begin(), late.begin() + static_cast<long>(late.size() / 2), late.end());
    quality.late_s = late[late.size() / 2];
    quality.findings.push_back(check_clock("the response", quality.late_s));
  } else {
    for (const std::size_t i : wrong) say(i);
    // What alone may be chance is none where most go the same way, and none the other. A friction that follows the speed goes some
    // milliseconds one way in all tests: by less than clocks are known to it is no finding.
    std::sort(each.begin(), each.end());
    if (each.size() > 2 && 3 * each.size() >= 2 * judged && each.front() * each.back() > 0 &&
        std::abs(each[each.size() / 2]) >= bench.data().tolerance.clock_s)
      quality.findings.push_back(fmt::format("in {} of {} tests whose slips tell, friction is steadiest if {}",
                                             each.size(), judged, check_clock("the response", each[each.size() / 2])));
  }
  for (const std::size_t i : tests_of(bench.data(), Role::holdout)) {
    const bool said = timings[i].mirrored ? quality.mirrored_slip : quality.late_s * timings[i].late_steps > 0;
    if (at_fault(timings[i]) && !said) say(i);
  }
  seen.settled = !in_units.empty() || (judged > 1 && 2 * judged >= tests.size());
  return seen;
}

// Mean score of the base with its numbers fitted again to changed data.
double refitted(const Bench& bench, const ModelFit& fit, const Effort& effort) {
  const auto tests = tests_of(bench.data(), Role::calibration);
  const Objective objective = [&](std::span<const double> x) { return mean_score(bench, tests, fit.model, x); };
  double best = objective(fit.x);
  for (const Values& x : sobol_starts(fit.model.free, 12)) best = std::min(best, objective(x));
  return std::min(best, simplex(fit.model.free, objective, fit.x, 0.1, effort.fold_budget).score);
}

}  // namespace

Quality examine(const Bench& bench, const ModelFit& fit, const Effort& effort, const Jobs& jobs) {
  Quality quality;
  Doubts doubtful = doubts(bench);
  quality.findings = std::move(doubtful.sentences);
  quality.wrong_numbers = doubtful.spoilt_tests;
  look_at_channels(bench, quality);
  look_at_sensors(bench, quality);
  const auto [settled, told] = look_at_slips(bench, quality);
  const auto tests = tests_of(bench.data(), Role::calibration);
  if (tests.empty() || !bench.test(tests.front()).has_history() || fit.score < 2 * std::log(2.0)) return quality;
  for (OtherUnit& other : other_units(bench, fit, told)) {
    quality.wrong_numbers += bench.test(other.test).role == Role::calibration;
    quality.findings.push_back(std::move(other.sentence));
  }
  const double dt = bench.test(tests.front()).dt_s;
  const int most = std::max(1, static_cast<int>(longest_lag_s / dt));
  std::vector<double> lags;  // [s]
  for (int late = -most; late <= most && !settled; late += std::max(1, most / 15)) lags.push_back(late * dt);
  bool rotates = false;
  for (const std::size_t i : tests)
    rotates |= greatest(bench.test(i).rotation_rad) > 8 * bench.noise(Channel::rotation);

  // Cases: slip mirrored, rotation mirrored, then the lags, and floors without their offsets.
  const bool slip_asked = !settled && has(bench, Channel::slip);
  const std::optional<Dataset> without_offsets = without_floor_offsets(bench.data());
  const std::size_t cases = 2 + lags.size();
  const auto scores = jobs("signs and times of the channels", cases + (without_offsets ? 1 : 0), [&](std::size_t i) {
    if (i == 0 ? !slip_asked : i == 1 && !rotates) return Values{fit.score};
    const Dataset data = i == cases ? *without_offsets : changed(bench.data(), i == 0, i == 1, i < 2 ? 0 : lags[i - 2]);
    return Values{refitted(Bench(data, 0), fit, effort)};
  });
  if (without_offsets && scores.back()[0] < fit.score - much_closer) {
    quality.wrong_numbers = std::max<std::size_t>(quality.wrong_numbers, 1);
    quality.findings.push_back(
        fmt::format("with the offset of the floor's channel subtracted the model comes {:.1f} times closer",
                    std::exp((fit.score - scores.back()[0]) / 2)));
  }
  if (scores[0][0] < fit.score - much_closer) {
    quality.mirrored_slip = true;
    quality.findings.push_back(fmt::format("the slip {}; with it turned round the model comes {:.1f} times closer",
                                           check_sign, std::exp((fit.score - scores[0][0]) / 2)));
  }
  if (scores[1][0] < fit.score - much_closer) {
    quality.mirrored_rotation = true;
    quality.findings.push_back(
        fmt::format("the rotation looks mirrored: with its sign turned round the model comes "
                    "{:.1f} times closer; rotation_rad is positive clockwise",
                    std::exp((fit.score - scores[1][0]) / 2)));
  }
  if (settled) return quality;
  std::size_t best = 0;
  for (std::size_t i = 0; i < lags.size(); ++i)
    if (scores[2 + i][0] < scores[2 + best][0]) best = i;
  if (lags[best] != 0 && scores[2 + best][0] < fit.score - much_closer && !quality.mirrored_slip) {
    quality.late_s = lags[best];
    quality.findings.push_back(fmt::format("{}; shifted by that the model comes {:.1f} times closer",
                                           check_clock("the response", lags[best]),
                                           std::exp((fit.score - scores[2 + best][0]) / 2)));
  }
  return quality;
}

}  // namespace freestand::measurement
