#include "measurement/fit/stated_numbers.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

namespace freestand::measurement {

bool is_laboratory_fault(const std::string& name) {
  return name == width_fault || name == centre_fault || name == gain_fault || name == clock_fault;
}

std::string clock_sentence(const std::string& whose, double late_s) {
  return fmt::format("{} {:.3f} s {} against the floor's channel", whose, std::abs(late_s),
                     late_s > 0 ? "late" : "early");
}

std::string fault_sentence(const std::string& name, double number) {
  if (name == clock_fault) return clock_sentence("the responses are stamped", number);
  // What it reads times the number is right.
  const double percent = 100 * std::abs((name == gain_fault ? 1 / number : number) - 1);
  const std::string shown = percent < 0.1 ? fmt::format("{:.1g}", percent) : fmt::format("{:.1f}", percent);
  if (name == gain_fault)
    return fmt::format("the floor's accelerometer reads {} % too {}", shown, number < 1 ? "much" : "little");
  const bool width = name == width_fault;
  return fmt::format("the {} is {} % {} than stated", width ? "width" : "centre of mass", shown,
                     number < 1 ? (width ? "smaller" : "lower") : (width ? "larger" : "higher"));
}

std::string at_its_limit(const Free& free, double number) {
  if (std::min(number - free.lower, free.upper - number) >= 1e-3 * (free.upper - free.lower)) return "";
  return ", which is as far as is sought, three times the tolerance that the data set states or else the usual one; it "
         "may "
         "be off by more";
}

std::vector<StatedNumber> stated_numbers(const Tolerance& tolerance, const ModelSpec& model) {
  std::vector<StatedNumber> all;
  const auto is_fitted = [](const std::optional<Number>& number) { return number && number->free >= 0; };
  if (!is_fitted(model.width) && !model.slenderness)
    all.push_back({width_fault, &ModelSpec::width_factor, tolerance.width});
  if (!is_fitted(model.centre_height))
    all.push_back({centre_fault, &ModelSpec::centre_height_factor, tolerance.centre_height});
  all.push_back({gain_fault, &ModelSpec::floor_gain, tolerance.floor_gain});
  all.push_back({clock_fault, &ModelSpec::clock_behind, tolerance.clock_s, "s"});
  std::erase_if(all, [&](const StatedNumber& s) { return s.deviation <= 0 || (model.*s.number).free >= 0; });
  return all;
}

void let_free(ModelSpec& model, const StatedNumber& stated) {
  const double value = (model.*stated.number).value, reach = fault_deviations * stated.deviation;
  model.*stated.number = {.free = static_cast<int>(model.free.size())};
  model.free.push_back({.name = std::string("laboratory.") + stated.name,
                        .unit = stated.unit,
                        .lower = value - reach,
                        .upper = value + reach,
                        .low = value - reach,
                        .high = value + reach});
}

bool within_tolerance(const Free& free, double number) {
  const double deviations = (to_unit(free, number) - stated_in_cube) / deviation_in_cube;
  return 2 * gsl_cdf_ugaussian_Q(std::abs(deviations)) > chance_level;
}

}  // namespace freestand::measurement
