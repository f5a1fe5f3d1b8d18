#include "study/answers.hpp"

#include <algorithm>
#include <cmath>
#include <freestand/response.hpp>
#include <limits>

#include "edp/edp.hpp"

namespace freestand::study {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

std::vector<double> capacities_of(const FragilityPart& part, const edp::Edp& edp) {
  for (const CapacitiesPart& capacities : part.capacities)
    if (capacities.edp == edp.name) return capacities.values;
  return edp.default_capacities;
}

}  // namespace

Answers::Answers(const FragilityPart& part, const std::vector<Column>& columns)
    : columns_{"outcome"}, outcome_(column_index(columns, "outcome")) {
  const auto find = [&](const std::string& name) {
    return std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == "edp_" + name; });
  };
  for (const std::string& name : part.edp) {
    const auto column = find(name);
    if (column == columns.end()) continue;
    const edp::Edp& edp = edp::find(name);
    columns_.push_back(column->name);
    demands_.push_back({static_cast<std::size_t>(column - columns.begin()), edp.binary, edp.censored,
                        edp.binary ? 0 : part.still.at(name),
                        edp.binary ? std::vector<double>{} : capacities_of(part, edp)});
    answers_.push_back({.edp = name, .unit = edp.unit, .capacity = unknown, .yes_or_no = edp.binary});
    for (const double capacity : demands_.back().capacities)
      answers_.push_back({.edp = name, .unit = edp.unit, .capacity = capacity, .yes_or_no = true});
  }
  for (const DamagePart& state : part.damage) {
    const auto column = find(state.name);
    if (column == columns.end()) continue;
    columns_.push_back(column->name);
    demands_.push_back({static_cast<std::size_t>(column - columns.begin()), true, false, 0, {}});
    answers_.push_back({.edp = state.name, .unit = "1", .capacity = unknown, .yes_or_no = true});
  }
}

void Answers::read(std::span<const double> row, std::vector<double>& values) const {
  values.assign(answers_.size(), unknown);
  const auto outcome = static_cast<Outcome>(static_cast<int>(row[outcome_]));
  if (outcome > Outcome::overturned) return;
  std::size_t at = 0;
  for (const Demand& demand : demands_) {
    const double value = row[demand.column];
    const bool over = outcome == Outcome::overturned, fallen = over && demand.censored;
    const bool known = fallen || std::isfinite(value), still = !fallen && value <= demand.still;
    if (demand.yes_or_no)
      values[at] = known ? (fallen || value > 0.5) : unknown;
    else if (known && !fallen && !still)
      values[at] = std::log(value);
    ++at;
    for (const double capacity : demand.capacities)
      values[at++] = known ? (fallen || (!still && value > capacity)) : unknown;
  }
}

}  // namespace freestand::study
