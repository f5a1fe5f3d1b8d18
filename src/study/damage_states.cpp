#include "study/damage_states.hpp"

#include <algorithm>
#include <cmath>
#include <freestand/response.hpp>
#include <limits>

#include "edp/edp.hpp"
#include "formula/condition.hpp"
#include "sampling/design.hpp"

namespace freestand::study {
namespace {

std::vector<formula::Condition::Name> names_of(const DamagePart& part) {
  std::vector<formula::Condition::Name> names;
  for (const std::string& demand : part.demands) names.push_back({demand, edp::find(demand).binary});
  for (const Quantity& parameter : part.parameters)
    names.push_back({parameter.name.substr(parameter.name.rfind('.') + 1)});
  return names;
}

}  // namespace

struct DamageStates::State {
  State(const DamagePart& from, const sampling::Plan& plan) : part(from), condition(from.when, names_of(from)) {
    for (const Quantity& parameter : part.parameters) streams.emplace_back(plan, parameter.name);
  }

  // Of one sample; demands: in the order of part.demands.
  double value(std::vector<double> demands, bool overturned, std::uint64_t sample) const {
    for (double& demand : demands) {
      if (std::isnan(demand) && overturned) demand = std::numeric_limits<double>::infinity();
      if (std::isnan(demand)) return demand;
    }
    for (std::size_t i = 0; i < streams.size(); ++i)
      demands.push_back(quantile(part.parameters[i].value, streams[i](sample)));
    return condition.holds(demands) ? 1 : 0;
  }

  // With what an overturned block still tells of itself at its least, and at its most.
  bool holds_overturned() const {
    for (const double told : {0.0, std::numeric_limits<double>::infinity()}) {
      std::vector<double> values;
      for (const std::string& name : part.demands) {
        const edp::Edp& demand = edp::find(name);
        const bool over = name == "overturned" || (demand.binary && told > 0);
        values.push_back(over ? 1 : demand.censored ? std::numeric_limits<double>::infinity() : told);
      }
      for (const Quantity& parameter : part.parameters) values.push_back(quantile(parameter.value, 0.5));
      if (!condition.holds(values)) return false;
    }
    return true;
  }

  DamagePart part;
  formula::Condition condition;
  std::vector<sampling::Stream> streams;
};

DamageStates::DamageStates(const Study& study) {
  for (const DamagePart& part : study.fragility.damage)
    states_.push_back(std::make_shared<const State>(part, study.plan()));
}

bool DamageStates::empty() const { return states_.empty(); }

std::vector<fragility::EdpOptions> DamageStates::edps() const {
  std::vector<fragility::EdpOptions> edps;
  for (const auto& state : states_) {
    std::string symbol = state->part.name;
    std::replace(symbol.begin(), symbol.end(), '_', ' ');
    edps.push_back({state->part.name, "1", symbol, true, 0, {}, false});
  }
  return edps;
}

std::vector<std::string> DamageStates::with_overturned() const {
  std::vector<std::string> names;
  for (const auto& state : states_)
    if (state->holds_overturned()) names.push_back(state->part.name);
  return names;
}

void DamageStates::append(Table& rows, std::uint64_t first) const {
  if (empty()) return;
  const std::size_t outcome = column_index(rows.columns, "outcome");
  std::vector<std::vector<std::size_t>> places;
  Table with{rows.columns, {}};
  for (const auto& state : states_) {
    std::vector<std::size_t>& place = places.emplace_back();
    for (const std::string& demand : state->part.demands) place.push_back(column_index(rows.columns, "edp_" + demand));
    with.columns.push_back({"edp_" + state->part.name, "1", state->part.when});
  }
  with.values.reserve(rows.rows() * with.columns.size());
  for (std::size_t row = 0; row < rows.rows(); ++row) {
    for (std::size_t column = 0; column < rows.columns.size(); ++column) with.values.push_back(rows.at(row, column));
    const bool overturned = rows.at(row, outcome) == static_cast<double>(Outcome::overturned);
    for (std::size_t s = 0; s < states_.size(); ++s) {
      std::vector<double> demands;
      for (const std::size_t place : places[s]) demands.push_back(rows.at(row, place));
      with.values.push_back(states_[s]->value(std::move(demands), overturned, first + row));
    }
  }
  rows = std::move(with);
}

}  // namespace freestand::study
