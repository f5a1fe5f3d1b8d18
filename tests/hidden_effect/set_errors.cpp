#include "hidden_effect/set_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace freestand::test {
namespace {

constexpr double coarse_step_s = 2.5e-4;  // coarse: these errors are looked at, not compared

double square_of(double x) { return x * x; }

double mean_square(const MadeSet& set, const TruthHistory& history, const std::vector<double>& slip_m,
                   const std::vector<double>& rotation_rad) {
  double sum = 0;
  for (std::size_t i = 0; i < slip_m.size(); ++i) sum += square_of((history.slip_m[i] - slip_m[i]) / set.slip_noise_m);
  if (set.drawn.habit == Habit::slides) return sum / static_cast<double>(slip_m.size());
  for (std::size_t i = 0; i < rotation_rad.size(); ++i)
    sum += square_of((history.rotation_rad[i] - rotation_rad[i]) / set.rotation_noise_rad);
  return sum / static_cast<double>(slip_m.size() + rotation_rad.size());
}

bool is_in_catalogue(const std::string& effect) {
  const auto& all = catalogue_effects();
  return std::find(all.begin(), all.end(), effect) != all.end();
}

double squared_error(const MadeSet& set, const Truth& model) {
  double sum = 0;
  for (const MadeTest& test : set.tests)
    sum += mean_square(set, simulate(model, test.floor, coarse_step_s), test.truth.slip_m, test.truth.rotation_rad);
  return sum / static_cast<double>(set.tests.size());
}

}  // namespace

double error_of(const MadeSet& set, const MadeTest& test, const TruthHistory& history) {
  return std::sqrt(mean_square(set, history, test.slip_m, test.rotation_rad));
}

// Steps of mu: 24, 12, 6, 3 % as long as they help.
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

double weakest_error(const MadeSet& set) {
  const auto& hidden = set.drawn.truth.effects;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hidden.size(); ++i) {
    std::vector<TruthEffect> others = hidden;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    least = std::min(least, error_with(set, others));
    if (!is_in_catalogue(hidden[i].name))
      for (double ratio = 1.1; ratio < 2; ratio += 0.1) {
        std::vector<TruthEffect> stand_in = others;
        stand_in.push_back({"static_friction", {{"ratio", ratio}}});
        least = std::min(least, error_with(set, stand_in));
      }
  }
  return least;
}

}  // namespace freestand::test
