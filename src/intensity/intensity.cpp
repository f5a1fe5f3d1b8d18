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

constexpr std::string_view of_records = "record.";

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

}  // namespace

const Measure& find(const std::string& name) {
  if (const Measure* of_record = record_measure(name)) return *of_record;
  std::string known;
  for (const Measure& measure : registry<Measure>()) {
    if (measure.name == name) return measure;
    known += (known.empty() ? "" : ", ") + measure.name;
  }
  if (name.starts_with(of_records))
    throw Error("no intensity measure \"" + name + "\" (" + name.substr(of_records.size()) +
                " is no column of a table of records with a unit that freestand knows): name it as record.pga_g");
  throw Error("no intensity measure \"" + name + "\" (the measures are " + known + "): name one of these");
}

double parameter_of(const Measure& measure, std::optional<double> given) {
  return measure.parameter ? given.value_or(measure.parameter->fallback) : 0;
}

}  // namespace freestand::intensity
