#include "study/law_forms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "formula/formula.hpp"

namespace freestand::study {
namespace {

// low, high: where a fit starts; nothing: where the law is a constant.
struct FreeNumber {
  const char* name;
  double low, high, nothing;
  const char* unit;
};

LawForm form(const char* name, const char* variable, const char* factor, const char* force,
             std::vector<FreeNumber> numbers) {
  std::vector<std::string> names;
  for (const FreeNumber& n : numbers) names.emplace_back(n.name);
  LawForm form{variable, factor, force, {}};
  form.effect = formula::effect(name, form.friction(), force, names);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    dynamics::Parameter& p = form.effect.parameters[i];
    const FreeNumber& n = numbers[i];
    const bool positive = n.low > 0;
    p.low = n.low;
    p.high = n.high;
    p.neutral = n.nothing;
    p.unit = n.unit;
    // Ten times beyond where fits start; amplitudes of friction that would turn it round are refused by the model itself.
    p.lower = positive ? n.low / 10 : 10 * n.low;
    p.upper = 10 * n.high;
  }
  return form;
}

}  // namespace

// Waves of a floor are told by both amplitudes, so that no phase has to be found. No two variables have a name of a number in common.
const std::vector<LawForm>& law_forms() {
  static const std::vector<LawForm> all = {
      form("law_of_position", "position_m", "1 + a*u", "", {{"a", -4, 4, 0, "1/m"}}),
      form("law_of_position_squared", "position_m", "1 + a*u + b*u^2", "",
           {{"a", -4, 4, 0, "1/m"}, {"b", -20, 20, 0, "1/m2"}}),
      form("waves_over_position", "position_m", "1 + a*sin(2*pi*u/l) + b*cos(2*pi*u/l)", "",
           {{"a", -0.6, 0.6, 0, "1"}, {"b", -0.6, 0.6, 0, "1"}, {"l_m", 0.03, 0.4, 0.1, "m"}}),
      form("law_of_time", "time_s", "1 + d*t", "", {{"d", -0.1, 0.1, 0, "1/s"}}),
      form("saturating_over_time", "time_s", "1 + d*(1 - exp(-t/e))", "",
           {{"d", -0.6, 1.5, 0, "1"}, {"e_s", 0.5, 20, 5, "s"}}),
      form("law_of_path", "path_m", "1 + f*path", "", {{"f", -1, 1, 0, "1/m"}}),
      form("law_of_speed", "speed_mps", "1 + h*speed + i*speed^2", "",
           {{"h", -2, 2, 0, "s/m"}, {"i", -4, 4, 0, "s2/m2"}}),
      form("law_of_normal_force", "normal_g", "1 + j*(normal - 1)", "", {{"j", -0.8, 0.8, 0, "1"}}),
      form("healing_at_rest", "rest_s", "1 + q*log(1 + rest/r)", "",
           {{"q", 0.02, 0.6, 0, "1"}, {"r_s", 0.02, 1, 0.1, "s"}}),
      form("quadratic_drag", "speed_mps", "", "-c*v*abs(v)", {{"c", 0.3, 20, 0, "1/m"}}),
      form("cubic_spring", "position_m", "", "-k*u^3", {{"k", 1, 3000, 0, "1/(m2 s2)"}}),
      form("force_in_waves", "position_m", "", "-m*sin(2*pi*u/n) - o*(cos(2*pi*u/n) - 1)",
           {{"m", -1, 1, 0, "m/s2"}, {"o", -1, 1, 0, "m/s2"}, {"n_m", 0.03, 0.4, 0.1, "m"}}),
  };
  return all;
}

LawForm together(const std::vector<LawForm>& forms) {
  LawForm all = forms.front();
  for (std::size_t i = 1; i < forms.size(); ++i) {
    const LawForm& next = forms[i];
    all.variable += " and " + next.variable;
    if (!next.factor.empty())
      all.factor = all.factor.empty() ? next.factor : fmt::format("{})*({}", all.factor, next.factor);
    if (!next.force.empty())
      all.force = all.force.empty() ? next.force : fmt::format("{} + ({})", all.force, next.force);
    all.effect.name += "_and_" + next.effect.name;
    all.effect.parameters.insert(all.effect.parameters.end(), next.effect.parameters.begin(),
                                 next.effect.parameters.end());
  }
  return all;
}

std::vector<double> law_at(const LawForm& form, const std::vector<double>& places, double mu,
                           const std::vector<double>& values) {
  std::vector<std::string> names;
  for (const dynamics::Parameter& p : form.effect.parameters) names.push_back(p.name);
  const formula::Formula law(form.factor.empty() ? form.force : form.friction(), names);
  std::vector<double> found;
  for (const double x : places) {
    formula::Inputs at = {0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 0};
    if (form.variable == "position_m") at[0] = x;
    if (form.variable == "time_s") at[4] = x;
    if (form.variable == "path_m") at[5] = x;
    if (form.variable == "normal_g") at[6] = x;
    if (form.variable == "speed_mps") at[1] = at[9] = x;
    if (form.variable == "rest_s") at[10] = x;
    found.push_back(law.value(at, mu, values));
  }
  return found;
}

namespace {

// Friction as the tests showed it, and none where they did not and it would turn round: 1 + a*u has a sign only so far. Logarithms and
// exponentials of these forms never do.
std::string friction_that_ends_at_zero(const std::string& factors) {
  constexpr std::string_view between = ")*(";  // several laws
  std::string text = "mu";
  for (std::size_t from = 0, end; from <= factors.size(); from = end + between.size()) {
    end = std::min(factors.find(between, from), factors.size());
    const std::string factor = factors.substr(from, end - from);
    const bool turns = factor.find("log(") == std::string::npos && factor.find("exp(") == std::string::npos;
    text += turns ? fmt::format("*max(0, {})", factor) : fmt::format("*({})", factor);
  }
  return text;
}

}  // namespace

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
  std::string laws;
  if (!form.factor.empty()) laws += fmt::format("friction: \"{}\", ", friction_that_ends_at_zero(form.factor));
  if (!form.force.empty()) laws += fmt::format("force: \"{}\", ", form.force);
  return fmt::format("{{name: {}, {}parameters: {{{}}}}}\n", form.effect.name, laws, parameters);
}

}  // namespace freestand::study
