#include "measurement/tell/suggest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.hpp"
#include "motion/pulse.hpp"

namespace freestand::measurement {
namespace {

constexpr double clear = 4;     // noise units
constexpr double tail_s = 1.0;  // after the pulse

struct Trial {
  std::string pulse;
  double period_s, peak_g, vertical_share, friction_factor;
};

std::vector<Trial> trials(double mu) {
  std::vector<Trial> all;
  const struct { double vertical, friction; } kinds[] = {{0, 1}, {0.6, 1}, {0, 1.5}, {0, 0.67}};
  for (const auto& kind : kinds)
    for (const char* pulse : {"A", "B", "C1", "C2"})
      for (const double period : {0.3, 0.6, 1.2})
        for (const double strength : {1.5, 2.5, 4.0})
          all.push_back({pulse, period, std::min(2.0, strength * std::max(mu, 0.05)), kind.vertical, kind.friction});
  return all;
}

// The test as it would be, without measured values; histories of zeros say which channels there are.
Test planned(const Bench& bench, const Trial& trial) {
  const Test& first = bench.test(tests_of(bench.data(), Role::calibration).front());
  const double dt = first.dt_s > 0 ? first.dt_s : 0.005;
  const motion::Pulse pulse = motion::find_pulse(trial.pulse);
  const double duration = pulse.duration * trial.period_s + tail_s;
  const auto n = static_cast<std::size_t>(duration / dt);
  std::vector<double> floor, vertical;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = static_cast<double>(i) * dt / trial.period_s, fast = 2 * t;
    const double peak = trial.peak_g * standard_gravity_mps2;
    floor.push_back(t < pulse.duration ? peak * pulse.at(t).acceleration : 0);
    vertical.push_back(fast < pulse.duration ? peak * trial.vertical_share * pulse.at(fast).acceleration : 0);
  }
  Test test;
  test.specimen = first.specimen;
  test.dt_s = dt;
  read_floor(test, {"planned", dt, floor, vertical});
  test.slip_m.assign(n, 0);
  test.rotation_rad.assign(bench.noise(Channel::rotation) > 0 ? n : 0, 0);
  return test;
}

ModelSpec changed(const ModelSpec& model, const Trial& trial, const dynamics::Effect* vertical) {
  ModelSpec out = model;
  if (trial.vertical_share > 0 && vertical && goes_with(out, *vertical)) {
    EffectTerm term{.effect = vertical, .parameters = {}};
    for (const auto& p : vertical->parameters) term.parameters.push_back({.value = p.fallback.value_or(1)});
    out.effects.push_back(std::move(term));
  }
  return out;
}

bool of_peaks(const Bench& bench) {
  return kind(bench.test(tests_of(bench.data(), Role::calibration).front())) == Kind::peaks;
}

// scatter: of the measured peaks about the model, in ln.
double distance(const Bench& bench, const Prediction& a, const Prediction& b, double scatter) {
  if (a.failed() || b.failed()) return 0;
  if (of_peaks(bench)) {
    const double least = least_motion(bench, Channel::slip);
    return std::abs(std::log(std::max(a.response.peak_slip_m, least) / std::max(b.response.peak_slip_m, least))) /
           scatter;
  }
  double square = 0;
  for (const Channel channel : {Channel::slip, Channel::rotation}) {
    const auto &p = a.channel(channel), &q = b.channel(channel);
    const double noise = bench.noise(channel);
    for (std::size_t k = 0; noise > 0 && k < p.size(); ++k)
      square += std::pow((p[k] - q[k]) / noise, 2) / static_cast<double>(p.size());
  }
  return std::sqrt(square);
}

double separation(const Bench& bench, const std::vector<ModelFit>& models, const Trial& trial,
                  const dynamics::Effect* vertical) {
  const Test test = planned(bench, trial);
  std::vector<Prediction> predictions;
  for (const ModelFit& fit : models) {
    ModelSpec model = changed(fit.model, trial, vertical);
    Values x = fit.x;
    if (model.mu_k.free >= 0)
      x[static_cast<std::size_t>(model.mu_k.free)] *= trial.friction_factor;
    else
      model.mu_k.value *= trial.friction_factor;
    predictions.push_back(predict(model, test, x));
  }
  const ModelFit& best = models.front();
  const double tests = static_cast<double>(tests_of(bench.data(), Role::calibration).size());
  const double scatter = std::sqrt(best.score * tests / std::max(tests - static_cast<double>(best.x.size()), 1.0));
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < predictions.size(); ++i)
    for (std::size_t j = i + 1; j < predictions.size(); ++j)
      least = std::min(least, distance(bench, predictions[i], predictions[j], scatter));
  return least;
}

std::string sentence(const Bench& bench, const Trial& trial, double separation) {
  std::string text = fmt::format("a pulse {} of {:.2g} s and {:.2g} g", trial.pulse, trial.period_s, trial.peak_g);
  if (trial.vertical_share > 0)
    text += fmt::format(", with a vertical pulse of half that period and {:.2g} g beside it",
                        trial.vertical_share * trial.peak_g);
  if (trial.friction_factor != 1)
    text += fmt::format(", on another pair of surfaces with about {:.2g} times the friction", trial.friction_factor);
  text +=
      of_peaks(bench)
          ? fmt::format(", would part their peak slips by {:.2g} times the scatter of the measured ones", separation)
          : fmt::format(", would part them by {:.3g} noise units", separation);
  return separation < clear ? text + ": the most of those tried, but too little for one test to decide" : text;
}

}  // namespace

Suggestion suggest(const Bench& bench, const std::vector<ModelFit>& models, const dynamics::Effect* vertical,
                   const Jobs& jobs) {
  const std::vector<Trial> all = trials(models.front().model.mu_k.of(models.front().x));
  const auto answers = jobs("looking for a motion that parts them", all.size(),
                            [&](std::size_t i) { return Values{separation(bench, models, all[i], vertical)}; });
  std::size_t best = 0, best_of_kind = 0;
  const std::size_t kind = all.size() / 4;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i % kind == 0) best_of_kind = i;
    if (answers[i][0] > answers[best_of_kind][0]) best_of_kind = i;
    if (answers[i][0] > answers[best][0]) best = i;
    if ((i + 1) % kind == 0 && answers[best_of_kind][0] >= clear) {
      best = best_of_kind;
      break;
    }
  }
  const Trial& t = all[best];
  return {t.pulse,
          t.period_s,
          t.peak_g,
          t.vertical_share,
          t.friction_factor,
          answers[best][0],
          sentence(bench, t, answers[best][0])};
}

}  // namespace freestand::measurement
