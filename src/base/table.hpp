// A block of samples as a table: what the sweep hands to the files, one row a sample.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace freestand {

enum class ColumnKind { real, integer, flag };  // float64, int32, uint8 in the files

struct Column {
  std::string name;         // with unit suffix where it has one: width_m
  std::string unit;         // "m", "rad", "1" ...
  std::string description;
  ColumnKind kind = ColumnKind::real;
};

// Row-major: values[row * columns.size() + column].
struct Table {
  std::vector<Column> columns;
  std::vector<double> values;

  std::size_t rows() const { return columns.empty() ? 0 : values.size() / columns.size(); }
  double at(std::size_t row, std::size_t column) const { return values[row * columns.size() + column]; }
};

// Position of a column, or throws Error that lists the names there are.
std::size_t column_index(const std::vector<Column>& columns, const std::string& name);

}  // namespace freestand
