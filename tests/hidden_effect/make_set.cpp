#include "hidden_effect/make_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "base/units.hpp"
#include "hidden_effect/laboratory.hpp"
#include "hidden_effect/set_errors.hpp"
#include "hidden_effect/shaking.hpp"
#include "support/keyed_random.hpp"

namespace freestand::test {
namespace {

constexpr double floor_hz = 200;   // steps of floors
constexpr double step_s = 2.5e-5;  // of the stepper
constexpr double followed = 1.15;  // [noise units] error of the truth on the floor as measured

// FNV-1a: effects of other names draw other numbers.
std::uint64_t key_of(const std::vector<std::string>& effects) {
  std::uint64_t key = 0xcbf29ce484222325ULL;
  for (const std::string& effect : effects)
    for (const char letter : effect + "+") key = (key ^ static_cast<unsigned char>(letter)) * 0x100000001b3ULL;
  return key;
}

bool shakes_vertically(const Truth& truth) {
  return std::any_of(truth.effects.begin(), truth.effects.end(),
                     [](const TruthEffect& effect) { return effect.name == "vertical_shaking"; });
}

void scale(FloorSamples& floor, double factor) {
  for (double& value : floor.horizontal_mps2) value *= factor;
}

// 0 where the specimen moves enough and not too much, else the factor to try next.
double rescaling(const DrawnTruth& d, const TruthHistory& history) {
  if (history.outcome == "overturned" || history.outcome == "painleve") return 0.7;
  const double turned = history.peak_rotation_rad / std::atan(d.width_m / d.height_m), slid = history.peak_slip_m;
  if (turned > 0.6 || slid > 0.6) return 0.85;
  const bool little = d.habit == Habit::slides ? slid < 0.015 : d.habit == Habit::rocks ? turned < 0.1 : slid < 0.008;
  return little ? 1.25 : 0;
}

class Maker {
 public:
  Maker(const SetRequest& request, std::uint64_t attempt, double strength)
      : request_(request),
        strength_(strength),
        key_(key_of(request.effects) + attempt * 0x9e3779b97f4a7c15ULL),
        dt_s_(1 / std::max(floor_hz, request.rate_hz)) {}

  MadeSet operator()() {
    KeyedRandom random = numbers(0);
    MadeSet set;
    set.name = set_name(request_);
    set.drawn = draw_truth(random, request_.effects, strength_);
    set.slip_noise_m = random.uniform(0.00028, 0.0006);
    set.rotation_noise_rad = random.uniform(0.0002, 0.0006);
    set.floor_noise_mps2 = random.uniform(0.005, 0.01);
    const bool vertical = shakes_vertically(set.drawn.truth) || random.chance(0.5);
    const int held_out = std::max(1, static_cast<int>(std::lround(0.3 * request_.tests)));
    for (int i = 0; i < request_.tests; ++i) {
      MadeTest test;
      test.id = (i < 9 ? "t0" : "t") + std::to_string(i + 1);
      test.holdout = i >= request_.tests - held_out;
      set.tests.push_back(made(set, std::move(test), vertical, numbers(static_cast<std::uint64_t>(i) + 1)));
    }
    return set;
  }

 private:
  KeyedRandom numbers(std::uint64_t stream) const { return {request_.seed, key_ ^ (stream << 32)}; }

  // With a motion that moves the specimen as it should, and that a model can follow: out of as many as it takes, or the
  // one out of many that can be followed best.
  MadeTest made(const MadeSet& set, MadeTest test, bool vertical, KeyedRandom random) const {
    const bool any = !test.holdout && random.chance(0.2);
    MadeTest best;
    best.truth_error = std::numeric_limits<double>::infinity();
    for (int motion = 0; motion < 60 && best.truth_error > (any || request_.unpicked ? 1e9 : followed); ++motion) {
      if (!shake(random, set.drawn, vertical, test)) continue;
      measure(random, set, test);
      test.truth_error = error_of(set, test, simulate(set.drawn.truth, test.measured_floor, step_s));
      if (test.truth_error < best.truth_error) best = test;
    }
    if (best.id.empty())
      throw std::runtime_error(set.name + ": no floor motion moves the specimen without overturning it");
    return best;
  }

  void measure(KeyedRandom& random, const MadeSet& set, MadeTest& test) const {
    const auto noisy = [&](std::vector<double> values, double deviation) {
      for (double& value : values) value += deviation * random.normal();
      return values;
    };
    test.measured_floor = {dt_s_, noisy(test.floor.horizontal_mps2, set.floor_noise_mps2),
                           noisy(test.floor.vertical_mps2, set.floor_noise_mps2)};
    test.slip_m = noisy(test.truth.slip_m, set.slip_noise_m);
    if (set.drawn.habit != Habit::slides) test.rotation_rad = noisy(test.truth.rotation_rad, set.rotation_noise_rad);
  }

  bool shake(KeyedRandom& random, const DrawnTruth& d, bool vertical, MadeTest& test) const {
    test.floor = draw_floor(random, d, vertical);
    for (int trial = 0; trial < 8; ++trial) {
      test.truth = simulate(d.truth, test.floor, step_s);
      const bool fell = test.truth.outcome == "overturned" || test.truth.outcome == "painleve";
      const double factor = request_.unpicked && !fell ? 0 : rescaling(d, test.truth);
      if (factor == 0) return true;
      scale(test.floor, factor);
    }
    return false;
  }

  // Strong enough to pass what holds the block by 1.3 to 3.2 times.
  FloorSamples draw_floor(KeyedRandom& random, const DrawnTruth& d, bool vertical) const {
    const double which = random.unit();
    const Shaking kind = which < 0.35 ? Shaking::pulse : which < 0.8 ? Shaking::stochastic : Shaking::both;
    FloorSamples floor{dt_s_, draw_shaking(random, kind, {}, dt_s_, request_.duration_s), {}};
    const double hold = std::min(request_.unpicked ? d.truth.mu_k : d.truth.mu_s, d.width_m / d.height_m);
    const double times = request_.unpicked ? random.uniform(1.2, 3) : random.uniform(1.3, 3.2);
    const double peak_mps2 = standard_gravity_mps2 * hold * times;
    scale(floor, peak_mps2);
    if (!vertical) return floor;
    const bool still = kind == Shaking::pulse && random.chance(0.5);
    floor.vertical_mps2 = draw_vertical(random, dt_s_, floor.horizontal_mps2.size());
    const double peak = still ? 0 : std::min(6.0, std::max(2.0, peak_mps2) * random.uniform(0.5, 0.9));
    for (double& value : floor.vertical_mps2) value *= peak;
    return floor;
  }

  const SetRequest& request_;
  double strength_;
  std::uint64_t key_;
  double dt_s_;
};

// What is slower than 0.4 times the rate at which every so many-th value is read: the filter of a recorder, which delays nothing.
// The ideal one, in a Hann window of eight readings to either side; the floor is still before and after.
std::vector<double> filtered(const std::vector<double>& values, std::size_t every) {
  const double cut = 0.8 / static_cast<double>(every);  // in half the rate of the values
  const auto half = static_cast<std::ptrdiff_t>(8 * every), count = static_cast<std::ptrdiff_t>(values.size());
  std::vector<double> weights;
  for (std::ptrdiff_t k = -half; k <= half; ++k) {
    const double x = pi * static_cast<double>(k), window = 0.5 * (1 + std::cos(x / static_cast<double>(half + 1)));
    weights.push_back(window * (k == 0 ? cut : std::sin(cut * x) / x));
  }
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<double> passed(values.size());
  for (std::ptrdiff_t i = 0; i < count; ++i)
    for (std::ptrdiff_t k = -half; k <= half; ++k)
      if (i + k >= 0 && i + k < count)
        passed[static_cast<std::size_t>(i)] +=
            weights[static_cast<std::size_t>(k + half)] / all * values[static_cast<std::size_t>(i + k)];
  return passed;
}

// Every so many-th reading alone.
void thin(std::vector<double>& samples, std::size_t every) {
  for (std::size_t i = 0; i * every < samples.size(); ++i) samples[i] = samples[i * every];
  samples.resize((samples.size() + every - 1) / every);
}

// The noise comes behind the filter.
void filter(std::vector<double>& measured, const std::vector<double>& floor, std::size_t every) {
  const std::vector<double> passed = filtered(floor, every);
  for (std::size_t i = 0; i < measured.size(); ++i) measured[i] += passed[i] - floor[i];
}

void read_slower(MadeSet& set, std::size_t every) {
  for (MadeTest& test : set.tests) {
    if (set.fault != "no_filter") {
      filter(test.measured_floor.horizontal_mps2, test.floor.horizontal_mps2, every);
      filter(test.measured_floor.vertical_mps2, test.floor.vertical_mps2, every);
    }
    for (auto* samples : {&test.measured_floor.horizontal_mps2, &test.measured_floor.vertical_mps2, &test.slip_m,
                          &test.rotation_rad, &test.truth.slip_m, &test.truth.rotation_rad})
      thin(*samples, every);
    test.measured_floor.dt_s *= static_cast<double>(every);
    test.truth.dt_s *= static_cast<double>(every);
    test.truth_error = error_of(set, test, simulate(set.drawn.truth, test.measured_floor, step_s));
  }
}

}  // namespace

std::string set_name(const SetRequest& request) {
  std::string name;
  for (const std::string& effect : request.effects) name += (name.empty() ? "" : "+") + effect;
  return (name.empty() ? "none" : name) + "-" + std::to_string(request.seed) + (request.weak ? "-weak" : "") +
         (request.rate_hz == floor_hz ? "" : "-" + std::to_string(std::lround(request.rate_hz)) + "hz");
}

namespace {

MadeSet with_its_errors(const SetRequest& request, std::uint64_t attempt, double strength) {
  MadeSet set = Maker(request, attempt, strength)();
  if (request.effects.empty()) return set;
  set.plain_error = error_with(set, {});
  set.weakest_error = weakest_error(set);
  return set;
}

MadeSet strong_set(const SetRequest& request) {
  MadeSet set;
  for (std::uint64_t attempt = 0; attempt < 8; ++attempt) {
    set = with_its_errors(request, attempt, 1);
    if (request.effects.empty() || (set.plain_error >= request.least_error && set.weakest_error >= request.least_error))
      break;
  }
  return set;
}

// The error grows about as the strength does; a wall or a slack that is out of reach makes none, so that the strength is
// sought between what made too much and what made too little.
MadeSet weak_set(const SetRequest& request) {
  constexpr double least = 1, most = 6;
  const double wanted = KeyedRandom(request.seed, key_of(request.effects) + 1).log_uniform(least, most);
  double strength = 1, too_little = 0, too_much = std::numeric_limits<double>::infinity();
  MadeSet set = with_its_errors(request, 0, strength);
  for (int trial = 0; trial < 12 && !request.effects.empty(); ++trial) {
    const double error = set.weakest_error;
    if (error >= least && error <= most) break;
    (error < least ? too_little : too_much) = strength;
    const bool between = too_little > 0 && std::isfinite(too_much);
    strength = between ? std::sqrt(too_little * too_much) : strength * std::clamp(wanted / error, 0.2, 5.0);
    set = with_its_errors(request, 0, strength);
  }
  return set;
}

}  // namespace

MadeSet make_set(const SetRequest& request) {
  MadeSet set = request.weak ? weak_set(request) : strong_set(request);
  if (!request.fault.empty()) spoil(set, request.fault, {request.seed, key_of({request.fault})}, step_s);
  if (request.rate_hz < floor_hz) read_slower(set, static_cast<std::size_t>(std::lround(floor_hz / request.rate_hz)));
  return set;
}

}  // namespace freestand::test
