#include "hidden_effect/make_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/units.hpp"
#include "hidden_effect/shaking.hpp"
#include "support/keyed_random.hpp"

namespace freestand::test {
namespace {

constexpr double dt_s = 0.005;       // of the sensors
constexpr double step_s = 2.5e-5;    // of the stepper
constexpr double coarse_s = 2.5e-4;  // while the plain model's mu is looked for

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
  Maker(const SetRequest& request, std::uint64_t attempt)
      : request_(request), key_(key_of(request.effects) + attempt * 0x9e3779b97f4a7c15ULL) {}

  MadeSet operator()() {
    KeyedRandom random = numbers(0);
    MadeSet set;
    set.name = set_name(request_);
    set.drawn = draw_truth(random, request_.effects);
    set.slip_noise_m = random.uniform(0.00028, 0.0006);
    set.rotation_noise_rad = random.uniform(0.0002, 0.0006);
    set.floor_noise_mps2 = random.uniform(0.005, 0.01);
    const bool vertical = shakes_vertically(set.drawn.truth) || random.chance(0.5);
    const int held_out = std::max(1, static_cast<int>(std::lround(0.3 * request_.tests)));
    for (int i = 0; i < request_.tests; ++i) {
      MadeTest test;
      test.id = (i < 9 ? "t0" : "t") + std::to_string(i + 1);
      test.holdout = i >= request_.tests - held_out;
      KeyedRandom own = numbers(static_cast<std::uint64_t>(i) + 1);
      shake(own, set.drawn, vertical, test);
      set.tests.push_back(test);
    }
    return set;
  }

  void measure(MadeSet& set) const {
    for (std::size_t i = 0; i < set.tests.size(); ++i) {
      KeyedRandom random = numbers(1000 + i);
      const auto noisy = [&](std::vector<double> values, double deviation) {
        for (double& value : values) value += deviation * random.normal();
        return values;
      };
      MadeTest& test = set.tests[i];
      test.measured_floor = {dt_s, noisy(test.floor.horizontal_mps2, set.floor_noise_mps2),
                             noisy(test.floor.vertical_mps2, set.floor_noise_mps2)};
      test.slip_m = noisy(test.truth.slip_m, set.slip_noise_m);
      if (set.drawn.habit != Habit::slides) test.rotation_rad = noisy(test.truth.rotation_rad, set.rotation_noise_rad);
    }
  }

 private:
  KeyedRandom numbers(std::uint64_t stream) const { return {request_.seed, key_ ^ (stream << 32)}; }

  // A motion that moves the specimen as it should, out of as many as it takes.
  void shake(KeyedRandom& random, const DrawnTruth& d, bool vertical, MadeTest& test) const {
    for (int motion = 0; motion < 50; ++motion) {
      test.floor = draw_floor(random, d, vertical);
      for (int trial = 0; trial < 8; ++trial) {
        test.truth = simulate(d.truth, test.floor, step_s);
        const double factor = rescaling(d, test.truth);
        if (factor == 0) return;
        scale(test.floor, factor);
      }
    }
    throw std::runtime_error(set_name(request_) + ": no floor motion moves the specimen without overturning it");
  }

  // Strong enough to pass what holds the block by 1.3 to 3.2 times.
  FloorSamples draw_floor(KeyedRandom& random, const DrawnTruth& d, bool vertical) const {
    const double which = random.unit();
    const Shaking kind = which < 0.35 ? Shaking::pulse : which < 0.8 ? Shaking::stochastic : Shaking::both;
    FloorSamples floor{dt_s, draw_shaking(random, kind, {}, dt_s, request_.duration_s), {}};
    const double hold_mps2 = standard_gravity_mps2 * std::min(d.truth.mu_s, d.width_m / d.height_m);
    const double peak_mps2 = hold_mps2 * random.uniform(1.3, 3.2);
    scale(floor, peak_mps2);
    if (!vertical) return floor;
    const bool still = kind == Shaking::pulse && random.chance(0.5);
    floor.vertical_mps2 = draw_vertical(random, dt_s, floor.horizontal_mps2.size());
    const double peak = still ? 0 : std::min(6.0, std::max(2.0, peak_mps2) * random.uniform(0.5, 0.9));
    for (double& value : floor.vertical_mps2) value *= peak;
    return floor;
  }

  const SetRequest& request_;
  std::uint64_t key_;
};

double squared_error(const MadeSet& set, const Truth& model) {
  double sum = 0;
  for (const MadeTest& test : set.tests) {
    const TruthHistory history = simulate(model, test.floor, coarse_s);
    double own = 0;
    for (std::size_t i = 0; i < history.slip_m.size(); ++i) {
      const double slip = (history.slip_m[i] - test.truth.slip_m[i]) / set.slip_noise_m;
      const double turn = (history.rotation_rad[i] - test.truth.rotation_rad[i]) / set.rotation_noise_rad;
      own += set.drawn.habit == Habit::slides ? slip * slip : 0.5 * (slip * slip + turn * turn);
    }
    sum += own / static_cast<double>(history.slip_m.size() * set.tests.size());
  }
  return sum;
}

// With the effects that are given only, and the mu that suits them best: steps of 24, 12, 6, 3 % as long as they help.
double error_with(const MadeSet& set, const std::vector<TruthEffect>& effects) {
  Truth model = set.drawn.truth;
  model.effects = effects;
  double best_mu = model.mu_k, best = squared_error(set, model);
  if (set.drawn.habit == Habit::rocks) return std::sqrt(best);
  for (double width = 0.24; width > 0.02; width *= 0.5)
    for (int walk = 0; walk < 4; ++walk) {
      const double from = best_mu;
      for (const double mu : {from * (1 - width), from * (1 + width)}) {
        model.mu_s = model.mu_k = mu;
        if (const double error = squared_error(set, model); error < best) best = error, best_mu = mu;
      }
      if (best_mu == from) break;
    }
  return std::sqrt(best);
}

// Least error of those models that lack one of the hidden effects: how far each of them shows.
double weakest(const MadeSet& set) {
  const auto& hidden = set.drawn.truth.effects;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hidden.size(); ++i) {
    std::vector<TruthEffect> others = hidden;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    least = std::min(least, error_with(set, others));
  }
  return least;
}

}  // namespace

std::string set_name(const SetRequest& request) {
  std::string name;
  for (const std::string& effect : request.effects) name += (name.empty() ? "" : "+") + effect;
  return (name.empty() ? "none" : name) + "-" + std::to_string(request.seed);
}

MadeSet make_set(const SetRequest& request) {
  MadeSet set;
  for (std::uint64_t attempt = 0; attempt < 8; ++attempt) {
    Maker maker(request, attempt);
    set = maker();
    maker.measure(set);
    if (request.effects.empty()) break;
    set.plain_error = error_with(set, {});
    set.weakest_error = request.effects.size() == 1 ? set.plain_error : weakest(set);
    if (set.plain_error >= request.least_error && set.weakest_error >= request.least_error) break;
  }
  return set;
}

}  // namespace freestand::test
