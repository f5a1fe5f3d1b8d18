#include "intensity/intensity.hpp"

#include <freestand/error.hpp>

#include "base/registry.hpp"

namespace freestand::intensity {
Register::Register(Measure measure) { Registered<Measure> kept{std::move(measure)}; }

std::vector<const Measure*> all() {
  std::vector<const Measure*> measures;
  for (const Measure& measure : registry<Measure>()) measures.push_back(&measure);
  return measures;
}

const Measure& find(const std::string& name) {
  std::string known;
  for (const Measure& measure : registry<Measure>()) {
    if (measure.name == name) return measure;
    known += (known.empty() ? "" : ", ") + measure.name;
  }
  throw Error("no intensity measure \"" + name + "\" (the measures are " + known + "): name one of these");
}

double parameter_of(const Measure& measure, std::optional<double> given) {
  return measure.parameter ? given.value_or(measure.parameter->fallback) : 0;
}

}  // namespace freestand::intensity
