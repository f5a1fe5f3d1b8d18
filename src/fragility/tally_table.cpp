#include <fmt/format.h>

#include <freestand/error.hpp>
#include <limits>

#include "base/passed_over.hpp"
#include "fragility/tally.hpp"

namespace freestand::fragility {
namespace {

// A small whole number from a column, or throws.
int whole(double value, int below, const char* column, std::uint64_t sample) {
  if (value >= 0 && value < below && value == static_cast<int>(value)) return static_cast<int>(value);
  throw Error(
      fmt::format("sample {} cannot be counted (column {} holds {}): the samples are damaged", sample, column, value),
      Exit::data);
}

}  // namespace

void Tally::add(const Table& table, std::uint64_t first_sample, const std::function<bool(std::uint64_t)>& keeps) {
  const std::size_t im = column_index(table.columns, "im_" + options_.im_name);
  const std::size_t outcome = column_index(table.columns, "outcome");
  const bool by_motion = !options_.motion_group.empty();
  const std::size_t motion = by_motion ? column_index(table.columns, "motion") : 0;
  std::vector<std::size_t> edp_column, axis_column;
  for (const auto& edp : options_.edps) edp_column.push_back(column_index(table.columns, "edp_" + edp.name));
  for (const auto& axis : options_.axes) axis_column.push_back(column_index(table.columns, axis.name));

  std::vector<double> edp(edp_column.size()), axis(axis_column.size());
  for (std::size_t row = 0; row < table.rows(); ++row) {
    Sample sample;
    sample.index = first_sample + row;
    if (table.at(row, outcome) == static_cast<double>(passed_over)) continue;
    if (keeps && !keeps(sample.index)) continue;
    sample.im = table.at(row, im);
    sample.outcome = static_cast<Outcome>(whole(table.at(row, outcome), outcome_count, "outcome", sample.index));
    if (by_motion)
      sample.motion = whole(table.at(row, motion), std::numeric_limits<int>::max(), "motion", sample.index);
    for (std::size_t i = 0; i < edp.size(); ++i) edp[i] = table.at(row, edp_column[i]);
    for (std::size_t i = 0; i < axis.size(); ++i) axis[i] = table.at(row, axis_column[i]);
    sample.edp = edp;
    sample.axis = axis;
    add(sample);
  }
}

}  // namespace freestand::fragility
