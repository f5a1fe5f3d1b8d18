// A table of the report as configs/report holds it: numbers in columns, rounded as printed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/csv_table.hpp"
#include "report/rounding.hpp"

namespace freestand::report {

// A finite number and nothing else.
std::optional<double> number_in(const std::string& cell);

class PrintedTable {
 public:
  // Throws Error (Exit::data) where the file is not there or no table.
  PrintedTable(const Sources& sources, const std::string& file);
  explicit PrintedTable(CsvTable table) : table_(std::move(table)) {}

  std::size_t rows() const { return table_.rows.size(); }
  bool has(const std::string& column) const { return table_.column(column) < table_.columns.size(); }
  const CsvTable& csv() const { return table_; }

  // Both throw Error (Exit::data): no such column, a cell that is no finite number (with file and line). An empty cell of
  // numbers() is nan.
  std::vector<std::string> texts(const std::string& column) const;
  std::vector<double> numbers(const std::string& column) const;

  // The unit of the last digit that the column's cells show: 0.01 where one of them has two decimals. A csv drops trailing
  // zeros, so the cell with the most decimals counts.
  double unit(const std::string& column) const;
  std::vector<Rounded> rounded(const std::string& column) const;

 private:
  std::size_t at(const std::string& column) const;
  CsvTable table_;
};

}  // namespace freestand::report
