#include "study/law_forms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "formula/formula.hpp"

namespace freestand::study {
namespace {

// low, high: where a fit starts; nothing: where the law is a constant.
struct FreeNumber {
  const char* name;
  double low, high, nothing;
};

LawForm form(const char* name, const char* variable, const char* friction, const char* force,
             std::vector<FreeNumber> numbers) {
  std::vector<std::string> names;
  for (const FreeNumber& n : numbers) names.emplace_back(n.name);
  LawForm form{variable, friction, force, formula::effect(name, friction, force, names)};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    dynamics::Parameter& p = form.effect.parameters[i];
    const FreeNumber& n = numbers[i];
    const bool positive = n.low > 0;
    p.low = n.low;
    p.high = n.high;
    p.neutral = n.nothing;
    p.unit = std::string(p.name.ends_with("_m") ? "m" : p.name.ends_with("_s") ? "s" : "");
    // Ten times beyond where fits start; amplitudes of friction that would turn it round are refused by the model itself.
    p.lower = positive ? n.low / 10 : 10 * n.low;
    p.upper = 10 * n.high;
  }
  return form;
}

}  // namespace

// Friction is mu times a factor. Waves of a floor are told by both amplitudes, so that no phase has to be found.
const std::vector<LawForm>& law_forms() {
  static const std::vector<LawForm> all = {
      form("law_of_position", "position_m", "mu*(1 + a*u)", "", {{"a", -4, 4, 0}}),
      form("law_of_position_squared", "position_m", "mu*(1 + a*u + b*u^2)", "", {{"a", -4, 4, 0}, {"b", -20, 20, 0}}),
      form("waves_over_position", "position_m", "mu*(1 + a*sin(2*pi*u/l) + b*cos(2*pi*u/l))", "",
           {{"a", -0.6, 0.6, 0}, {"b", -0.6, 0.6, 0}, {"l_m", 0.03, 0.4, 0.1}}),
      form("law_of_time", "time_s", "mu*(1 + a*t)", "", {{"a", -0.1, 0.1, 0}}),
      form("saturating_over_time", "time_s", "mu*(1 + a*(1 - exp(-t/c)))", "",
           {{"a", -0.6, 1.5, 0}, {"c_s", 0.5, 20, 5}}),
      form("law_of_path", "path_m", "mu*(1 + a*path)", "", {{"a", -1, 1, 0}}),
      form("law_of_speed", "speed_mps", "mu*(1 + a*speed + b*speed^2)", "", {{"a", -2, 2, 0}, {"b", -4, 4, 0}}),
      form("law_of_normal_force", "normal_g", "mu*(1 + a*(normal - 1))", "", {{"a", -0.8, 0.8, 0}}),
      form("quadratic_drag", "speed_mps", "", "-c*v*abs(v)", {{"c", 0.3, 20, 0}}),
      form("cubic_spring", "position_m", "", "-k*u^3", {{"k", 1, 3000, 0}}),
      form("force_in_waves", "position_m", "", "-a*sin(2*pi*u/l) - b*(cos(2*pi*u/l) - 1)",
           {{"a", -1, 1, 0}, {"b", -1, 1, 0}, {"l_m", 0.03, 0.4, 0.1}}),
  };
  return all;
}

std::vector<double> law_at(const LawForm& form, const std::vector<double>& places, double mu,
                           const std::vector<double>& values) {
  std::vector<std::string> names;
  for (const dynamics::Parameter& p : form.effect.parameters) names.push_back(p.name);
  const formula::Formula law(form.friction.empty() ? form.force : form.friction, names);
  std::vector<double> found;
  for (const double x : places) {
    // u v theta omega t path normal side sigma speed
    std::array<double, 10> at = {0, 0, 0, 0, 0, 0, 1, 0, 1, 0};
    if (form.variable == "position_m") at[0] = x;
    if (form.variable == "time_s") at[4] = x;
    if (form.variable == "path_m") at[5] = x;
    if (form.variable == "normal_g") at[6] = x;
    if (form.variable == "speed_mps") at[1] = at[9] = x;
    found.push_back(law.value(at, mu, values));
  }
  return found;
}

std::string entry_of(const LawForm& form, const std::vector<double>& values) {
  std::string parameters;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const dynamics::Parameter& p = form.effect.parameters[i];
    // A third of where fits start, to either side.
    const double reach = (p.high - p.low) / 3;
    parameters +=
        fmt::format("{}{}: {{calibrate: [{:.4g}, {:.4g}]}}", i ? ", " : "", p.name,
                    std::max(p.lower, p.low > 0 ? std::max(values[i] - reach, values[i] / 3) : values[i] - reach),
                    std::min(p.upper, values[i] + reach));
  }
  const bool friction = !form.friction.empty();
  return fmt::format("{{name: {}, {}: \"{}\", parameters: {{{}}}}}\n", form.effect.name,
                     friction ? "friction" : "force", friction ? form.friction : form.force, parameters);
}

}  // namespace freestand::study
