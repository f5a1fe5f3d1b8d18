#include "measurement/fit/starts.hpp"

#include <algorithm>
#include <cmath>

namespace freestand::measurement {
namespace {

std::vector<Free> own_numbers(const ModelSpec& model, std::size_t known) {
  return {model.free.begin() + static_cast<long>(known), model.free.end()};
}

Values joined(Values x, const Values& own) {
  x.insert(x.end(), own.begin(), own.end());
  return x;
}

}  // namespace

ModelSpec within_reach(const ModelSpec& joined, const ModelSpec& base, const Values& known, const Reach& reach) {
  ModelSpec model = joined;
  std::copy(base.free.begin(), base.free.end(), model.free.begin());
  if (!known.empty()) narrow(model, known, base.free.size());
  for (std::size_t e = base.effects.size(); e < model.effects.size(); ++e) {
    const EffectTerm& term = model.effects[e];
    for (std::size_t p = 0; p < term.parameters.size(); ++p)
      if (const int place = term.parameters[p].free; place >= 0)
        model.free[static_cast<std::size_t>(place)] = free_parameter(*term.effect, term.effect->parameters[p], reach);
  }
  return model;
}

void narrow(ModelSpec& model, const Values& x, std::size_t numbers) {
  for (std::size_t i = 0; i < numbers; ++i) {
    Free& free = model.free[i];
    if (free.name.rfind("effects.", 0) == 0) continue;
    const double z = to_unit(free, x[i]);
    const double half = free.logarithmic ? std::log(1.6) / std::log(free.high / free.low) : 0.15;
    const double low = from_unit(free, z - half), high = from_unit(free, z + half);
    free.low = low;
    free.high = high;
  }
}

std::vector<Values> at_the_ends(const ModelSpec& model, const Values& x, std::size_t numbers) {
  std::vector<Values> points;
  for (std::size_t i = 0; i < numbers; ++i)
    for (const double end : {model.free[i].upper, model.free[i].lower}) {
      points.push_back(x);
      points.back()[i] = end;
    }
  return points;
}

std::vector<Values> vantage_points(const ModelFit& fit) {
  std::vector<Values> points = at_the_ends(fit.model, fit.x, fit.x.size());
  points.insert(points.begin(), fit.x);
  return points;
}

std::vector<Values> starts_from(const std::vector<Values>& vantage, const ModelSpec& model, std::size_t count) {
  std::vector<Values> starts;
  for (const Values& known : vantage) {
    const auto own = own_numbers(model, known.size());
    for (const Values& x : sobol_starts(own, count)) starts.push_back(joined(known, x));
    for (std::size_t i = 0; i < own.size(); ++i)
      for (const double landmark : own[i].landmarks)
        for (Values& x : sobol_starts(own, count / 4)) {
          x[i] = landmark;
          starts.push_back(joined(known, x));
        }
  }
  return starts;
}

std::vector<Values> starts_anywhere(const ModelSpec& model, std::size_t per_number) {
  return sobol_starts(model.free, per_number * model.free.size());
}

Values start_at_nothing(const ModelFit& fit, const dynamics::Effect& effect) {
  Values x = fit.x;
  for (const auto& p : effect.parameters) {
    if (!p.fitted) continue;
    const double nothing =
        p.neutral && std::isfinite(*p.neutral) ? *p.neutral : p.fallback.value_or(0.5 * (p.low + p.high));
    x.push_back(std::clamp(nothing, p.low > 0 ? 0.001 * p.low : p.lower, p.upper));
  }
  return x;
}

bool changes_predictions(const Bench& bench, const ModelFit& fit, const std::vector<Values>& vantage,
                         const dynamics::Effect& effect) {
  constexpr std::size_t points = 5;
  const auto tests = tests_of(bench.data(), Role::calibration);
  const ModelSpec model = with_effect(fit.model, effect, bench.reach());
  for (const Values& known : vantage) {
    const auto without = test_errors(bench, tests, fit.model, known);
    for (const Values& x : starts_from({known}, model, points)) {
      const auto with = test_errors(bench, tests, model, x);
      for (std::size_t t = 0; t < tests.size(); ++t)
        if (std::abs(with[t].score - without[t].score) >= seen_change) return true;
    }
  }
  return false;
}

}  // namespace freestand::measurement
