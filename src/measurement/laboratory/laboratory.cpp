#include "measurement/laboratory/laboratory.hpp"

#include <fmt/format.h>

#include <cmath>

#include "measurement/fit/starts.hpp"
#include "measurement/levels.hpp"
#include "measurement/predict/score.hpp"

namespace freestand::measurement {
namespace {

bool shows(const Bench& bench, const ModelSpec& base, const Values& x, const ModelSpec& model) {
  for (const std::size_t test : tests_of(bench.data(), Role::calibration))
    for (const double factor : {model.free.back().low, model.free.back().high}) {
      Values other = x;
      other.push_back(factor);
      if (std::abs(test_error(bench, test, model, other).score - test_error(bench, test, base, x).score) >= seen_change)
        return true;
    }
  return false;
}

}  // namespace

bool is_laboratory_fault(const std::string& name) {
  return name == width_fault || name == centre_fault || name == gain_fault || name == clock_fault;
}

std::string clock_sentence(const std::string& whose, double late_s) {
  return fmt::format("{} {:.3f} s {} against the floor's channel", whose, std::abs(late_s),
                     late_s > 0 ? "late" : "early");
}

std::string fault_sentence(const std::string& name, double number) {
  if (name == clock_fault) return clock_sentence("the responses are stamped", number);
  const double percent = 100 * std::abs(number - 1);
  if (name == gain_fault)
    return fmt::format("the floor's accelerometer reads {:.1f} % too {}", percent, number < 1 ? "much" : "little");
  const bool width = name == width_fault;
  return fmt::format("the {} is {:.1f} % {} than stated", width ? "width" : "centre of mass", percent,
                     number < 1 ? (width ? "smaller" : "lower") : (width ? "larger" : "higher"));
}

std::vector<LaboratoryFault> laboratory_faults(const Bench& bench, const ModelSpec& base, const Values& x) {
  std::vector<LaboratoryFault> found;
  const Tolerance& tolerance = bench.data().tolerance;
  const auto add = [&](const char* name, Number ModelSpec::*number, double deviation, const char* unit = "1") {
    LaboratoryFault fault{name, base};
    const double stated = (base.*number).value;
    fault.model.*number = {.free = static_cast<int>(base.free.size())};
    const double low = stated - fault_deviations * deviation, high = stated + fault_deviations * deviation;
    fault.model.free.push_back({.name = std::string("laboratory.") + name,
                                .unit = unit,
                                .lower = low,
                                .upper = high,
                                .low = low,
                                .high = high});
    if (deviation > 0 && shows(bench, base, x, fault.model)) found.push_back(std::move(fault));
  };
  const bool fitted = base.width && base.width->free >= 0;
  if (!fitted && !base.slenderness) add(width_fault, &ModelSpec::width_factor, tolerance.width);
  if (!(base.centre_height && base.centre_height->free >= 0))
    add(centre_fault, &ModelSpec::centre_height_factor, tolerance.centre_height);
  add(gain_fault, &ModelSpec::floor_gain, tolerance.floor_gain);
  add(clock_fault, &ModelSpec::clock_behind, tolerance.clock_s, "s");
  return found;
}

}  // namespace freestand::measurement
