#include "intensity/intensity.hpp"

#include <cmath>
#include <freestand/error.hpp>
#include <map>
#include <string_view>

#include "base/registry.hpp"
#include "motion/record_table.hpp"

namespace freestand::intensity {
Register::Register(Measure measure) { Registered<Measure> kept{std::move(measure)}; }

std::vector<const Measure*> all() {
  std::vector<const Measure*> measures;
  for (const Measure& measure : registry<Measure>()) measures.push_back(&measure);
  return measures;
}

namespace {

constexpr std::string_view of_records = "record.", ground_prefix = "ground.";

// Made when it is first asked for; the references stay good.
const Measure* record_measure(const std::string& name) {
  static std::map<std::string, Measure> made;
  if (!name.starts_with(of_records)) return nullptr;
  const std::string column = name.substr(of_records.size());
  const auto number = motion::record_number(column);
  if (!number) return nullptr;
  const std::string scaled = number->power == 0   ? "not scaled"
                             : number->power == 1 ? "scaled with the record"
                                                  : "scaled with the square of the record's scale";
  Measure measure{.name = name,
                  .unit = number->unit,
                  .symbol = name,
                  .summary = "what the table of records gives as " + column + ", " + scaled,
                  .source = "column " + column + " of the table"};
  measure.value = [column, power = number->power](const Input& in) {
    return in.motion.given_value(column) * std::pow(std::abs(in.scale), power);
  };
  return &made.try_emplace(name, std::move(measure)).first->second;
}

// Of a block's shape or friction, or the floor by its very name: no measure of the ground.
bool of_the_motion_alone(const Measure& measure) { return measure.unit != "1" && measure.name != "pta_g"; }

Measure moved_to_the_ground(const Measure& of_floor) {
  Measure measure = of_floor;
  measure.name = std::string(ground_prefix) + of_floor.name;
  measure.symbol = "ground " + of_floor.symbol;
  measure.summary = "of the ground under the building: " + of_floor.summary;
  measure.proportional = false;  // motions are scaled to those of the ground as they are
  measure.of_the_ground = true;
  measure.value = [value = of_floor.value](const Input& in) {
    return value({.motion = motion::ground_of(in.motion),
                  .scale = in.scale,
                  .stretch = in.stretch,
                  .alpha_rad = in.alpha_rad,
                  .p_radps = in.p_radps,
                  .mu_k = in.mu_k,
                  .parameter = in.parameter});
  };
  return measure;
}

// Made when they are first asked for, after main has begun.
const std::vector<Measure>& ground_measures() {
  static const std::vector<Measure> measures = [] {
    std::vector<Measure> made;
    for (const Measure& measure : registry<Measure>())
      if (of_the_motion_alone(measure)) made.push_back(moved_to_the_ground(measure));
    return made;
  }();
  return measures;
}

}  // namespace

std::vector<const Measure*> of_the_ground() {
  std::vector<const Measure*> measures;
  for (const Measure& measure : ground_measures()) measures.push_back(&measure);
  return measures;
}

const Measure& find(const std::string& name) {
  if (const Measure* of_record = record_measure(name)) return *of_record;
  for (const Measure& measure : ground_measures())
    if (measure.name == name) return measure;
  std::string known;
  for (const Measure& measure : registry<Measure>()) {
    if (measure.name == name) return measure;
    known += (known.empty() ? "" : ", ") + measure.name;
  }
  if (name.starts_with(of_records))
    throw Error("no intensity measure \"" + name + "\" (" + name.substr(of_records.size()) +
                " is no column of a table of records of which freestand knows how it changes with their scale): name "
                "it as record.pga_g");
  throw Error("no intensity measure \"" + name + "\" (the measures are " + known + "): name one of these");
}

double parameter_of(const Measure& measure, std::optional<double> given) {
  return measure.parameter ? given.value_or(measure.parameter->fallback) : 0;
}

}  // namespace freestand::intensity
