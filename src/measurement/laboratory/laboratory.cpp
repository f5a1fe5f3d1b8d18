#include "measurement/laboratory/laboratory.hpp"

#include <cmath>

#include "measurement/fit/starts.hpp"
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

std::vector<LaboratoryFault> laboratory_faults(const Bench& bench, const ModelSpec& base, const Values& x) {
  std::vector<LaboratoryFault> found;
  for (const StatedNumber& stated : stated_numbers(bench.data().tolerance, base)) {
    LaboratoryFault fault{stated.name, base};
    let_free(fault.model, stated);
    if (shows(bench, base, x, fault.model)) found.push_back(std::move(fault));
  }
  return found;
}

}  // namespace freestand::measurement
